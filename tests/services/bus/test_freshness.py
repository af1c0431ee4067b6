"""Late, future-stamped, out-of-order and repeated samples do not count, and nobody is silenced by made-up ones."""

import random

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
PERIOD = 10 * MS
STALE_NS = 100 * MS


@pytest.fixture
def freshness():
    return Freshness(STALE_NS, OWN, 100.0)


def test_a_timely_sample_is_fresh(freshness):
    assert freshness.judge(SAME_MACHINE, 1, HOUR, HOUR + MS) is Judgement.FRESH


def test_a_sample_is_stale_from_the_age_that_the_topic_gives_it(freshness):
    assert freshness.judge(SAME_MACHINE, 1, HOUR, HOUR + STALE_NS) is Judgement.FRESH
    assert freshness.judge(SAME_MACHINE, 2, HOUR, HOUR + STALE_NS + 1) is Judgement.STALE


def test_a_late_sample_with_a_made_up_number_does_not_silence_its_sender(freshness):
    freshness.judge(SAME_MACHINE, 1, HOUR, HOUR)
    assert freshness.judge(SAME_MACHINE, 2**53, 0, HOUR) is Judgement.STALE
    assert freshness.judge(SAME_MACHINE, 2, HOUR, HOUR) is Judgement.FRESH


def test_events_are_never_stale():
    assert Freshness(None, OWN, 100.0).judge(SAME_MACHINE, 1, 0, HOUR) is Judgement.FRESH
    other = Freshness(None, OWN, 100.0)
    other.judge(OTHER_MACHINE, 1, HOUR, HOUR)
    assert other.judge(OTHER_MACHINE, 2, HOUR, 2 * HOUR) is Judgement.FRESH


def test_a_stamp_from_the_future_is_refused(freshness):
    assert freshness.judge(SAME_MACHINE, 1, HOUR + 5 * MS, HOUR) is Judgement.FRESH
    assert freshness.judge(SAME_MACHINE, 2, HOUR + 5 * MS + 1, HOUR) is Judgement.FUTURE
    freshness.judge(OTHER_MACHINE, 1, HOUR, HOUR)
    assert freshness.judge(OTHER_MACHINE, 2, HOUR + 100 * MS, HOUR) is Judgement.FRESH
    assert freshness.judge(OTHER_MACHINE, 3, HOUR + 101 * MS, HOUR) is Judgement.FUTURE


@given(st.lists(st.integers(min_value=1, max_value=30), min_size=1, max_size=40))
def test_only_growing_sequences_are_fresh(sequences):
    freshness = Freshness(STALE_NS, OWN, 100.0)
    newest = 0
    for sequence in sequences:
        judgement = freshness.judge(SAME_MACHINE, sequence, HOUR, HOUR)
        assert judgement is (Judgement.FRESH if sequence > newest else Judgement.REPEATED)
        newest = max(newest, sequence)


@given(data=st.data(), publisher=st.sampled_from([SAME_MACHINE, OTHER_MACHINE]))
def test_of_what_a_network_loses_swaps_and_doubles_the_newest_counts_once_and_in_order(data, publisher):
    sent = [(i + 1, HOUR + i * PERIOD) for i in range(40)]
    order = data.draw(st.permutations(range(40)))
    came = sorted(
        (i + min(3, order[i] % 5), i)
        for i in range(40)
        if data.draw(st.booleans()) or i == 0
        for _ in range(1 + order[i] % 2)
    )
    freshness, newest = Freshness(STALE_NS, OWN, 100.0), 0
    for slot, i in came:
        judgement = freshness.judge(publisher, *sent[i], HOUR + slot * PERIOD)
        assert judgement is (Judgement.FRESH if i + 1 > newest else Judgement.REPEATED)
        newest = max(newest, i + 1)


def test_a_restarted_sender_counts_from_one_again(freshness):
    freshness.judge(SAME_MACHINE, 500, HOUR, HOUR)
    assert freshness.judge(SAME_MACHINE ^ 2, 1, HOUR, HOUR) is Judgement.FRESH


def test_a_sender_whose_clock_went_back_goes_on_by_its_numbers():
    freshness = Freshness(None, OWN, 100.0)
    freshness.judge(OTHER_MACHINE, 1, HOUR, HOUR)
    assert freshness.judge(OTHER_MACHINE, 2, HOUR - 5 * MS, HOUR) is Judgement.FRESH
    assert freshness.judge(OTHER_MACHINE, 2, HOUR, HOUR) is Judgement.REPEATED, "and the same number is the same sample"


@pytest.mark.parametrize("publisher", [SAME_MACHINE, OTHER_MACHINE], ids=["same machine", "other machine"])
@pytest.mark.parametrize("ahead", [1, 60, 10**5, 10**6, 2**53])
@pytest.mark.parametrize("stamped_ms", [-20, 0, 4, 90, 4_990])
def test_a_copied_publisher_with_a_number_or_stamp_ahead_silences_nobody(publisher, ahead, stamped_ms):
    freshness, judged = Freshness(STALE_NS, OWN, 100.0), []
    for i in range(300):
        now = HOUR + i * PERIOD
        judged.append(freshness.judge(publisher, i + 1, now - MS, now))
        if i % 20 == 5:
            freshness.judge(publisher, i + 1 + ahead, now + stamped_ms * MS, now)
    lost = [judgement for judgement in judged if judgement is not Judgement.FRESH]
    assert len(lost) <= len(judged) // 20 * max(1, min(stamped_ms * MS // PERIOD + 1, 10))
    assert judged[-1] is Judgement.FRESH


