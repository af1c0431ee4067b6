"""What is seen, as the browser draws it: told once, as words and as the shapes' numbers."""

from __future__ import annotations

import logging
from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

import msgspec
import numpy as np

from services.bus.arrays import quaternion, vector3
from sim.exceptions import SimError
from sim.robots import meshes
from sim.robots.catalogue import DEFAULT
from sim.robots.description import prepare
from sim.robots.gripper import Gripper
from sim.robots.links import Block, Cylinder, Link, Mesh, Shape, read_links
from sim.robots.robot import Manipulator
from sim.tasks import AnyScene
from sim.tasks import described as description_of
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Eye

log = logging.getLogger(__name__)

_FINEST = 65_535
"""Steps from one side of a shape to the other: of a robot's link, a hundredth of a millimetre."""


@dataclass(frozen=True)
class Description:
    """What the browser is told once.

    Attributes:
        words: JSON; see `_Words`.
        shapes: the meshes' numbers, little endian: vertices, three uint16 each, in steps from the mesh's corner; then
            triangles, three uint16 each, the first vertex of their mesh being 0; then normals, three int8 each.
        joints: names of what moves, in the order in which their positions are told.
        gripper: whose fingers are among them; None of a robot that is a point.
    """

    words: bytes
    shapes: bytes
    joints: tuple[str, ...]
    gripper: Gripper | None


class _Part(msgspec.Struct, frozen=True, omit_defaults=True):
    """A shape in its link's frame: a mesh by its number, a box by its edges or a cylinder by radius and length [m]."""

    position: tuple[float, ...]
    orientation: tuple[float, ...]
    colour: tuple[float, ...]
    mesh: int | None = None
    box: tuple[float, ...] | None = None
    cylinder: tuple[float, float] | None = None


class _Link(msgspec.Struct, frozen=True):
    """A link in its parent's frame; parent and joint by their numbers, -1 for none; quaternions scalar first."""

    name: str
    parent: int
    position: tuple[float, ...]
    orientation: tuple[float, ...]
    joint: int
    axis: tuple[float, ...]
    slides: bool
    parts: tuple[_Part, ...]


class _Block(msgspec.Struct, frozen=True):
    """A part of the gripper, in the grasping frame: its centre and its half edge lengths [m]."""

    centre: tuple[float, ...]
    half_sizes: tuple[float, ...]


class _Mesh(msgspec.Struct, frozen=True):
    """How a mesh's numbers are read: least corner and a step along each axis [m]; how many vertices and triangles."""

    corner: tuple[float, ...]
    step: tuple[float, ...]
    vertices: int
    triangles: int


class _Words(msgspec.Struct, frozen=True):
    """The description.

    Attributes:
        eye: from where one looks, and at what [m].
        point: radius of a robot that is a point [m]; None for one of links.
        gripper: what of the robot goes ahead and may touch something; none of a robot that is a point.
        joints: names of what moves.
        rest: where they are as long as nothing is heard of them [rad, m].
        links: each after its parent.
        meshes: in the order of their numbers.
    """

    eye: Eye
    point: float | None
    gripper: tuple[_Block, ...]
    joints: tuple[str, ...]
    rest: tuple[float, ...]
    links: tuple[_Link, ...]
    meshes: tuple[_Mesh, ...]


def describe(known: AnyScene | None, manipulator: Manipulator | None = None) -> Description:
    """The description of a scene and of the robot in it.

    Where the scene is not known here the robot has an arm like ours, as far as anybody can tell; where no robot is
    installed, all else is shown.

    Args:
        known: the scene; None where it is not known here.
        manipulator: that stands in it; by default the one that it was made for.
    """
    eye, point = (known.eye, known.point) if known is not None else (Eye(), None)
    arm = manipulator or DEFAULT
    links: tuple[Link, ...] = ()
    if point is None:
        try:
            links = read_links((prepare(robot=arm) if known is None else description_of(known)).urdf)
        except (SimError, ImportError) as error:
            log.warning("the robot itself is not shown: %s", error)
    return described(links, _posture(known), eye, point, arm.gripper)


