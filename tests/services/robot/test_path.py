"""The prediction between the control periods."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.resampling import Interpolation, at_phases
from lfd.motion.rotations import exp_map
from lfd.motion.trajectory import Trajectory
from services.robot.execution import angle_between
from services.robot.path import Path

PERIOD = 0.01


def cubic(t):
    return np.stack([0.5 + 0.02 * t, 0.01 * t**2, 0.8 - 0.001 * t**3], axis=-1)


def turn(t):
    return exp_map(np.multiply.outer(t, np.array([0.0, 0.05, 0.0])))


def prediction(duration, n=75):
    t = np.linspace(0.0, duration, n)
    return Trajectory(cubic(t), turn(t), duration)


@given(st.floats(0.0, 1.0), st.sampled_from([0.5, 1.003, 7.4, 7.4049]))
def test_a_cubic_is_met_at_any_time(share, duration):
    path = Path(prediction(duration), PERIOD)
    at = share * path.end
    pose = path.pose(at)
    np.testing.assert_allclose(pose.position, cubic(path.time(at)), atol=1e-9)
    assert angle_between(pose.orientation, turn(path.time(at))) == pytest.approx(0.0, abs=1e-7)


def test_at_whole_periods_the_poses_are_the_prediction_s_to_the_last_bit():
    motion = prediction(7.4)
    path = Path(motion, PERIOD)
    times = np.minimum(np.arange(path.end + 1) * PERIOD, motion.duration)
    expected = at_phases(motion, times / motion.duration, Interpolation.CUBIC)
    for tick in range(path.end + 1):
        pose = path.pose(float(tick))
        assert pose.position.tobytes() == expected.positions[tick].tobytes()
        assert pose.orientation.tobytes() == expected.orientations[tick].tobytes()


@pytest.mark.parametrize(("at", "over"), [(99.9, False), (100.29, False), (100.3, True), (101.0, True)])
def test_it_is_over_when_its_duration_is_and_not_when_the_period_is(at, over):
    assert Path(prediction(1.003), PERIOD).is_over(at) is over
