"""Joint positions for start poses."""

import numpy as np
import pytest

from services.robot.kinematics import Kinematics
from services.robot.starts import StartImpossible, Starts
from sim.pose import Pose
from sim.robots.description import prepare
from sim.tasks import REACHING, THESIS

pytestmark = pytest.mark.sim
SCENE = pytest.mark.parametrize("place", THESIS.values(), ids=THESIS)


def starts(place, self_distance=0.005):
    return Starts(Kinematics(prepare().urdf, place.posture), place.start, place.posture, self_distance)


@SCENE
def test_the_arm_stands_where_the_motion_is_to_start(place):
    kinematics = Kinematics(prepare().urdf)
    for offset in ([0.0, 0.0, 0.0], [-0.08, 0.06, 0.05]):
        pose = Pose(place.start.position + offset, place.start.orientation)
        stands = kinematics.forward(starts(place).joints(pose))
        np.testing.assert_allclose(stands.position, pose.position, atol=1e-4)
        assert abs(stands.orientation @ pose.orientation) == pytest.approx(1.0, abs=1e-6)


@pytest.mark.parametrize("place", REACHING.values(), ids=REACHING)
def test_the_start_of_every_task_is_found_however_near_to_the_joints_ends_it_is(place):
    stands = Kinematics(prepare().urdf).forward(starts(place).joints(place.start))
    np.testing.assert_allclose(stands.position, place.start.position, atol=1e-4)


@SCENE
def test_a_start_has_the_same_joint_positions_whatever_was_asked_before(place):
    near, far = (Pose(place.start.position + offset, place.start.orientation) for offset in (0.02, -0.15))
    one, other = starts(place), starts(place)
    first = one.joints(far)
    other.joints(near)
    np.testing.assert_array_equal(other.joints(far), first)
    assert one.joints(far) is first
    assert not first.flags.writeable


def test_what_is_out_of_reach_or_too_close_to_the_robot_is_refused_with_its_place():
    place = THESIS["table"]
    with pytest.raises(StartImpossible, match=r"at \(2\.600, -0\.330, 0\.740\) m: the robot does not reach") as refused:
        starts(place).joints(Pose(place.start.position + np.array([2.0, 0.0, 0.0]), place.start.orientation))
    np.testing.assert_allclose(refused.value.position, [2.6, -0.33, 0.74])
    with pytest.raises(StartImpossible, match="too close to itself"):
        starts(place, self_distance=1.0).joints(place.start)
