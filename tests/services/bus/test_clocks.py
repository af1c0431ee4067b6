"""How old a sample of another machine's is: the clocks' offset does not matter, drifts, jumps, and is not forged."""

import random

import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.bus.clocks import AGREEING, DRIFT_PPM, LONG_NS, NEAR_NS, RELEARN_NS, Clocks
from services.bus.identity import new_publisher

MS = 1_000_000
SECOND = 1000 * MS
OWN = new_publisher()
SAME_MACHINE = OWN ^ 1
OTHER_MACHINE = OWN ^ (1 << 50)
THIRD_MACHINE = OWN ^ (1 << 51)
START = 10**18
PERIOD = 10 * MS
STALE_NS = 100 * MS


class Link:
    """Samples of another machine at 100 Hz, and the ages that they are judged to have.

    Args:
        offset_ns: of its clock below ours.
        way_ns: that a sample takes, before what varies.
        jitter_ns: what varies at most.
    """

    def __init__(self, offset_ns=0, way_ns=5 * MS, jitter_ns=8 * MS, seed=0):
        self.clocks = Clocks(OWN)
        self.now_ns, self.offset_ns, self.way_ns, self.jitter_ns = START, offset_ns, way_ns, jitter_ns
        self._random = random.Random(seed)

    def sample(self, *, late_ns=0, publisher=OTHER_MACHINE):
        self.now_ns += PERIOD
        way = self.way_ns + self._random.randrange(self.jitter_ns + 1) + late_ns
        return self.clocks.age_ns(publisher, self.now_ns - way - self.offset_ns, self.now_ns)

    def run(self, seconds, **how):
        return [self.sample(**how) for _ in range(round(seconds * SECOND / PERIOD))]


def timely(ages):
    return [-NEAR_NS <= age <= STALE_NS for age in ages]


def test_on_one_machine_stamps_compare_directly():
    clocks = Clocks(OWN)
    assert clocks.age_ns(SAME_MACHINE, START - 7, START) == 7
    assert clocks.age_ns(SAME_MACHINE, START + 7, START) == -7
    assert clocks.age_ns(SAME_MACHINE, START - SECOND, START) == SECOND
    assert clocks.shared_with(SAME_MACHINE)
    assert not clocks.shared_with(OTHER_MACHINE)


@given(offset=st.integers(-(10**17), 10**17), way=st.integers(0, 300), seed=st.integers(0, 99))
def test_an_age_is_what_a_sample_took_more_than_the_fastest(offset, way, seed):
    link = Link(offset, way * MS, seed=seed)
    assert all(timely(link.run(1.0)))
    assert link.sample(late_ns=300 * MS) == pytest.approx(300 * MS, abs=2 * link.jitter_ns)
    assert all(timely(link.run(0.5)))


@pytest.mark.parametrize("ppm", [-500, -50, 50, 500])
def test_clocks_that_drift_apart_stay_comparable(ppm):
    link = Link()
    for _ in range(60):
        link.offset_ns += round(ppm * 1e-6 * 60 * SECOND)
        link.now_ns += 60 * SECOND - SECOND
        assert all(timely(link.run(1.0)))


def test_what_is_forgotten_is_no_more_than_drift_asks_for():
    link = Link(jitter_ns=0)
    link.sample()
    for _ in range(100):
        link.sample(late_ns=90 * MS)
    assert link.sample(late_ns=90 * MS) == pytest.approx(90 * MS - DRIFT_PPM * 1e-6 * 101 * PERIOD, abs=200)


@given(
    jump=st.one_of(st.integers(-(10**7), -150), st.integers(300, 10**7)),
    seed=st.integers(0, 99),
    silent=st.booleans(),
)
def test_a_clock_that_jumped_either_way_is_learnt_anew_within_two_seconds(jump, seed, silent):
    """As after sleep of either machine, whose clock stood still meanwhile, or of a virtual one that was moved."""
    link = Link(seed=seed)
    link.run(1.0)
    link.offset_ns += jump * MS
    link.now_ns += abs(jump) * MS if silent else 0
    away = link.run(2.0)
    assert not any(timely(away[:10])), "at once nobody can know it"
    assert all(timely(link.run(3.0)))


def test_a_machine_that_is_heard_once_a_second_is_learnt_anew_too():
    clocks, now = Clocks(OWN), START
    for offset, wanted in ((0, [0, 0, 0]), (10**6 * MS, [10**6 * MS, 0, 0])):
        ages = []
        for _ in range(3):
            now += SECOND + MS
            ages.append(clocks.age_ns(OTHER_MACHINE, now - offset, now))
        assert ages == pytest.approx(wanted, abs=5 * MS)


def test_a_queue_that_fills_little_by_little_is_late_for_as_long_as_it_stands():
    link = Link()
    link.run(2.0)
    for i in range(100):
        link.sample(late_ns=i * 6 * MS)
    assert not any(timely(link.run(60.0, late_ns=600 * MS)))
    assert all(timely(link.run(1.0)))


def test_what_piled_up_behind_a_cut_is_late_to_the_last_one():
    link = Link(jitter_ns=0)
    link.run(2.0)
    first = link.now_ns + PERIOD
    link.now_ns += 3 * SECOND
    ages = [link.clocks.age_ns(OTHER_MACHINE, first + i * PERIOD - link.way_ns, link.now_ns) for i in range(280)]
    assert not any(timely(ages))
    assert all(timely(link.run(1.0)))


def test_a_single_late_sample_in_a_thousand_changes_nothing():
    link = Link()
    link.run(1.0)
    for _ in range(10):
        assert not timely([link.sample(late_ns=5 * SECOND)])[0]
        assert all(timely(link.run(1.0)))


