"""The Robot Studio's SO-101: a small arm of five joints with a jaw that moves.

Its orientation follows from the position but for pitch and roll, so that it is a soft goal. Positions are the
description's; speeds are those of its servos under load, accelerations and jerks ours.
"""

import math

from sim.region import Region
from sim.robots.gripper import Block, Finger, Gripper, Mount
from sim.robots.robot import Base, Joint, Manipulator, Source, Stance, mast_camera, wrist_camera

_SPEED = 3.0  # [rad/s] the description's 10 are more than the servos can

_HOME = (0.0, -0.6, 0.6, 0.6, 0.0)

_MIDDLE = 0.03  # [m] from the fixed jaw
_INSIDE = 0.015  # [m] behind the jaws' tips, where they hold

_JAWS = Gripper(
    # The fixed jaw points along -z of its link, and the other one opens along x: along -y of the gripper, whose x axis
    # runs in the middle between them.
    mount=Mount("gripper_link", (-0.0079 + _MIDDLE, -0.0002, 0.0), (-math.pi / 2, math.pi / 2, 0.0)),
    blocks=(
        Block("fixed_jaw", (0.05, 0.008 + _MIDDLE, 0.0), (0.11, 0.03, 0.05)),
        Block("moving_jaw", (0.06, -0.045 + _MIDDLE, 0.0), (0.08, 0.03, 0.03)),
    ),
    grasp_distance=0.0981 - _INSIDE,
    opening=0.072,
    camera=(0.01, 0.0, -0.06),
    # The jaw turns: between its tip and the other one's it is open in proportion to the angle, within 3 mm.
    fingers=(Finger("gripper", -0.17, 0.8, effort=1.5, armature=0.005),),
    jaw="gripper_link",
    palm=(
        Block("palm", (0.017, -0.0055 + _MIDDLE, 0.0), (0.038, 0.065, 0.052)),
        Block("jaw", (0.066, 0.015 + _MIDDLE, 0.0), (0.076, 0.023, 0.018)),
    ),
)

ROBOT = Manipulator(
    kind="so101",
    reach=Region((-0.50, -0.55, -0.45), (0.60, 0.55, 0.65)),
    source=Source("robots/so_arm_description/urdf/so101.urdf"),
    joints=tuple(
        Joint(name, stiffness, damping, armature, 0.015, 20.0, 400.0, speed=_SPEED)
        for name, stiffness, damping, armature in (
            ("shoulder_pan", 120.0, 6.0, 0.02),
            ("shoulder_lift", 120.0, 6.0, 0.02),
            ("elbow_flex", 80.0, 4.0, 0.02),
            ("wrist_flex", 40.0, 1.5, 0.01),
            ("wrist_roll", 20.0, 0.8, 0.01),
        )
    ),
    gripper=_JAWS,
    home=_HOME,
    cameras=(mast_camera(), wrist_camera()),
    base=Base((0.42, -0.15, 0.55)),
    stances={"table": Stance(_HOME, base=Base((0.36, 0.0, 0.66)))},
    turn_slack=1.2,
)
