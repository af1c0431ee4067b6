"""Franka's Panda with its hand: an arm of seven joints.

Speeds and positions are the description's, accelerations and jerks the maker's.
"""

import math

from sim.region import Region
from sim.robots.gripper import Block, Finger, Gripper, Mount
from sim.robots.robot import Base, Joint, Manipulator, Source, mast_camera, wrist_camera

_HAND = Gripper(
    # The hand points along its z axis, and its fingers open along y.
    mount=Mount("panda_hand", rpy=(0.0, -math.pi / 2, 0.0)),
    blocks=(
        Block("hand", (0.033, 0.0, 0.0), (0.066, 0.204, 0.063)),
        Block("left_finger", (0.085, 0.05, 0.0), (0.054, 0.02, 0.022)),
        Block("right_finger", (0.085, -0.05, 0.0), (0.054, 0.02, 0.022)),
    ),
    grasp_distance=0.1034,
    opening=0.08,
    camera=(0.02, 0.0, -0.055),
    fingers=(Finger("panda_finger_joint1", 0.0, 0.04, 30.0), Finger("panda_finger_joint2", 0.0, 0.04, 30.0)),
)

ROBOT = Manipulator(
    kind="panda",
    reach=Region((-0.95, -0.95, -0.65), (0.95, 0.95, 1.30)),
    source=Source("robots/panda_description/urdf/panda.urdf"),
    joints=(
        Joint("panda_joint1", 4500.0, 450.0, 0.1, lag=0.01, acceleration=15.0, jerk=7500.0),
        Joint("panda_joint2", 4500.0, 450.0, 0.1, lag=0.01, acceleration=7.5, jerk=3750.0),
        Joint("panda_joint3", 3500.0, 350.0, 0.1, lag=0.01, acceleration=10.0, jerk=5000.0),
        Joint("panda_joint4", 3500.0, 350.0, 0.1, lag=0.01, acceleration=12.5, jerk=6250.0),
        Joint("panda_joint5", 2000.0, 200.0, 0.1, lag=0.015, acceleration=15.0, jerk=7500.0),
        Joint("panda_joint6", 2000.0, 200.0, 0.1, lag=0.015, acceleration=20.0, jerk=10_000.0),
        Joint("panda_joint7", 2000.0, 200.0, 0.1, lag=0.015, acceleration=20.0, jerk=10_000.0),
    ),
    gripper=_HAND,
    home=(0.0, -0.785, 0.0, -2.356, 0.0, 1.571, 0.785),
    cameras=(mast_camera(), wrist_camera()),
    base=Base((0.15, 0.0, 0.0)),
)
