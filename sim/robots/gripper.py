"""The gripper: its frames, its fingers, how it fills space, and one made of boxes for arms that come without.

In the gripper's frame x points forward, and the fingers open along y; with the usual roll of 180 degrees -z points up,
which is where the wrist camera sits.
"""

import math
import xml.etree.ElementTree as ET
from collections.abc import Iterable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.rotations import rotated, turned

Vector = tuple[float, float, float]

GRASPING_FRAME = "grasping_frame"
WRIST_CAMERA_FRAME = "wrist_camera_frame"
GRIPPER_FRAME = "gripper_mount_frame"

GRASP_DISTANCE = 0.13  # [m] from the frame of the gripper of boxes to the grasping frame
OPENING = 0.104  # [m] between its fingers


@dataclass(frozen=True)
class Mount:
    """Where something is fixed.

    Attributes:
        link: To which link; the scene's own frame where it is empty.
        position: In the link's frame [m].
        rpy: Roll, pitch and yaw about the link's axes [rad].
    """

    link: str
    position: Vector = (0.0, 0.0, 0.0)
    rpy: Vector = (0.0, 0.0, 0.0)

    @property
    def is_link(self) -> bool:
        """Nothing is between the link's frame and what is fixed to it."""
        return not any((*self.position, *self.rpy))


@dataclass(frozen=True)
class Block:
    """One box of a gripper, in the gripper's frame.

    Attributes:
        name: Of the link.
        centre: [m].
        size: Full edge lengths [m].
        mass: [kg].
        colour: Name of a material of the description.
        joint: On which it slides outwards along y, to where it is said to be from where the gripper is closed; a part
            that does not move has none.
    """

    name: str
    centre: Vector
    size: Vector
    mass: float = 0.05
    colour: str = "Grey"
    joint: str = ""


@dataclass(frozen=True)
class Finger:
    """A joint that moves a finger; its position is linear in the gripper's opening [m, or rad where it turns].

    Attributes:
        joint: Its name in the description.
        closed: Position at which the gripper is closed.
        wide: Position at which it is wide open.
        effort: With which it presses at most [N, or N m].
        armature: Inertia of motor and gear, as the joint feels it [kg, or kg m^2].
    """

    joint: str
    closed: float
    wide: float
    effort: float
    armature: float = 0.1

    def position(self, share: float) -> float:
        """Return where it is at a share of the gripper's opening."""
        return self.closed + share * (self.wide - self.closed)

    def share(self, position: float) -> float:
        """Return the share of the gripper's opening at which it is at a position."""
        return (position - self.closed) / (self.wide - self.closed)


@dataclass(frozen=True)
class Gripper:
    """What grasps.

    Attributes:
        mount: The gripper's frame: x forward, the fingers open along y.
        blocks: How it fills space, in its frame: what goes ahead and may touch something.
        grasp_distance: From its frame to the grasping frame, along x [m].
        opening: Between the open fingers [m].
        fingers: That open and close it together; it is rigid, wide open, where there are none.
        speed: Of the opening, as it changes where nothing is in the way [m/s].
        jaw: Link that does not move and that a finger closes upon; empty where fingers close upon one another.
        palm: Boxes that stand for the shapes of the mount's link where something is touched: a convex hull of a palm
            with a jaw would fill the mouth.
        camera: Of the wrist camera, in its frame [m].
        made: It is made of the blocks; else the description has it, and they only tell how large it is.
    """

    mount: Mount
    blocks: tuple[Block, ...]
    grasp_distance: float
    opening: float
    camera: Vector
    made: bool = False
    fingers: tuple[Finger, ...] = ()
    speed: float = 0.1
    jaw: str = ""
    palm: tuple[Block, ...] = ()

    @property
    def finger_names(self) -> tuple[str, ...]:
        """Of the joints that open and close it."""
        return tuple(finger.joint for finger in self.fingers)

    def positions(self, opening: float) -> dict[str, float]:
        """Return where its fingers are, by their joints' names [m, rad].

        Args:
            opening: Between them [m].
        """
        return {finger.joint: finger.position(opening / self.opening) for finger in self.fingers}


_FINGER = (0.098, 0.012, 0.022)
_FINGER_Y = (OPENING + _FINGER[1]) / 2
_LEFT, _RIGHT = "gripper_left_finger_joint", "gripper_right_finger_joint"
_EFFORT = 20.0  # [N] of each of its fingers

BLOCKS = (
    Block("gripper_palm_link", (0.033, 0.0, 0.0), (0.054, 0.128, 0.05), 0.5, "FlatBlack"),
    Block("gripper_left_finger_link", (0.108, _FINGER_Y, 0.0), _FINGER, 0.06, "Grey", _LEFT),
    Block("gripper_right_finger_link", (0.108, -_FINGER_Y, 0.0), _FINGER, 0.06, "Grey", _RIGHT),
    Block("wrist_camera_link", (0.03, 0.0, -0.041), (0.025, 0.06, 0.022), 0.05, "DarkGrey"),
)

_CAMERA_POSITION = (0.045, 0.0, -0.044)
_CAMERA_PITCH = math.radians(20.0)  # down towards the finger tips
_CAMERA_RPY = (math.pi / 2 - _CAMERA_PITCH, 0.0, math.pi / 2)  # optical axes: x right, y down, z forward

