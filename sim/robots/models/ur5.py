"""Universal Robots' UR5 with a gripper of two fingers: an arm of six joints.

Positions and speeds are the description's, but for the ranges, which are halved to one turn each: the arm needs no
more, and a search has one way fewer to wind itself up. Accelerations and jerks are ours: its maker publishes none.
"""

import math

from sim.region import Region
from sim.robots.gripper import Mount, two_fingers
from sim.robots.robot import Base, Joint, Manipulator, Source, mast_camera, wrist_camera

_TURN = math.pi

ROBOT = Manipulator(
    kind="ur5",
    reach=Region((-1.15, -1.15, -1.05), (1.15, 1.15, 1.25)),
    source=Source("robots/ur_description/urdf/ur5_robot.urdf"),
    joints=(
        Joint("shoulder_pan_joint", 4000.0, 300.0, 0.2, 0.01, 8.0, 80.0, -_TURN, _TURN),
        Joint("shoulder_lift_joint", 4000.0, 300.0, 0.2, 0.01, 8.0, 80.0, -_TURN, _TURN),
        Joint("elbow_joint", 3000.0, 200.0, 0.2, 0.01, 8.0, 80.0),
        Joint("wrist_1_joint", 1000.0, 40.0, 0.05, 0.015, 12.0, 120.0, -_TURN, _TURN),
        Joint("wrist_2_joint", 1000.0, 40.0, 0.05, 0.015, 12.0, 120.0, -_TURN, _TURN),
        Joint("wrist_3_joint", 600.0, 20.0, 0.05, 0.015, 12.0, 120.0, -_TURN, _TURN),
    ),
    gripper=two_fingers(Mount("tool0", rpy=(0.0, -math.pi / 2, 0.0))),
    home=(0.0, -1.9, 2.0, -1.67, -1.57, 0.0),
    cameras=(mast_camera(), wrist_camera()),
    base=Base((0.10, 0.0, 0.20)),
)
