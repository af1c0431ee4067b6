"""A hold is left by itself after a moment, else only when it is asked to."""

import pytest

from services.robot.hold import ANOTHER_AUTHORITY, LONG_HOLD_S, TOO_LONG, Hold

MS = 1_000_000


@pytest.fixture
def hold():
    asked = Hold()
    asked.ask(7)
    return asked


def held(hold, milliseconds, since=0, epoch=7):
    """Hold for so long, in periods of 10 ms."""
    for now in range(since, since + milliseconds + 1, 10):
        assert "nobody there" in hold.reason(now * MS, "nobody there", epoch)


def test_what_nobody_asked_for_waits():
    hold = Hold()
    assert not hold.waiting
    assert hold.reason(0, "", 1) == ANOTHER_AUTHORITY


def test_without_a_cause_a_motion_goes_on(hold):
    assert hold.reason(0, "", 7) == ""
    assert not hold.waiting


def test_a_hold_of_up_to_half_a_second_is_left_by_itself(hold):
    held(hold, round(1e3 * LONG_HOLD_S))
    assert not hold.waiting
    assert hold.reason(600 * MS, "", 7) == ""


def test_a_longer_one_waits_to_be_asked(hold):
    held(hold, round(1e3 * LONG_HOLD_S) + 10)
    assert hold.waiting
    for later in (600, 6000):
        assert hold.reason(later * MS, "", 7) == f"{TOO_LONG} (nobody there)"


def test_what_was_asked_goes_on_as_soon_as_nothing_keeps_it(hold):
    held(hold, 1000)
    hold.ask(7)
    assert hold.reason(1010 * MS, "nobody there", 7) == "nobody there"
    assert not hold.waiting
    assert hold.reason(1020 * MS, "", 7) == ""


def test_a_request_does_not_last_longer_than_a_short_hold(hold):
    held(hold, 1000)
    hold.ask(7)
    held(hold, 510, since=1010)
    assert hold.waiting


def test_holds_that_come_one_after_the_other_do_not_add_up(hold):
    for start in range(0, 5000, 500):
        held(hold, 400, since=start)
        assert hold.reason((start + 450) * MS, "", 7) == ""
    assert not hold.waiting


def test_under_another_authority_a_motion_waits_at_once(hold):
    assert hold.reason(0, "", 8) == ANOTHER_AUTHORITY
    assert hold.waiting
    assert hold.reason(10 * MS, "", 7) == ANOTHER_AUTHORITY
    hold.ask(8)
    assert hold.reason(20 * MS, "", 8) == ""


def test_a_long_hold_does_not_hide_that_the_authority_is_another(hold):
    hold.reason(0, "nobody there", 8)
    held(hold, 1000, since=10)
    assert hold.reason(1020 * MS, "", 7) == f"{ANOTHER_AUTHORITY} (nobody there)"


@pytest.mark.parametrize("epoch", [7, 8])
def test_what_comes_and_goes_while_it_waits_does_not_change_what_whoever_is_to_answer_reads(hold, epoch):
    held(hold, 1000, epoch=epoch)
    read = {hold.reason((1000 + 10 * k) * MS, ("", "no hand", "nobody there")[k // 20 % 3], epoch) for k in range(300)}
    assert len(read) == 1


def test_another_cause_that_lasts_is_told_while_it_waits(hold):
    held(hold, 1000)
    for now in range(1010, 1600, 10):
        told = hold.reason(now * MS, "no hand", 7)
    assert told == f"{TOO_LONG} (no hand)"
