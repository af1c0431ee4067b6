"""Late, future-stamped, out-of-order and repeated samples do not count."""

import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.bus.freshness import Freshness, Judgement
from services.bus.identity import new_publisher

MS = 1_000_000
OWN = new_publisher()
SAME_MACHINE = OWN ^ 1
OTHER_MACHINE = OWN ^ (1 << 50)
HOUR = 3_600_000 * MS


@pytest.fixture
def freshness():
    return Freshness(100 * MS, OWN)


def test_a_timely_sample_is_fresh(freshness):
    assert freshness.judge(SAME_MACHINE, 1, HOUR, HOUR + MS) is Judgement.FRESH


def test_a_late_sample_is_stale(freshness):
    assert freshness.judge(SAME_MACHINE, 1, HOUR, HOUR + 101 * MS) is Judgement.STALE


def test_a_late_sample_with_a_made_up_number_does_not_silence_its_sender(freshness):
    freshness.judge(SAME_MACHINE, 1, HOUR, HOUR)
    assert freshness.judge(SAME_MACHINE, 10**6, 0, HOUR) is Judgement.STALE
    assert freshness.judge(SAME_MACHINE, 2, HOUR, HOUR) is Judgement.FRESH


def test_events_are_never_stale():
    assert Freshness(None, OWN).judge(SAME_MACHINE, 1, 0, HOUR) is Judgement.FRESH


def test_a_stamp_from_the_future_is_refused(freshness):
    assert freshness.judge(SAME_MACHINE, 1, HOUR + 20 * MS, HOUR) is Judgement.FUTURE


@given(st.lists(st.integers(min_value=1, max_value=30), min_size=1, max_size=40))
def test_only_growing_sequences_are_fresh(sequences):
    freshness = Freshness(100 * MS, OWN)
    newest = 0
    for sequence in sequences:
        judgement = freshness.judge(SAME_MACHINE, sequence, HOUR, HOUR)
        assert judgement is (Judgement.FRESH if sequence > newest else Judgement.REPEATED)
        newest = max(newest, sequence)


def test_a_restarted_sender_counts_from_one_again(freshness):
    freshness.judge(SAME_MACHINE, 500, HOUR, HOUR)
    assert freshness.judge(SAME_MACHINE ^ 2, 1, HOUR, HOUR) is Judgement.FRESH


@given(offset=st.integers(min_value=-(10**18), max_value=10**18))
def test_the_offset_of_another_machines_clock_does_not_matter(offset):
    freshness = Freshness(100 * MS, OWN)
    now = 2 * 10**18
    assert freshness.judge(OTHER_MACHINE, 1, now + offset, now + 5 * MS) is Judgement.FRESH
    later = now + 1000 * MS
    assert freshness.judge(OTHER_MACHINE, 2, later + offset, later + 50 * MS) is Judgement.FRESH
    assert freshness.judge(OTHER_MACHINE, 3, later + offset, later + 200 * MS) is Judgement.STALE


def test_what_piled_up_behind_a_cut_link_is_stale(freshness):
    now = HOUR
    for i in range(100):
        freshness.judge(OTHER_MACHINE, i + 1, now + i * 10 * MS, now + i * 10 * MS + 20 * MS)
    sent = [now + 1000 * MS + i * 10 * MS for i in range(100)]
    restored = now + 3000 * MS
    judgements = [freshness.judge(OTHER_MACHINE, 101 + i, stamp, restored) for i, stamp in enumerate(sent)]
    assert set(judgements) == {Judgement.STALE}


def test_clocks_that_drift_apart_stay_comparable(freshness):
    """50 ppm for an hour is 180 ms, more than the age at which samples are stale."""
    judgements = set()
    for i in range(36_000):
        received = HOUR + i * 100 * MS
        judgements.add(freshness.judge(OTHER_MACHINE, i + 1, received - int(i * 100 * MS * 50e-6), received))
    assert judgements == {Judgement.FRESH}
