"""A motion at another pace, in a pause and on its way back: where it goes, and what is recorded of it."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lfd.motion.resampling import Interpolation, at_phases
from lfd.motion.trajectory import Trajectory
from services.robot.correction import UNCORRECTED, Correction
from services.robot.episode import Episode
from services.robot.execution import Execution, look_ahead
from sim.pose import Pose

PERIOD = 0.01
UPRIGHT = np.array([1.0, 0.0, 0.0, 0.0])
DURATION = 7.4  # [s], a look-ahead of 0.1 s
HERE = Pose(np.zeros(3), UPRIGHT)


def prediction():
    t = np.linspace(0.0, DURATION, 75)
    return Trajectory(np.stack([0.02 * t, 0.001 * t**2, 0.0 * t], axis=-1), np.tile(UPRIGHT, (75, 1)), DURATION)


def up(height):
    return Correction(np.array([0.0, 0.0, height]), np.zeros(3))


def under_way(part=(0.0, 1.0)):
    motion = prediction()
    execution = Execution(HERE, motion, look_ahead(motion), PERIOD, part)
    while execution.ramping:
        execution.advance(UNCORRECTED)
    return execution


def go_to(execution, progress, wanted=UNCORRECTED):
    """Go on, forward or back, until a share of the prediction is passed."""
    ahead = execution.progress < progress
    while (execution.progress < progress) is ahead and not execution.finished:
        execution.advance(wanted)


def paused(execution):
    execution.go(0.0)
    while execution.pace.rate:
        execution.advance(UNCORRECTED)
    return execution


def test_at_its_own_pace_the_prediction_is_tracked_to_the_last_bit():
    motion, execution = prediction(), under_way()
    times = np.minimum(np.arange(741) * PERIOD, DURATION)
    expected = at_phases(motion, times / DURATION, Interpolation.CUBIC)
    for tick in range(1, 741):
        assert execution.advance(UNCORRECTED).position.tobytes() == expected.positions[tick].tobytes()
    assert execution.finished


@settings(max_examples=20)
@given(st.floats(0.1, 2.0))
def test_the_pace_changes_when_the_arm_is_somewhere_and_never_where_it_goes(rate):
    """A hand that rests, pushes and rests again leads along o(t) of eq. 15-17 in the prediction's time, at any pace."""
    execution = under_way()
    execution.go(rate)
    go_to(execution, 0.3)
    pushed_at = execution.time
    go_to(execution, 0.6, up(0.1))
    released, left_at = execution.correction.offset[2], execution.time
    assert released == pytest.approx(0.1 * -np.expm1(-(left_at - pushed_at) / look_ahead(prediction())), rel=1e-9)
    go_to(execution, 0.62)
    decayed = released * np.exp(-(execution.time - left_at) / look_ahead(prediction()))
    assert execution.correction.offset[2] == pytest.approx(decayed, rel=1e-9)
    np.testing.assert_allclose(
        execution.reference.position, [0.02 * execution.time, 0.001 * execution.time**2, decayed], atol=1e-9
    )


@settings(max_examples=20)
@given(st.floats(0.1, 2.0))
def test_it_comes_to_its_end_at_any_pace(rate):
    execution = under_way()
    execution.go(rate)
    for _ in range(round(DURATION / PERIOD / rate) + 60):
        execution.advance(UNCORRECTED)
    assert (execution.finished, execution.progress, execution.time) == (True, 1.0, DURATION)
    np.testing.assert_array_equal(execution.reference.position, prediction().positions[-1])


def test_in_a_pause_motion_and_correction_stand_whatever_the_hand_does():
    execution = under_way()
    go_to(execution, 0.3, up(0.1))
    paused(execution)
    before = execution.reference.position
    for _ in range(100):
        np.testing.assert_array_equal(execution.advance(up(0.2)).position, before)


def test_the_way_back_is_the_way_that_was_gone_corrections_and_all():
    execution = under_way()
    way = {0: execution.reference.position}
    for tick in range(1, 301):
        way[tick] = execution.advance(up(0.1 * np.sin(tick / 40.0))).position
    execution.go(-0.8)
    while execution.progress > 0.0:
        position = execution.advance(up(0.3)).position
        at = execution.time / PERIOD
        low = min(int(at), 340)
        if low + 1 in way:
            between = way[low] + (at - low) * (way[low + 1] - way[low])
            np.testing.assert_allclose(position, between, atol=2e-6)
    np.testing.assert_allclose(execution.reference.position, way[0], atol=1e-9)
    assert not execution.finished