COLOURS = {"FlatBlack": "0.1 0.1 0.1 1", "Grey": "0.7 0.7 0.7 1.0", "DarkGrey": "0.1 0.1 0.1 1.0"}
"""Of the blocks, for a description that has no materials of these names."""


def two_fingers(mount: Mount) -> Gripper:
    """The gripper of boxes: two fingers that close upon one another.

    Args:
        mount: Where it is put on an arm.
    """
    fingers = tuple(Finger(joint, 0.0, OPENING / 2, _EFFORT) for joint in (_LEFT, _RIGHT))
    return Gripper(mount, BLOCKS, GRASP_DISTANCE, OPENING, _CAMERA_POSITION, made=True, fingers=fingers)


def gripper_urdf(gripper: Gripper, materials: Iterable[str]) -> str:
    """Return the gripper's links, frames and joints as URDF elements.

    Args:
        gripper: What to describe.
        materials: That the description has already.
    """
    mount, parts = gripper.mount, []
    link = mount.link
    if not mount.is_link:
        link = GRIPPER_FRAME
        parts.append(frame_urdf(link, mount))
    if gripper.made:
        colours = {block.colour for block in gripper.blocks} - set(materials)
        parts += [f'<material name="{name}"><color rgba="{COLOURS[name]}"/></material>' for name in sorted(colours)]
        parts += [_block_urdf(link, block, gripper.opening) for block in gripper.blocks]
    parts.append(frame_urdf(GRASPING_FRAME, Mount(link, (gripper.grasp_distance, 0.0, 0.0))))
    parts.append(frame_urdf(WRIST_CAMERA_FRAME, Mount(link, gripper.camera, _CAMERA_RPY)))
    return "".join(parts)


def _block_urdf(link: str, block: Block, opening: float) -> str:
    x, y, z = block.size
    joint = fixed_urdf(block.name, Mount(link, block.centre))
    if block.joint:
        joint = _finger_urdf(link, block, opening / 2)
    ixx, iyy, izz = (block.mass / 12 * s for s in (y * y + z * z, x * x + z * z, x * x + y * y))
    shape = f'<geometry><box size="{x} {y} {z}"/></geometry>'
    return (
        f'<link name="{block.name}">'
        f'<inertial><mass value="{block.mass}"/>'
        f'<inertia ixx="{ixx}" ixy="0" ixz="0" iyy="{iyy}" iyz="0" izz="{izz}"/></inertial>'
        f'<visual>{shape}<material name="{block.colour}"/></visual><collision>{shape}</collision></link>' + joint
    )


def _finger_urdf(link: str, block: Block, way: float) -> str:
    """The joint of a finger, which is where the block says when it has gone so far [m]."""
    outwards = math.copysign(1.0, block.centre[1])
    x, y, z = block.centre
    return (
        f'<joint name="{block.joint}" type="prismatic"><parent link="{link}"/><child link="{block.name}"/>'
        f'<origin xyz="{x} {y - outwards * way} {z}"/><axis xyz="0 {outwards} 0"/>'
        f'<limit lower="0" upper="{way}" velocity="1" effort="0"/></joint>'
    )


def palm_urdf(gripper: Gripper) -> list[ET.Element]:
    """Return the palm's boxes as collision elements of the mount's link."""
    orientation = np.array([1.0, 0.0, 0.0, 0.0])
    for axis, angle in zip(np.eye(3), gripper.mount.rpy, strict=True):
        orientation = rotated(orientation, angle * axis)
    shapes = []
    for block in gripper.palm:
        centre = np.array(gripper.mount.position) + turned(orientation, np.array(block.centre))
        shape = ET.Element("collision")
        ET.SubElement(shape, "origin", {"xyz": _words(centre.tolist()), "rpy": _words(gripper.mount.rpy)})
        ET.SubElement(ET.SubElement(shape, "geometry"), "box", {"size": _words(block.size)})
        shapes.append(shape)
    return shapes


def _words(values: Iterable[float]) -> str:
    return " ".join(map(repr, values))


def frame_urdf(name: str, mount: Mount) -> str:
    """Return a link without a shape, fixed to another, as URDF elements.

    Args:
        name: Of the link; its joint's has "_joint" after it.
        mount: Where it is.
    """
    inertial = (
        '<inertial><mass value="1e-4"/><inertia ixx="1e-8" ixy="0" ixz="0" iyy="1e-8" iyz="0" izz="1e-8"/></inertial>'
    )
    return f'<link name="{name}">{inertial}</link>' + fixed_urdf(name, mount)


def fixed_urdf(child: str, mount: Mount) -> str:
    """Return the joint that fixes a link to another, as a URDF element.

    Args:
        child: The link.
        mount: Where it is.
    """
    return (
        f'<joint name="{child}_joint" type="fixed"><parent link="{mount.link}"/><child link="{child}"/>'
        f'<origin xyz="{" ".join(map(str, mount.position))}" rpy="{" ".join(map(str, mount.rpy))}"/></joint>'
    )


def pitched_down(pitch: float) -> NDArray[np.float64]:
    """Return the orientation of a gripper that points forward and down, scalar first, shape (4,).

    The arm's usual roll of 180 degrees is included: the gripper's -z axis points up.

    Args:
        pitch: Angle below the horizontal [rad].
    """
    return np.array([0.0, math.cos(pitch / 2), 0.0, -math.sin(pitch / 2)])
