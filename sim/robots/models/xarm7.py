"""UFACTORY's xArm 7 with a gripper of two fingers: an arm of seven joints.

Speeds are the description's, positions as well, but for those of four joints that turn twice: here they turn once.
Accelerations and jerks are the maker's.
"""

import math

from sim.region import Region
from sim.robots.gripper import Mount, two_fingers
from sim.robots.robot import Base, Joint, Manipulator, Source, Stance, mast_camera, wrist_camera

_TURN = math.pi
_HOME = (0.0, -0.5, 0.0, 1.2, 0.0, 1.3, 0.0)

ROBOT = Manipulator(
    kind="xarm7",
    reach=Region((-0.95, -0.95, -0.70), (0.95, 0.95, 1.25)),
    source=Source("robots/xarm_description/urdf/xarm7.urdf"),
    joints=(
        Joint("joint1", 3000.0, 250.0, 0.1, 0.01, 20.0, 500.0, -_TURN, _TURN),
        Joint("joint2", 3000.0, 250.0, 0.1, 0.01, 20.0, 500.0),
        Joint("joint3", 2500.0, 150.0, 0.1, 0.01, 20.0, 500.0, -_TURN, _TURN),
        Joint("joint4", 2500.0, 150.0, 0.1, 0.01, 20.0, 500.0),
        Joint("joint5", 1200.0, 60.0, 0.05, 0.015, 20.0, 500.0, -_TURN, _TURN),
        Joint("joint6", 1000.0, 40.0, 0.05, 0.015, 20.0, 500.0),
        Joint("joint7", 600.0, 20.0, 0.05, 0.015, 20.0, 500.0, -_TURN, _TURN),
    ),
    gripper=two_fingers(Mount("link_eef", rpy=(0.0, -math.pi / 2, 0.0))),
    home=_HOME,
    cameras=(mast_camera(), wrist_camera()),
    base=Base((0.25, 0.0, 0.10)),
    stances={"table": Stance(_HOME, base=Base((0.20, 0.0, 0.20)))},
)
