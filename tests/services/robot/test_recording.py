import numpy as np
import pytest

from services.robot.recording import Openings, Recording
from sim.pose import Pose

IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
OPEN = Openings(0.1, 0.1)


def pose(x):
    return Pose(np.array([x, 0.0, 0.0]), IDENTITY)


def recorded(ticks, *, grips=False):
    recording = Recording(0.01, grips=grips)
    for k in range(ticks):
        poses = (pose(0.1 * k), pose(0.1 * k + 1.0), pose(0.1 * k + 2.0))
        recording.add(0.01 * k, poses, Openings(0.01 * k, 0.02 * k - 0.001))
    return recording


def test_motions_have_as_many_way_points_in_the_time_that_was_moved():
    motions = recorded(101).motions(75, pose(0.0), OPEN)
    for offset, motion in enumerate((motions.refined, motions.commanded, motions.measured)):
        np.testing.assert_allclose(motion.positions[:, 0], np.linspace(offset, offset + 10.0, 75))
        assert motion.duration == pytest.approx(1.0)


def test_a_time_is_recorded_once():
    recording = recorded(3)
    recording.add(0.02, (pose(9.0), pose(9.0), pose(9.0)), OPEN)
    assert recording.motions(2, pose(0.0), OPEN).refined.positions[-1, 0] == pytest.approx(0.2)


def test_an_execution_that_never_moved_is_a_motion_that_stands():
    motions = Recording(0.01).motions(75, pose(3.0), OPEN)
    np.testing.assert_allclose(motions.measured.positions, np.tile([3.0, 0.0, 0.0], (75, 1)))
    assert motions.measured.duration == 0.01


def test_where_the_gripper_takes_part_the_motions_say_how_far_it_was_told_to_open_and_how_far_it_did():
    motions = recorded(11, grips=True).motions(11, pose(0.0), OPEN)
    told = 0.01 * np.arange(11)
    np.testing.assert_allclose(motions.refined.opening, told, atol=1e-12)
    np.testing.assert_allclose(motions.commanded.opening, told, atol=1e-12)
    np.testing.assert_allclose(motions.measured.opening, np.maximum(2.0 * told - 0.001, 0.0), atol=1e-12)
    assert recorded(11).motions(11, pose(0.0), OPEN).refined.opening is None


def test_an_execution_that_never_moved_has_the_opening_that_is():
    motions = Recording(0.01, grips=True).motions(5, pose(0.0), Openings(0.0, 0.05))
    assert (set(motions.refined.opening), set(motions.measured.opening)) == ({0.0}, {0.05})
