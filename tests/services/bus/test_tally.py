"""What comes in is counted, what is thrown away is counted by its cause, and the newest fault is told once."""

import pytest

from protocol.exceptions import MalformedMessage, Misplaced, OversizedMessage, WrongVersion
from services.bus.freshness import Judgement
from services.bus.tally import Tally

SECOND = 1_000_000_000


@pytest.fixture
def tally():
    return Tally("cmd/finish")


@pytest.mark.parametrize(
    ("cause", "counted"),
    [
        (MalformedMessage("a", "b"), "malformed"),
        (OversizedMessage("a", 2, 1), "oversized"),
        (WrongVersion("a", "b", "c"), "wrong_version"),
        (Misplaced("a", "b"), "misplaced"),
        *((judgement, judgement.value) for judgement in Judgement if judgement is not Judgement.FRESH),
    ],
)
def test_every_cause_is_counted_by_itself(tally, cause, counted):
    tally.dropped(cause)
    figures = tally.figures(SECOND)
    assert (getattr(figures, counted), figures.drops) == (1, 1)


def test_what_was_given_up_for_others_is_counted_and_told(tally):
    tally.crowded("too many")
    figures = tally.figures(SECOND)
    assert (figures.crowded, figures.drops, tally.take_fault()) == (1, 1, "too many")


def test_the_rate_is_of_the_time_since_the_last_call_and_drops_are_of_all_time(tally):
    tally.figures(SECOND)
    for _ in range(20):
        tally.came()
    tally.dropped(Judgement.STALE)
    assert tally.figures(3 * SECOND).rate_hz == 10.0
    later = tally.figures(4 * SECOND)
    assert (later.topic, later.rate_hz, later.stale) == ("cmd/finish", 0.0, 1)


def test_a_first_call_knows_no_rate(tally):
    tally.came()
    assert tally.figures(SECOND).rate_hz == 0.0


def test_the_newest_fault_is_told_once_and_a_drop_without_one_hides_none(tally):
    tally.dropped(Judgement.IMPLAUSIBLE, "counts to a million")
    tally.dropped(Judgement.IMPLAUSIBLE, "counts to two")
    tally.dropped(Judgement.STALE)
    assert (tally.take_fault(), tally.take_fault()) == ("counts to two", "")
