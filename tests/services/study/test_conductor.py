"""What a conductor was told is in the journal, and another conductor of the same journal stands where it stood."""

import contextlib
import datetime
import tempfile
from pathlib import Path

import pytest
from hypothesis import settings
from hypothesis import strategies as st
from hypothesis.stateful import (
    RuleBasedStateMachine,
    initialize,
    invariant,
    precondition,
    rule,
    run_state_machine_as_test,
)

from services.offline.people.ways import Teaching
from services.study.events import Attempted, BrokenOff, Enrolled, Erased
from services.study.exceptions import AnswerRefused, NotNow, ParticipantThere, ParticipantUnknown, StudyError
from services.study.journal import Journal
from services.study.protocol.protocol import load
from services.study.protocols import SHIPPED
from services.study.session.conductor import Conductor
from services.study.session.course import Adapt, Agree, Fill, Rest, Train, participants
from services.study.session.sheet import Sheet

pytestmark = pytest.mark.usefixtures("unsynchronised")

PROTOCOL = load(SHIPPED["thesis"])


class Form:
    """Stands in for a questionnaire: complete with an answer to `good`."""

    version = "1"

    def check(self, answers):
        if "good" not in answers:
            raise AnswerRefused("good", "it is not answered")


FORMS = {"participant": Form(), "nasa_tlx": Form()}
SHEET = Sheet("en", "1", ("good",), {"good": 3})


class Clock:
    """Time of day, moved by hand."""

    def __init__(self):
        self.now = datetime.datetime(2026, 1, 1, tzinfo=datetime.UTC)

    def __call__(self):
        return self.now

    def pass_(self, minutes):
        self.now += datetime.timedelta(minutes=minutes)


@pytest.fixture
def clock():
    return Clock()


@pytest.fixture
def journal(tmp_path, clock):
    with Journal(tmp_path / "raw", clock) as one:
        yield one


@pytest.fixture
def conductor(journal):
    return Conductor(PROTOCOL, journal, FORMS)


def attempt(number, part, count, *, success=True):
    return Attempted(
        participant=number, part=part.name, number=count, teaching=Teaching.PREDICTION, updates=0, success=success,
        reached=success, kicked_over=False, collision=False, active=8.0, began=1.0, ended=11.0,
    )  # fmt: skip


def go_through(conductor, number, parts):
    for _ in range(parts):
        do_next(conductor, number)


def do_next(conductor, number):
    match part := conductor.now(number):
        case Agree():
            conductor.consent(number, "en")
        case Fill():
            conductor.answer(number, part, SHEET)
        case Train() | Adapt():
            conductor.begin(number)
            conductor.attempted(attempt(number, part, 1))
            conductor.end(number, part, seconds=8.0)
        case Rest():
            conductor.end(number, part)
    return part


def test_a_participant_goes_through_to_the_end(conductor):
    number = conductor.enrol(None, "nl").number
    count = 0
    while do_next(conductor, number) is not None:
        count += 1
    assert count == 25
    assert conductor.participant(number).finished
    with pytest.raises(NotNow):
        conductor.begin(number)


def test_numbers_are_one_person_s_and_the_next_is_proposed(conductor):
    assert conductor.enrol(None, "en").number == 1
    assert conductor.enrol(7, "en").number == 7
    assert conductor.proposed() == 8
    with pytest.raises(ParticipantThere, match="there is a participant 7 already"):
        conductor.enrol(7, "en")
    with pytest.raises(ParticipantUnknown, match="there is no participant 3"):
        conductor.consent(3, "en")
    with pytest.raises(NotNow, match="en, de, nl"):
        conductor.enrol(8, "fr")


def test_what_is_not_complete_is_refused_and_not_written(conductor, journal):
    number = conductor.enrol(None, "en").number
    conductor.consent(number, "en")
    before = len(journal.entries)
    with pytest.raises(AnswerRefused):
        conductor.answer(number, Fill("participant"), Sheet("en", "1", (), {}))
    with pytest.raises(NotNow, match="version 0"):
        conductor.answer(number, Fill("participant"), Sheet("en", "0", (), {"good": 1}))
    with pytest.raises(NotNow, match="is at participant, not at nasa_tlx"):
        conductor.answer(number, Fill("nasa_tlx"), SHEET)
    assert len(journal.entries) == before


def test_an_attempt_that_is_told_twice_is_one(conductor):
    number = conductor.enrol(None, "en").number
    go_through(conductor, number, 2)
    part = conductor.begin(number)
    for _ in range(2):
        conductor.attempted(attempt(number, part, 1))
    conductor.attempted(attempt(number, part, 2))
    assert [one.number for one in conductor.participant(number).attempts[part.name]] == [1, 2]


def test_what_broke_off_is_kept_counts_for_nothing_and_the_part_goes_on(conductor):
    conductor.enrol(1, "en")
    go_through(conductor, 1, 2)
    part = conductor.begin(1)
    conductor.attempted(attempt(1, part, 1))
    broken = BrokenOff(participant=1, part=part.name, why="killed", raw={"acting": 4.0})
    conductor.broke_off(broken)
    one = conductor.participant(1)
    assert one.broken_off == [broken]
    assert len(one.attempts[part.name]) == 1
    assert conductor.now(1) == part


