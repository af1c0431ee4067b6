"""What moves, as the page's scripts read it."""

import struct

import msgspec
import numpy as np

from protocol.messages import ObjectPose, Phase, Pose, RobotState
from services.station.live_view.drawing import STILL, Drawing, has_moved, moment, packed

GRASP = Pose((0.6, 0.1, 0.5), (0.0, 1.0, 0.0, 0.0))
SEEN = ObjectPose(pose=Pose((0.9, 0.0, 0.55), (1.0, 0.0, 0.0, 0.0)), tag=7)
NO_FORCE = (0.0, 0.0, 0.0)
ROBOT = RobotState(
    joint_names=("torso", "elbow"),
    q=(0.25, -1.5),
    measured=GRASP,
    reference=GRASP,
    phase=Phase.EXECUTE,
    offset=(0.0, 0.03, 0.0),
    turn=(0.1, 0.0, -0.2),
    progress=0.75,
)


def read(values):
    """As the page's scripts read it."""
    content = packed(values)
    return np.array(struct.unpack(f"<{len(content) // 4}f", content))


def test_a_moment_is_gripper_object_correction_force_and_joints_in_this_order():
    values = read(moment(ROBOT, SEEN, (0.0, 0.0, 2.0), ("elbow", "head", "torso")))
    np.testing.assert_allclose(values[0:7], [0.6, 0.1, 0.5, 0.0, 1.0, 0.0, 0.0], rtol=1e-6)
    np.testing.assert_allclose(values[7:14], [0.9, 0.0, 0.55, 1.0, 0.0, 0.0, 0.0], rtol=1e-6)
    np.testing.assert_allclose(values[14:21], [0.0, 0.03, 0.0, 0.1, 0.0, -0.2, 0.75], rtol=1e-6)
    np.testing.assert_allclose(values[21:24], [0.0, 0.0, 2.0])
    np.testing.assert_allclose(values[24:], [-1.5, np.nan, 0.25])


def test_what_trembles_stands_and_what_creeps_has_moved_at_last():
    told = moment(ROBOT, SEEN, NO_FORCE, ("elbow",))
    trembling, creeping = (msgspec.structs.replace(ROBOT, q=(0.25, -1.5 + by)) for by in (0.5 * STILL, 2.0 * STILL))
    assert not has_moved(moment(trembling, SEEN, NO_FORCE, ("elbow",)), told)
    assert has_moved(moment(creeping, SEEN, NO_FORCE, ("elbow",)), told)


def test_what_is_known_only_now_has_moved():
    unknown = moment(None, None, NO_FORCE, ("elbow",))
    assert not has_moved(unknown, moment(None, None, NO_FORCE, ("elbow",)))
    assert has_moved(moment(None, SEEN, NO_FORCE, ("elbow",)), unknown)
    assert has_moved(unknown, ())


def test_what_is_not_known_is_not_a_number():
    values = read(moment(None, None, NO_FORCE, ("elbow",)))
    assert np.all(np.isnan(values[[*range(21), 24]]))
    assert values[21:24].tolist() == [0.0, 0.0, 0.0]


def test_a_robot_that_tells_fewer_positions_than_names_moves_what_it_tells():
    cut_short = RobotState(joint_names=("a", "b"), q=(0.5,), measured=GRASP, reference=GRASP, phase=Phase.IDLE)
    assert read(moment(cut_short, None, NO_FORCE, ("a", "b")))[24:].tolist()[0] == 0.5


def test_a_drawing_is_told_part_by_part():
    assert set(Drawing().parts()) == set(Drawing.__struct_fields__)
    assert Drawing(yaw=0.5).parts()["yaw"] == 0.5