def described(
    links: tuple[Link, ...],
    rest: Mapping[str, float],
    eye: Eye,
    point: float | None,
    gripper: Gripper = DEFAULT.gripper,
) -> Description:
    """The description of a robot.

    Args:
        links: of it, each after its parent.
        rest: where joints are as long as nothing is heard of them, by name [rad, m]; at zero where they are not named.
        eye: from where one looks.
        point: radius of a robot that is a point [m].
        gripper: of one that is none.
    """
    joints = tuple(link.joint for link in links if link.joint)
    forms = [part.form for link in links for part in link.shapes]
    paths = tuple(dict.fromkeys(form.path for form in forms if isinstance(form, Mesh)))
    solids = [meshes.shaded(meshes.read_stl(path)) for path in paths]
    numbers = {link.name: number for number, link in enumerate(links)}
    words = _Words(
        eye=eye,
        point=point,
        gripper=() if point is not None else _gripper(gripper),
        joints=joints,
        rest=tuple(rest.get(joint, 0.0) for joint in joints),
        links=tuple(_link(link, numbers, joints, paths) for link in links),
        meshes=tuple(_mesh(solid) for solid in solids),
    )
    own = gripper if point is None else None
    return Description(msgspec.json.encode(words), _shapes(solids), joints, own)


def _gripper(gripper: Gripper) -> tuple[_Block, ...]:
    return tuple(
        _Block((x - gripper.grasp_distance, y, z), tuple(0.5 * edge for edge in block.size))
        for block, (x, y, z) in ((block, block.centre) for block in gripper.blocks)
    )


def _posture(scene: AnyScene | None) -> dict[str, float]:
    if not isinstance(scene, ReachingScene):
        return {}
    return scene.manipulator.positions(scene.stance)


def _link(link: Link, numbers: Mapping[str, int], joints: tuple[str, ...], paths: tuple[Path, ...]) -> _Link:
    return _Link(
        name=link.name,
        parent=numbers.get(link.parent, -1),
        position=vector3(link.origin.position),
        orientation=quaternion(link.origin.orientation),
        joint=joints.index(link.joint) if link.joint else -1,
        axis=vector3(link.axis),
        slides=link.slides,
        parts=tuple(_part(part, paths) for part in link.shapes),
    )


def _part(part: Shape, paths: tuple[Path, ...]) -> _Part:
    pose = vector3(part.pose.position), quaternion(part.pose.orientation)
    match part.form:
        case Mesh(path):
            return _Part(*pose, part.colour, mesh=paths.index(path))
        case Block(size):
            return _Part(*pose, part.colour, box=size)
        case Cylinder(radius, length):
            return _Part(*pose, part.colour, cylinder=(radius, length))


def _mesh(solid: meshes.Shaded) -> _Mesh:
    low, step = _grid(solid)
    return _Mesh(vector3(low), vector3(step), len(solid.vertices), len(solid.triangles))


def _grid(solid: meshes.Shaded) -> tuple[meshes.Triangles, meshes.Triangles]:
    """Least corner and a step along each axis, shapes (3,) [m]."""
    low = solid.vertices.min(axis=0)
    return low, np.maximum(np.ptp(solid.vertices, axis=0), np.float32(1e-6)) / _FINEST


def _shapes(solids: list[meshes.Shaded]) -> bytes:
    grids = [_grid(solid) for solid in solids]
    vertices = [
        ((solid.vertices - low) / step).round().astype("<u2") for solid, (low, step) in zip(solids, grids, strict=True)
    ]
    triangles = [solid.triangles.astype("<u2") for solid in solids]
    normals = [(127.0 * solid.normals).round().astype("<i1") for solid in solids]
    return b"".join(numbers.tobytes() for numbers in (*vertices, *triangles, *normals))