def test_after_a_crash_an_old_checkpoint_is_the_experimenter_s_decision(conductor, journal, clock):
    number = conductor.enrol(None, "en").number
    go_through(conductor, number, 2)
    part = conductor.begin(number)
    conductor.attempted(attempt(number, part, 1))
    clock.pass_(PROTOCOL.resume.minutes + 1)
    again = Conductor(PROTOCOL, journal, FORMS)
    with pytest.raises(NotNow, match="16 minutes old, of at most 15"):
        again.go_on(number, clock())
    again.go_on(number, clock(), by_hand=True)
    assert again.now(number) == part
    assert len(again.participant(number).attempts[part.name]) == 1


def test_what_is_invalid_is_kept_beside_and_done_again(conductor):
    number = conductor.enrol(None, "en").number
    go_through(conductor, number, 3)
    part = Train(conductor.participant(number).enrolled.order[0])
    conductor.invalid(number, part.name, "the alarm rang", repeat=True)
    assert conductor.now(number) == part
    assert [why for _, why in conductor.participant(number).void] == ["the alarm rang"]
    with pytest.raises(NotNow, match="say why"):
        conductor.invalid(number, part.name, " ", repeat=True)


def test_who_pauses_does_not_begin_anything(conductor, clock):
    number = conductor.enrol(None, "en").number
    conductor.pause(number, "lunch")
    with pytest.raises(NotNow, match="pauses"):
        conductor.begin(number)
    conductor.go_on(number, clock())
    conductor.begin(number)


@pytest.mark.parametrize("delete", [True, False])
def test_a_withdrawal_takes_effect_at_once_and_deletes_what_it_is_to(conductor, journal, delete):
    for number in (1, 2):
        conductor.enrol(number, "en")
        go_through(conductor, number, 4)
    erased = conductor.withdraw(1, delete=delete)
    assert conductor.now(1) is None
    assert bool(erased) == delete
    of_first = [entry.event for entry in journal.entries if getattr(entry.event, "participant", 0) == 1]
    assert any(isinstance(event, Erased) for event in of_first) == delete
    assert isinstance(of_first[0], Enrolled)
    assert conductor.participant(2).attempts
    assert Conductor(PROTOCOL, journal, FORMS).participants() == conductor.participants()


def test_whose_place_became_free_is_replaced_with_the_same_order(conductor):
    groups = [conductor.enrol(None, "en").enrolled.group for _ in range(3)]
    conductor.drop(2, "moved away")
    assert conductor.enrol(None, "en").enrolled.group == groups[1]


def test_a_place_becomes_free_once_however_often_somebody_leaves_it(conductor):
    groups = [conductor.enrol(None, "en").enrolled.group for _ in range(3)]
    conductor.withdraw(2, delete=False)
    conductor.withdraw(2, delete=True)
    assert conductor.enrol(None, "en").enrolled.group == groups[1]
    assert conductor.enrol(None, "en").enrolled.group not in groups


class Any(RuleBasedStateMachine):
    """Whatever a study's people do: the journal says it all."""

    folder = None

    @initialize()
    def begin(self):
        self.clock, self.raw = Clock(), Path(tempfile.mkdtemp(dir=self.folder))
        self.journal = Journal(self.raw, self.clock)
        self.conductor = Conductor(PROTOCOL, self.journal, FORMS)

    @rule(number=st.integers(1, 4))
    def enrol(self, number):
        self.tried(self.conductor.enrol, number, "en")

    @rule(number=st.integers(1, 4), parts=st.integers(1, 9))
    def work(self, number, parts):
        self.tried(go_through, self.conductor, number, parts)

    @rule(number=st.integers(1, 4), delete=st.booleans())
    def withdraw(self, number, delete):
        self.tried(lambda: self.conductor.withdraw(number, delete=delete))

    @rule(number=st.integers(1, 4))
    def drop(self, number):
        self.tried(self.conductor.drop, number, "gone")

    @rule(number=st.integers(1, 4), part=st.sampled_from(["OnStyl/training", "OnKey/1"]), repeat=st.booleans())
    def invalid(self, number, part, repeat):
        self.tried(lambda: self.conductor.invalid(number, part, "because", repeat=repeat))

    @rule(number=st.integers(1, 4))
    def begin_and_void(self, number):
        self.tried(self.begun_and_void, number)

    @rule(number=st.integers(1, 4))
    def pause(self, number):
        self.tried(self.conductor.pause, number, "")

    @rule(number=st.integers(1, 4))
    def go_on(self, number):
        self.tried(self.conductor.go_on, number, self.clock.now)

    @precondition(lambda self: self.journal.entries)
    @rule()
    def crash(self):
        self.journal.close()
        self.journal = Journal(self.raw, self.clock)
        self.conductor = Conductor(PROTOCOL, self.journal, FORMS)

    @invariant()
    def the_journal_says_it_all(self):
        if hasattr(self, "journal"):
            assert participants(self.journal.entries) == self.conductor.participants()

    def teardown(self):
        if hasattr(self, "journal"):
            self.journal.close()

    def begun_and_void(self, number):
        part = self.conductor.begin(number)
        self.conductor.invalid(number, part.name, "because", repeat=False)
        assert self.conductor.now(number) != part or part == Agree()

    def tried(self, act, *arguments):
        with contextlib.suppress(StudyError):
            act(*arguments)


def test_whatever_is_done_another_conductor_stands_where_this_one_stood(tmp_path):
    Any.folder = tmp_path
    run_state_machine_as_test(Any, settings=settings(max_examples=15, stateful_step_count=20, deadline=None))