def test_a_number_that_nobody_can_have_come_to_is_implausible(freshness):
    assert freshness.judge(SAME_MACHINE, 2**53, HOUR, HOUR) is Judgement.IMPLAUSIBLE
    most = 100_000 + 10 * 100 * 3600  # at ten times the topic's 100 Hz since the machine started
    assert freshness.judge(SAME_MACHINE, most + 1, HOUR, HOUR) is Judgement.IMPLAUSIBLE
    assert freshness.judge(SAME_MACHINE, most, HOUR, HOUR) is Judgement.FRESH


@pytest.mark.parametrize("lost_s", [0.5, 60, 86_400])
def test_a_sender_is_fresh_after_any_loss(freshness, lost_s):
    sent = 0
    for _ in range(2):
        for _ in range(10):
            sent += 1
            now = HOUR + sent * PERIOD
            assert freshness.judge(SAME_MACHINE, sent, now, now) is Judgement.FRESH
        sent += round(100 * lost_s)


@given(offset=st.integers(min_value=-(10**18), max_value=10**18))
def test_the_offset_of_another_machines_clock_does_not_matter(offset):
    freshness = Freshness(STALE_NS, OWN, 100.0)
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


def test_a_sender_that_slept_is_fresh_again_within_two_seconds_of_waking(freshness):
    """Case 1: a clock that stands still meanwhile."""
    for slept in (-60_000 * MS, 60_000 * MS):
        other = Freshness(STALE_NS, OWN, 100.0)
        judged = [
            other.judge(OTHER_MACHINE, i + 1, HOUR + i * PERIOD - (slept if i >= 100 else 0), HOUR + i * PERIOD)
            for i in range(400)
        ]
        assert set(judged[:100]) | set(judged[300:]) == {Judgement.FRESH}


def flood(freshness, count, process, now):
    """Publishers that somebody invents."""
    rng = random.Random(0)
    for _ in range(count):
        freshness.judge(OTHER_MACHINE ^ rng.getrandbits(46), 1, now, now, process)


@pytest.mark.parametrize("process", ["robot", "robot-2"])
def test_a_replay_stays_one_however_many_publishers_are_invented(process):
    freshness = Freshness(None, OWN, 100.0)
    assert freshness.judge(OTHER_MACHINE, 7, HOUR, HOUR, "robot") is Judgement.FRESH
    flood(freshness, 1000, process, HOUR)
    assert freshness.judge(OTHER_MACHINE, 7, HOUR, HOUR + 5000 * MS, "robot") is Judgement.REPEATED
    assert freshness.judge(OTHER_MACHINE, 8, HOUR + 5000 * MS, HOUR + 5000 * MS, "robot") is Judgement.FRESH


def test_an_old_sample_is_stale_though_nobody_remembers_its_sender(freshness):
    for i in range(10):
        freshness.judge(OTHER_MACHINE, i + 1, HOUR + i * PERIOD, HOUR + i * PERIOD)
    assert freshness.judge(OTHER_MACHINE ^ 1, 3, HOUR, HOUR + 5000 * MS) is Judgement.STALE


@pytest.mark.parametrize(("stale_ns", "remembered_ns"), [(STALE_NS, STALE_NS), (None, 60_000 * MS)])
def test_a_new_incarnation_finds_room_once_the_invented_ones_could_not_be_replayed(stale_ns, remembered_ns):
    freshness = Freshness(stale_ns, OWN, 100.0)
    for i in range(16):
        assert freshness.judge(SAME_MACHINE ^ (2 + i), 1, HOUR, HOUR, "robot") is Judgement.FRESH
    late = HOUR + remembered_ns
    assert freshness.judge(SAME_MACHINE, 1, late, late, "robot") is Judgement.IMPLAUSIBLE
    assert freshness.judge(SAME_MACHINE ^ 2, 2, late, late, "robot") is Judgement.FRESH, "who is known goes on"
    assert freshness.judge(SAME_MACHINE, 1, late, late, "station") is Judgement.FRESH, "other names have their own room"
    assert freshness.judge(SAME_MACHINE, 1, late + 1, late + 1, "robot") is Judgement.FRESH
    assert freshness.judge(SAME_MACHINE ^ 2, 2, late, late + 1, "robot") is Judgement.REPEATED, "who was heard stays"


def test_names_are_as_bounded_as_incarnations():
    freshness = Freshness(STALE_NS, OWN, 100.0)
    for i in range(256):
        assert freshness.judge(SAME_MACHINE, 1, HOUR, HOUR, f"master-{i}") is Judgement.FRESH
    assert freshness.judge(SAME_MACHINE, 1, HOUR, HOUR, "master") is Judgement.IMPLAUSIBLE
    assert freshness.judge(SAME_MACHINE, 2, HOUR + MS, HOUR + MS, "master-0") is Judgement.FRESH
    later = HOUR + STALE_NS + 1
    assert freshness.judge(SAME_MACHINE, 1, later, later, "master") is Judgement.FRESH
    assert freshness.judge(SAME_MACHINE, 2, HOUR + MS, later, "master-0") is Judgement.REPEATED


def test_a_refused_newcomer_is_not_remembered(freshness):
    for i in range(16):
        freshness.judge(SAME_MACHINE ^ (2 + i), 1, HOUR, HOUR)
    for _ in range(2):
        assert freshness.judge(SAME_MACHINE, 1, HOUR, HOUR) is Judgement.IMPLAUSIBLE
