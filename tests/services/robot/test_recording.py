import numpy as np
import pytest

from services.robot.recording import Recording
from sim.pose import Pose

IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])


def pose(x):
    return Pose(np.array([x, 0.0, 0.0]), IDENTITY)


def recorded(ticks):
    recording = Recording(0.01)
    for k in range(ticks):
        recording.add(0.01 * k, pose(0.1 * k), pose(0.1 * k + 1.0), pose(0.1 * k + 2.0))
    return recording


def test_motions_have_as_many_way_points_in_the_time_that_was_moved():
    motions = recorded(101).motions(75, pose(0.0))
    for offset, motion in enumerate((motions.refined, motions.commanded, motions.measured)):
        np.testing.assert_allclose(motion.positions[:, 0], np.linspace(offset, offset + 10.0, 75))
        assert motion.duration == pytest.approx(1.0)


def test_a_time_is_recorded_once():
    recording = recorded(3)
    recording.add(0.02, pose(9.0), pose(9.0), pose(9.0))
    assert recording.motions(2, pose(0.0)).refined.positions[-1, 0] == pytest.approx(0.2)


def test_an_execution_that_never_moved_is_a_motion_that_stands():
    motions = Recording(0.01).motions(75, pose(3.0))
    np.testing.assert_allclose(motions.measured.positions, np.tile([3.0, 0.0, 0.0], (75, 1)))
    assert motions.measured.duration == 0.01
