"""PAL Robotics' TIAGo without a hand: lifting torso, arm of seven joints, head that pans and tilts.

Speeds and positions are the description's. Accelerations and jerks are ours: its maker publishes none.
"""

from sim.region import Region
from sim.robots.gripper import Mount, two_fingers
from sim.robots.robot import (
    ELSEWHERE,
    FIELD_OF_VIEW,
    HEAD_CAMERA,
    Camera,
    HeldJoint,
    Joint,
    Manipulator,
    Source,
    Stance,
    wrist_camera,
)

ROBOT = Manipulator(
    kind="tiago",
    # 60 000 random postures lie in the box, a tenth of a metre from its sides.
    reach=Region((-0.5, -1.05, -0.2), (1.15, 1.05, 1.95)),
    source=Source("robots/tiago_description/robots/tiago_no_hand.urdf"),
    joints=(
        Joint("torso_lift_joint", 60_000.0, 6_000.0, 5.0, lag=0.0012, acceleration=0.3, jerk=3.0),
        Joint("arm_1_joint", 1500.0, 80.0, 0.2, lag=0.01, acceleration=5.0, jerk=50.0),
        Joint("arm_2_joint", 1500.0, 80.0, 0.2, lag=0.01, acceleration=5.0, jerk=50.0),
        Joint("arm_3_joint", 1200.0, 50.0, 0.1, lag=0.01, acceleration=5.0, jerk=50.0),
        Joint("arm_4_joint", 1200.0, 50.0, 0.1, lag=0.01, acceleration=5.0, jerk=50.0),
        Joint("arm_5_joint", 400.0, 12.0, 0.05, lag=0.015, acceleration=10.0, jerk=100.0),
        Joint("arm_6_joint", 300.0, 9.0, 0.03, lag=0.015, acceleration=10.0, jerk=100.0),
        Joint("arm_7_joint", 200.0, 6.0, 0.03, lag=0.015, acceleration=10.0, jerk=100.0),
    ),
    held=(HeldJoint("head_1_joint"), HeldJoint("head_2_joint")),
    gripper=two_fingers(Mount("wrist_ft_tool_link")),
    home=(0.2830, 0.9342, 0.5981, 0.2594, 1.9075, 0.5393, 0.9049, 2.0147),
    cameras=(
        Camera(HEAD_CAMERA, Mount("xtion_rgb_optical_frame"), FIELD_OF_VIEW[HEAD_CAMERA]),
        wrist_camera(),
    ),
    stances={
        ELSEWHERE: Stance((0.2830, 0.9342, 0.5981, 0.2594, 1.9075, 0.5393, 0.9049, 2.0147), (0.1, -0.80)),
        "dishwasher": Stance((0.3108, 2.0018, -0.4902, 0.2241, 1.4798, 1.8698, 1.2060, 1.9647), (0.06, -0.88)),
        "table": Stance((0.2830, 0.9342, 0.5981, 0.2594, 1.9075, 0.5393, 0.9049, 2.0147), (0.0, -0.78)),
        "post": Stance((0.3472, 0.4551, -0.7562, -0.7061, 1.8930, 1.1598, 1.1843, 0.0924), (0.0, -0.86)),
    },
    limbs=(
        "arm_4_link",
        "arm_5_link",
        "arm_6_link",
        "gripper_palm_link",
        "gripper_left_finger_link",
        "gripper_right_finger_link",
    ),
    trunk=("base_link", "torso_fixed_column_link", "torso_lift_link_0", "head_2_link"),
)