def test_nothing_jumps_whatever_pace_is_asked_for():
    execution = under_way()
    rng = np.random.default_rng(5)
    before, speeds = execution.reference.position, []
    for tick in range(3000):
        if tick % 25 == 0:
            execution.go(float(rng.uniform(-2.0, 2.0)))
        position = execution.advance(up(0.05)).position
        speeds.append(np.linalg.norm(position - before) / PERIOD)
        before = position
        if execution.finished:
            break
    assert max(speeds) <= 2.0 * (0.05 / look_ahead(prediction()) + 0.05)


def test_a_ramp_stands_in_a_pause_and_takes_longer_at_a_slower_pace():
    def ticks(rate):
        execution, count = Execution(Pose(np.array([0.0, 0.1, 0.0]), UPRIGHT), prediction(), 0.1, PERIOD), 0
        execution.pace.rate = rate
        execution.go(rate)
        while execution.ramping and count < 1000:
            execution.advance(UNCORRECTED)
            count += 1
        return count

    assert (ticks(1.0), ticks(2.0), ticks(0.5), ticks(0.0)) == (67, 67, 134, 1000)


def test_a_step_back_is_one_of_the_share_that_was_asked_for():
    execution = under_way()
    go_to(execution, 0.5)
    execution.go(-1.0, 0.45)
    for _ in range(200):
        execution.advance(UNCORRECTED)
    assert execution.progress == pytest.approx(0.45, abs=1e-9)
    assert execution.pace.rate == 0.0


class Recorded:
    """An episode past its ramp, whose arm does what it is told."""

    def __init__(self):
        self.episode = Episode(Execution(HERE, prediction(), look_ahead(prediction()), PERIOD), PERIOD)
        while self.episode.execution.ramping:
            self.tick(UNCORRECTED)

    def tick(self, wanted):
        reference = self.episode.advance(wanted, HERE)
        self.episode.record(reference, reference, reference, clamped=False)

    def go(self, rate, until, wanted=UNCORRECTED):
        execution = self.episode.execution
        execution.go(rate, until)
        while execution.pace.asked and not execution.finished:
            self.tick(wanted)

    def refined(self, verdict):
        return self.episode.outcome(verdict, HERE).refined


@pytest.fixture
def verdict():
    from tests.services.robot.test_episode import WELL

    return WELL


def test_of_what_is_passed_twice_the_last_pass_is_recorded(verdict):
    twice, once = Recorded(), Recorded()
    twice.go(1.0, 0.6, up(0.2))
    twice.go(-1.5, 0.2)
    start = twice.episode.execution.correction
    once.go(1.0, 0.2, up(0.2))
    np.testing.assert_allclose(start.offset, once.episode.execution.correction.offset, atol=1e-9)
    for one in (twice, once):
        one.go(1.0, 1.0, up(-0.1))
    refined, expected = twice.refined(verdict), once.refined(verdict)
    assert refined.duration == pytest.approx(DURATION)
    np.testing.assert_allclose(refined.positions, expected.positions, atol=1e-5)


def test_what_ends_on_the_way_back_is_as_far_as_it_then_is(verdict):
    recorded = Recorded()
    recorded.go(1.0, 0.6, up(0.1))
    recorded.go(-1.0, 0.25)
    refined = recorded.refined(verdict)
    assert refined.duration == pytest.approx(0.25 * DURATION, abs=PERIOD)
    assert refined.positions[-1, 0] == pytest.approx(0.02 * 0.25 * DURATION, abs=1e-3)


def test_the_pace_leaves_no_trace_in_what_is_recorded(verdict):
    paced, steady = Recorded(), Recorded()
    paced.go(0.3, 0.4, UNCORRECTED)
    paced.go(2.0, 1.0, UNCORRECTED)
    steady.go(1.0, 1.0, UNCORRECTED)
    np.testing.assert_allclose(paced.refined(verdict).positions, steady.refined(verdict).positions, atol=1e-6)
    assert paced.refined(verdict).duration == pytest.approx(steady.refined(verdict).duration, abs=1e-9)


def test_a_part_is_corrected_and_what_comes_after_it_goes_back_to_the_prediction_as_after_a_release():
    execution = under_way(part=(0.3, 0.5))
    go_to(execution, 0.3, up(0.1))
    assert not execution.correction.offset.any()
    began = execution.time
    go_to(execution, 0.5, up(0.1))
    assert execution.correction.offset[2] == pytest.approx(
        0.1 * -np.expm1(-(execution.time - began) / look_ahead(prediction())), rel=0.02
    )
    execution.advance(up(0.1))
    released, ended = execution.correction.offset[2], execution.time
    go_to(execution, 0.6, up(0.1))
    decayed = released * np.exp(-(execution.time - ended) / look_ahead(prediction()))
    assert execution.correction.offset[2] == pytest.approx(decayed, rel=1e-9)
