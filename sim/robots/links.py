"""The robot's links as whoever draws it needs them: how each hangs on another, what moves it, how it looks."""

import xml.etree.ElementTree as ET
from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sim.exceptions import DescriptionInvalid
from sim.pose import Pose
from sim.rotations import rotated

Array = NDArray[np.float64]
Colour = tuple[float, float, float, float]

GREY: Colour = (0.7, 0.7, 0.7, 1.0)
"""Of what the description gives no colour."""

_NO_ROTATION = np.array([1.0, 0.0, 0.0, 0.0])
_MOVING = frozenset({"revolute", "continuous", "prismatic"})


@dataclass(frozen=True)
class Mesh:
    """A shape that lies in an STL file."""

    path: Path


@dataclass(frozen=True)
class Block:
    """A box; its full edge lengths [m]."""

    size: tuple[float, ...]


@dataclass(frozen=True)
class Cylinder:
    """A cylinder about its z axis [m]."""

    radius: float
    length: float


@dataclass(frozen=True, eq=False)
class Shape:
    """A part of how a link looks.

    Attributes:
        pose: In the link's frame.
        form: What it is.
        colour: Red, green, blue and opacity, each in [0, 1].
    """

    pose: Pose
    form: Mesh | Block | Cylinder
    colour: Colour


@dataclass(frozen=True, eq=False)
class Link:
    """A link and the joint by which it hangs on another one.

    Attributes:
        name: Of the link.
        parent: Name of the link that it hangs on; empty for the root.
        origin: Pose in the parent's frame where the joint is at zero.
        joint: Name of the joint that moves it; empty where it is fixed.
        axis: About which, or along which, the joint moves it, in its own frame, shape (3,).
        slides: Along the axis, not about it.
        shapes: How it looks.
    """

    name: str
    parent: str
    origin: Pose
    joint: str
    axis: Array
    slides: bool
    shapes: tuple[Shape, ...]


def read_links(urdf: Path) -> tuple[Link, ...]:
    """Return the links of a description, each after the one that it hangs on.

    Args:
        urdf: The description; its meshes are named by path.

    Raises:
        DescriptionInvalid: The links are no tree.
    """
    robot = ET.parse(urdf).getroot()
    colours = {name: _numbers(colour, "rgba", 4) for name, colour in _materials(robot)}
    joints = {_named(joint, "child", "link"): joint for joint in robot.iterfind("joint")}
    waiting = {link.attrib["name"]: link for link in robot.iterfind("link")}
    placed: dict[str, Link] = {}
    while waiting:
        ready = [name for name in waiting if name not in joints or _named(joints[name], "parent", "link") in placed]
        if not ready:
            raise DescriptionInvalid(str(urdf), f"{next(iter(waiting))} hangs on nothing")
        for name in ready:
            placed[name] = _link(waiting.pop(name), joints.get(name), colours)
    return tuple(placed.values())


def _link(link: ET.Element, joint: ET.Element | None, colours: dict[str, tuple[float, ...]]) -> Link:
    shapes = tuple(_shape(visual, colours) for visual in link.iterfind("visual"))
    if joint is None:
        return Link(link.attrib["name"], "", _origin(link), "", np.zeros(3), False, shapes)
    moves = joint.attrib["type"] in _MOVING
    return Link(
        name=link.attrib["name"],
        parent=_named(joint, "parent", "link"),
        origin=_origin(joint),
        joint=joint.attrib["name"] if moves else "",
        axis=np.array(_numbers(joint.find("axis"), "xyz", 3) or (1.0, 0.0, 0.0)),
        slides=joint.attrib["type"] == "prismatic",
        shapes=shapes,
    )


def _shape(visual: ET.Element, colours: dict[str, tuple[float, ...]]) -> Shape:
    material = visual.find("material")
    colour = colours.get(material.attrib.get("name", "")) if material is not None else None
    r, g, b, a = colour or GREY
    return Shape(_origin(visual), _form(visual), (r, g, b, a))


def _form(visual: ET.Element) -> Mesh | Block | Cylinder:
    mesh, box, cylinder = (visual.find(f"geometry/{kind}") for kind in ("mesh", "box", "cylinder"))
    if mesh is not None:
        return Mesh(Path(mesh.attrib["filename"]))
    if box is not None:
        return Block(_numbers(box, "size", 3))
    if cylinder is not None:
        return Cylinder(float(cylinder.attrib["radius"]), float(cylinder.attrib["length"]))
    raise DescriptionInvalid("a shape", "it is neither mesh nor box nor cylinder")


def _materials(robot: ET.Element) -> Iterator[tuple[str, ET.Element]]:
    for material in robot.iter("material"):
        colour = material.find("color")
        if colour is not None:
            yield material.attrib["name"], colour


def _origin(element: ET.Element) -> Pose:
    """The pose that an element's `origin` gives: roll, pitch and yaw about fixed axes."""
    origin = element.find("origin")
    position, angles = (np.array(_numbers(origin, name, 3) or (0.0,) * 3) for name in ("xyz", "rpy"))
    orientation = _NO_ROTATION
    for axis, angle in zip(np.eye(3), angles, strict=True):
        orientation = rotated(orientation, angle * axis)
    return Pose(position, orientation)


def _numbers(element: ET.Element | None, attribute: str, count: int) -> tuple[float, ...]:
    """The numbers of an attribute; none where it is not there."""
    words = element.attrib.get(attribute, "").split() if element is not None else []
    if words and len(words) != count:
        raise DescriptionInvalid(attribute, f"it has {len(words)} numbers, not {count}")
    return tuple(float(word) for word in words)


def _named(element: ET.Element, tag: str, attribute: str) -> str:
    found = element.find(tag)
    return found.attrib[attribute] if found is not None else ""
