"""What a robot's value and its description do not agree in, a line each."""

import difflib
import xml.etree.ElementTree as ET
from collections.abc import Iterable, Iterator
from pathlib import Path

from sim.exceptions import DescriptionInvalid, RobotUnfit
from sim.robots.gripper import GRASPING_FRAME, GRIPPER_FRAME, WRIST_CAMERA_FRAME
from sim.robots.robot import Joint, Manipulator
from sim.robots.shapes import mesh_path

_TURNS, _SLIDES = ("revolute", "continuous"), "prismatic"
_KNOWN_LATER = ("", GRIPPER_FRAME, GRASPING_FRAME, WRIST_CAMERA_FRAME)
"""Links that are there only when the gripper has been put on."""


def parsed(source: Path) -> ET.Element:
    """Return a URDF's root element.

    Raises:
        DescriptionInvalid: It is no URDF.
    """
    try:
        root = ET.parse(source).getroot()
    except (ET.ParseError, UnicodeDecodeError) as error:
        raise DescriptionInvalid(str(source), f"it is no XML ({error})", "write it as URDF or MJCF") from None
    if root.tag != "robot":
        raise DescriptionInvalid(str(source), f"its first element is <{root.tag}>, no <robot>", "name a URDF or MJCF")
    return root


def check(root: ET.Element, robot: Manipulator, source: Path) -> None:
    """Let a robot pass that fits its description.

    Raises:
        RobotUnfit: It does not; says the first thing that is wrong.
    """
    for fault in found(root, robot, source):
        raise RobotUnfit(robot.kind, fault)


def found(root: ET.Element, robot: Manipulator, source: Path) -> Iterator[str]:
    """Say what is wrong, a line each.

    Args:
        root: The description.
        robot: Its value.
        source: The description's file.
    """
    yield from _of_the_tree(root)
    yield from _of_joints(root, robot)
    yield from _of_frames(root, robot)
    for name in dict.fromkeys(mesh.attrib.get("filename", "") for mesh in root.iter("mesh")):
        if mesh_path(name, source) is None:
            yield f"mesh {name} is missing: put it where {source.name} or its package says"


def first_links(root: ET.Element) -> list[str]:
    """Return the links that hang on no other."""
    children = {child.attrib["link"] for child in root.iterfind("joint/child")}
    return [name for name in _links(root) if name not in children]


def _links(root: ET.Element) -> list[str]:
    return [link.attrib["name"] for link in root.iterfind("link")]


def _of_the_tree(root: ET.Element) -> Iterator[str]:
    first = first_links(root)
    if len(first) != 1:
        yield f"{len(first)} links hang on no other ({', '.join(first)}): a robot has one, which all others hang on"


def _of_joints(root: ET.Element, robot: Manipulator) -> Iterator[str]:
    joints = {joint.attrib["name"]: joint for joint in root.iterfind("joint")}
    movable = [name for name, joint in joints.items() if joint.attrib.get("type") in (*_TURNS, _SLIDES)]
    made = [block.joint for block in robot.gripper.blocks] if robot.gripper.made else []
    named = dict.fromkeys((*robot.joint_names, *robot.held_names), "joint")
    named |= {name: "the gripper's finger joint" for name in robot.gripper.finger_names if name not in made}
    for name, kind in named.items():
        if name not in movable:
            what = "is fixed" if name in joints else "is not in the description"
            yield f"{kind} {name} {what}{_instead(name, movable)}"
    for finger in robot.gripper.fingers:
        if finger.closed == finger.wide:
            yield f"the gripper's finger joint {finger.joint} does not move: give it two positions, closed and wide"
    for said in robot.joints:
        if said.name in movable:
            yield from _of_limits(joints[said.name], said)
    if len(robot.home) != len(robot.joints):
        yield f"home has {len(robot.home)} positions for {len(robot.joints)} joints"


def _of_limits(joint: ET.Element, said: Joint) -> Iterator[str]:
    limit = joint.find("limit")
    written = {} if limit is None else limit.attrib
    least = said.lower if said.lower is not None else _number(written, "lower")
    most = said.upper if said.upper is not None else _number(written, "upper")
    if least is None or most is None or not least < most:
        yield f"joint {said.name} has no limits of position: give it lower and upper"
    speed = said.speed if said.speed is not None else _number(written, "velocity")
    if speed is None or speed <= 0.0:
        yield f"joint {said.name} has no limit of speed: give it speed"


def _number(written: dict[str, str], key: str) -> float | None:
    try:
        return float(written[key])
    except (KeyError, ValueError):
        return None


def _of_frames(root: ET.Element, robot: Manipulator) -> Iterator[str]:
    links = _links(root)
    named = {"the gripper": robot.gripper.mount.link, "the gripper's jaw": robot.gripper.jaw}
    named |= {f"camera {camera.name}": camera.mount.link for camera in robot.cameras}
    made = [block.name for block in robot.gripper.blocks] if robot.gripper.made else []
    for what, link in named.items():
        if link not in (*links, *made, *_KNOWN_LATER):
            yield f"{what} is to be at link {link}, which the description has not{_instead(link, links)}"


def _instead(name: str, known: Iterable[str]) -> str:
    near = difflib.get_close_matches(name, list(known), n=1)
    return f": did you mean {near[0]}?" if near else f": it has {', '.join(known)}"