@pytest.mark.parametrize("ahead_ms", [30, 90, 110, 600, 4_990, 10_000])
def test_stamps_that_somebody_made_up_do_not_make_the_true_sender_late(ahead_ms):
    link = Link()
    link.run(2.0)
    for _ in range(20):
        link.sample(late_ns=-ahead_ms * MS)
        assert all(timely(link.run(0.5)))


def test_a_baseline_that_was_made_up_while_the_machine_was_silent_does_not_outlive_two_seconds_of_it():
    link = Link()
    link.run(2.0)
    link.run(3.0, late_ns=-4_990 * MS)
    link.run(2.0)
    assert all(timely(link.run(2.0)))


def test_a_first_sample_that_was_two_seconds_old_is_found_out_within_two_seconds():
    link = Link(jitter_ns=0)
    link.sample(late_ns=2_500 * MS)
    link.run(2.0)
    assert link.sample() == pytest.approx(0, abs=2 * MS)
    assert not timely([link.sample(late_ns=500 * MS)])[0]


def test_the_baseline_falls_to_what_several_samples_agree_on():
    link = Link(jitter_ns=0)
    link.sample(late_ns=60 * MS)
    ages = [link.sample() for _ in range(AGREEING + 1)]
    assert ages[0] == pytest.approx(-60 * MS, abs=MS)
    assert ages[-1] == pytest.approx(0, abs=MS)


def test_after_a_long_silence_the_clocks_may_have_drifted():
    for drifted in (-1, 1):
        link = Link(jitter_ns=0)
        link.run(1.0)
        silence = 3600 * SECOND
        link.now_ns += silence
        link.offset_ns += drifted * round(500e-6 * silence)
        assert timely([link.sample()])[0]
        assert all(timely(link.run(1.0)))
    link.now_ns += 2 * LONG_NS
    link.offset_ns -= SECOND
    assert not timely([link.sample()])[0], "so far no clock drifts"


def test_processes_of_a_machine_share_its_clock_and_machines_do_not():
    link = Link()
    link.run(1.0)
    assert not timely([link.sample(late_ns=SECOND, publisher=OTHER_MACHINE ^ 1)])[0]
    assert link.sample(late_ns=SECOND, publisher=THIRD_MACHINE) == 0
    link.run(2.0, late_ns=5 * SECOND, publisher=THIRD_MACHINE ^ 1)
    assert all(timely(link.run(1.0)))


def test_early_samples_that_are_not_alike_teach_nothing():
    link = Link(jitter_ns=0)
    link.run(1.0)
    for i in range(400):
        assert link.sample(late_ns=-(1 + i) * 3 * NEAR_NS) < -NEAR_NS


def test_it_takes_as_long_as_said_to_learn_a_jump():
    link = Link(jitter_ns=0)
    link.run(1.0)
    link.offset_ns += 3600 * SECOND
    ages = link.run(2.0)
    assert timely(ages).index(True) == RELEARN_NS // PERIOD


@pytest.mark.parametrize(("between", "agree"), [(10, True), (20, False)])
def test_samples_agree_that_are_among_the_newest_ones(between, agree):
    link = Link(jitter_ns=0)
    link.run(1.0)
    for _ in range(AGREEING):
        age = link.sample(late_ns=-30 * MS)
        for _ in range(between):
            link.sample()
    age = link.sample(late_ns=-30 * MS)
    assert (abs(age) < MS) is agree


def test_a_queue_that_drains_and_stands_is_no_clock_and_a_clock_that_settles_is_one():
    link = Link(jitter_ns=0)
    link.run(1.0)
    link.offset_ns += 3600 * SECOND
    link.now_ns += 5 * SECOND
    for late in (900, 700, 500, 300):  # what piled up first
        link.sample(late_ns=late * MS)
    assert all(timely(link.run(3.0)[200:]))


def test_samples_that_grow_late_and_then_stand_are_not_taken_for_a_clock():
    link = Link(jitter_ns=0)
    link.run(1.0)
    for late in range(0, 4000, 40):
        link.sample(late_ns=late * MS)
    assert not any(timely(link.run(5.0, late_ns=4000 * MS)))


def test_what_is_learnt_anew_is_the_fastest_of_the_samples_that_were_away():
    link = Link(jitter_ns=0)
    link.run(1.0)
    link.offset_ns += 3600 * SECOND
    link.sample(late_ns=80 * MS)
    ages = link.run(2.0)
    assert next(age for age in ages if abs(age) <= NEAR_NS) == pytest.approx(0, abs=MS), "from the first one on"
    assert link.sample() == pytest.approx(0, abs=MS)
    assert link.sample(late_ns=120 * MS) == pytest.approx(120 * MS, abs=2 * MS)


def test_the_first_sample_is_one_of_those_that_agree():
    link = Link(jitter_ns=0)
    link.sample()
    link.now_ns += 10 * SECOND
    assert link.sample(late_ns=3 * MS) == pytest.approx(-3 * MS, abs=MS / 10), "6 ms were forgotten meanwhile"
    assert link.sample(late_ns=3 * MS) == pytest.approx(0, abs=MS / 10)


def test_it_takes_three_that_agree():
    link = Link(jitter_ns=0)
    link.sample()
    link.sample(late_ns=-30 * MS)
    assert link.sample(late_ns=-50 * MS) == pytest.approx(-50 * MS, abs=MS), "two of three are slower"
    assert link.sample(late_ns=-30 * MS) == pytest.approx(0, abs=MS)
