"""The two-finger gripper: open, rigid, made of boxes.

The description that it is put on ends at the wrist's force sensor. In the gripper's frame x points
forward, and the fingers open along y; with the arm's usual roll of 180 degrees -z points up, which
is where the wrist camera sits.
"""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

GRASPING_FRAME = "grasping_frame"
WRIST_CAMERA_FRAME = "wrist_camera_frame"
PARENT_LINK = "wrist_ft_tool_link"

GRASP_DISTANCE = 0.13  # [m] from the parent link to the grasping frame
OPENING = 0.104  # [m] between the fingers


@dataclass(frozen=True)
class Block:
    """One box of the gripper, in the frame of `PARENT_LINK`.

    Attributes:
        name: Of the link.
        centre: [m].
        size: Full edge lengths [m].
        mass: [kg].
        colour: Name of a material of the description.
    """

    name: str
    centre: tuple[float, float, float]
    size: tuple[float, float, float]
    mass: float
    colour: str


_FINGER = (0.098, 0.012, 0.022)
_FINGER_Y = (OPENING + _FINGER[1]) / 2

BLOCKS = (
    Block("gripper_palm_link", (0.033, 0.0, 0.0), (0.054, 0.128, 0.05), 0.5, "FlatBlack"),
    Block("gripper_left_finger_link", (0.108, _FINGER_Y, 0.0), _FINGER, 0.06, "Grey"),
    Block("gripper_right_finger_link", (0.108, -_FINGER_Y, 0.0), _FINGER, 0.06, "Grey"),
    Block("wrist_camera_link", (0.03, 0.0, -0.041), (0.025, 0.06, 0.022), 0.05, "DarkGrey"),
)

_CAMERA_POSITION = (0.045, 0.0, -0.044)
_CAMERA_PITCH = math.radians(20.0)  # down towards the finger tips
_CAMERA_RPY = (math.pi / 2 - _CAMERA_PITCH, 0.0, math.pi / 2)  # optical axes: x right, y down, z forward


def gripper_urdf() -> str:
    """Return the gripper's links and joints as URDF elements, each hung on `PARENT_LINK` by a fixed joint."""
    parts = [_block_urdf(block) for block in BLOCKS]
    parts.append(_frame_urdf(GRASPING_FRAME, (GRASP_DISTANCE, 0.0, 0.0), (0.0, 0.0, 0.0)))
    parts.append(_frame_urdf(WRIST_CAMERA_FRAME, _CAMERA_POSITION, _CAMERA_RPY))
    return "".join(parts)


def _block_urdf(block: Block) -> str:
    x, y, z = block.size
    ixx, iyy, izz = (block.mass / 12 * s for s in (y * y + z * z, x * x + z * z, x * x + y * y))
    shape = f'<geometry><box size="{x} {y} {z}"/></geometry>'
    return (
        f'<link name="{block.name}">'
        f'<inertial><mass value="{block.mass}"/>'
        f'<inertia ixx="{ixx}" ixy="0" ixz="0" iyy="{iyy}" iyz="0" izz="{izz}"/></inertial>'
        f'<visual>{shape}<material name="{block.colour}"/></visual><collision>{shape}</collision></link>'
        + _joint_urdf(block.name, block.centre, (0.0, 0.0, 0.0))
    )


def _frame_urdf(name: str, xyz: tuple[float, ...], rpy: tuple[float, ...]) -> str:
    inertial = (
        '<inertial><mass value="1e-4"/><inertia ixx="1e-8" ixy="0" ixz="0" iyy="1e-8" iyz="0" izz="1e-8"/></inertial>'
    )
    return f'<link name="{name}">{inertial}</link>' + _joint_urdf(name, xyz, rpy)


def _joint_urdf(child: str, xyz: tuple[float, ...], rpy: tuple[float, ...]) -> str:
    return (
        f'<joint name="{child}_joint" type="fixed"><parent link="{PARENT_LINK}"/><child link="{child}"/>'
        f'<origin xyz="{" ".join(map(str, xyz))}" rpy="{" ".join(map(str, rpy))}"/></joint>'
    )


def pitched_down(pitch: float) -> NDArray[np.float64]:
    """Return the orientation of a gripper that points forward and down, scalar first, shape (4,).

    The arm's usual roll of 180 degrees is included: the gripper's -z axis points up.

    Args:
        pitch: Angle below the horizontal [rad].
    """
    return np.array([0.0, math.cos(pitch / 2), 0.0, -math.sin(pitch / 2)])
