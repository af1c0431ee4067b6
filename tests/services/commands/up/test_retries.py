"""An end is judged: again, later each time, or over, with a line that says why and what to do."""

import signal

import pytest

from services.commands.up.retries import BACK_OFF_S, KILLS, STEADY_AFTER_S, TRIES, Again, End, Retries
from services.process.exit_codes import Exit

SHORT_S = 1.0


def ended(retries, code, times, lived_s=SHORT_S, line=""):
    return [retries.ended(code, lived_s, line) for _ in range(times)]


@pytest.mark.parametrize("code", [Exit.BAD_INPUT, Exit.ENVIRONMENT])
def test_what_a_new_start_does_not_mend_is_over_at_once(code):
    judged = Retries("model").ended(code, SHORT_S, "retouch: the file is no database")
    assert judged == End("model: the file is no database", code)


def test_what_may_pass_is_tried_again_and_then_is_the_machines_fault():
    *before, last = ended(Retries("viewer"), Exit.TRY_AGAIN, TRIES, line="retouch: port 9090 is in use")
    assert [judged.delay_s for judged in before] == list(BACK_OFF_S[: TRIES - 1])
    assert last.code == Exit.ENVIRONMENT
    assert last.line.startswith("viewer: port 9090 is in use")


@pytest.mark.parametrize("code", [Exit.DONE, Exit.CRASHED, -signal.SIGSEGV])
def test_what_ends_by_itself_again_and_again_is_a_crash_named_with_process_and_reason(code):
    *before, last = ended(Retries("robot"), code, TRIES, line="ValueError: nan")
    assert all(isinstance(judged, Again) for judged in before)
    assert last.code == Exit.CRASHED
    for words in ("robot", str(TRIES), "ValueError: nan", "log"):
        assert words in last.line


def test_one_that_ran_steadily_between_its_ends_is_started_for_ever():
    judged = ended(Retries("robot"), Exit.CRASHED, 5 * TRIES, lived_s=STEADY_AFTER_S + 0.1)
    assert {one.delay_s for one in judged} == {BACK_OFF_S[0]}


def test_one_that_does_a_single_thing_is_not_tried_for_ever_however_long_it_takes():
    *_, last = ended(Retries("teach", lives=False), Exit.TRY_AGAIN, TRIES, lived_s=6 * STEADY_AFTER_S)
    assert isinstance(last, End)
    assert last.code == Exit.ENVIRONMENT


@pytest.mark.parametrize("number", [signal.SIGKILL, signal.SIGTERM])
def test_a_person_may_kill_it_often_but_not_for_ever(number):
    *before, last = ended(Retries("robot"), -number, KILLS)
    assert all(isinstance(judged, Again) for judged in before)
    assert isinstance(last, End)


def test_kills_do_not_count_as_the_process_own_ends():
    retries = Retries("robot")
    ended(retries, -signal.SIGKILL, 2 * TRIES)
    assert isinstance(retries.ended(Exit.CRASHED, SHORT_S, ""), Again)
