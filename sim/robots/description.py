"""One URDF of a robot that both Pinocchio and MuJoCo read.

Descriptions name meshes by package, have COLLADA meshes that MuJoCo cannot decode, and inertias that no rigid body can
have. The repaired copy, standing where it is to stand, with the gripper's frames and, where it comes without one, a
gripper put on, is made once into a cache folder.
"""

import hashlib
import inspect
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from functools import partial
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

from sim.cache import kept
from sim.exceptions import DescriptionInvalid, DescriptionMissing, FileMissing
from sim.robots import faults, gripper, inertia, meshes, shapes
from sim.robots.catalogue import DEFAULT
from sim.robots.gripper import Mount, fixed_urdf
from sim.robots.robot import Base, Manipulator

GRASPING_FRAME = gripper.GRASPING_FRAME

NAME = "robot"
"""Of every robot in its description: who draws one finds its parts under it."""

STAND = "robot_stand"
"""The link on which a robot stands that does not stand at the scene's origin."""

_WORLD = "world"
_SHARE = "cmeel.prefix/share"
_URDF_NAME = "robot.urdf"
_MUJOCO_OPTIONS = '<mujoco><compiler strippath="false" fusestatic="false" discardvisual="false" meshdir="."/></mujoco>'
_COLUMN = 0.10  # [m] width of what carries a robot that stands above the floor


@dataclass(frozen=True)
class RobotDescription:
    """The robot, ready to be read.

    Attributes:
        urdf: The file; its meshes lie beside it and are named by absolute path.
    """

    urdf: Path


def prepare(cache: Path | None = None, robot: Manipulator = DEFAULT, base: Base | None = None) -> RobotDescription:
    """Return a robot's description, making it at first use.

    Args:
        cache: Where to keep it; see `sim.cache`.
        robot: Which.
        base: Where it stands; where the robot says by default.

    Returns:
        The description.

    Raises:
        DescriptionMissing: The package with the robot's meshes is not installed.
        DescriptionInvalid: A mesh of it is damaged.
        FileMissing: There is no such description.
        RobotUnfit: What the robot's value names is not in the description.
        CacheUnusable: There is no place for it.
    """
    source = source_of(robot, cache)
    base = base or robot.base
    name = f"{robot.kind}-{_key(source, robot, base)}"
    return RobotDescription(kept(name, partial(_build, source, robot, base), cache) / _URDF_NAME)


def source_of(robot: Manipulator, cache: Path | None = None) -> Path:
    """Return the URDF that describes a robot; a MJCF is made into one.

    Args:
        robot: Which.
        cache: Where that is kept; see `sim.cache`.

    Raises:
        DescriptionMissing: The package that it lies in is not installed.
        FileMissing: There is no such file.
    """
    source = robot.source
    if not source.package:
        path = Path(source.file)
        if not path.is_file():
            raise FileMissing(robot.kind, "the description", path)
        return _urdf(path, cache)
    try:
        path = Path(str(distribution(source.package).locate_file(f"{_SHARE}/{source.package}/{source.file}")))
    except PackageNotFoundError as error:
        raise DescriptionMissing(source.package) from error
    if not path.exists():
        raise DescriptionMissing(source.package)
    return path


def _urdf(path: Path, cache: Path | None) -> Path:
    if path.suffix != ".xml":
        return path
    # Imported here: physics takes a second, and few bring a MJCF.
    try:
        from sim.robots.mjcf import converted, is_mjcf  # noqa: PLC0415
    except ImportError as error:
        remedy = "pip install 'retouch[robot]', or give a URDF"
        raise DescriptionInvalid(str(path), "MuJoCo, which reads it, is not installed", remedy) from error
    return converted(path, cache) if is_mjcf(path) else path


def _key(source: Path, robot: Manipulator, base: Base) -> str:
    # Our own text belongs to the key: whoever edits the build gets a new description without a thought.
    modules = (inspect.getmodule(_build), meshes, gripper, inertia, shapes)
    texts = [source.read_bytes(), *(Path(str(module.__file__)).read_bytes() for module in modules if module)]
    told = repr((robot.source, robot.joints, robot.moving_names, robot.gripper, base)).encode()
    return hashlib.sha256(b"".join((*texts, told))).hexdigest()[:16]


def _build(source: Path, robot: Manipulator, base: Base, scratch: Path, target: Path) -> None:
    scratch.mkdir()
    root = faults.parsed(source)
    faults.check(root, robot, source)
    for tag in ("gazebo", "transmission", "ros2_control"):
        for element in root.findall(tag):
            root.remove(element)
    shapes.convert(root, source, scratch, target)
    _fix_what_is_not_moved(root, robot)
    _narrow_limits(root, robot)
    _drop_friction(root)
    if not base.is_origin:
        _put_on_stand(root, base)
    _shape_palm(root, robot)
    materials = [material.attrib["name"] for material in root.iter("material") if material.find("color") is not None]
    root.extend(ET.fromstring(f"<gripper>{gripper.gripper_urdf(robot.gripper, materials)}</gripper>"))
    inertia.give_where_needed(root)
    for inertial in root.iterfind("link/inertial"):
        inertia.repair(inertial)
    root.attrib["name"] = NAME
    root.insert(0, ET.fromstring(_MUJOCO_OPTIONS))
    ET.ElementTree(root).write(scratch / _URDF_NAME, encoding="utf-8", xml_declaration=True)


def _fix_what_is_not_moved(root: ET.Element, robot: Manipulator) -> None:
    moving = robot.moving_names
    for joint in root.iterfind("joint"):
        if joint.attrib["name"] not in moving:
            joint.attrib["type"] = "fixed"
        for mimic in joint.findall("mimic"):
            joint.remove(mimic)  # whoever moves a joint says so


def _narrow_limits(root: ET.Element, robot: Manipulator) -> None:
    """Write what a robot says of its joints' limits into the description, which all readers keep to."""
    joints = {joint.attrib["name"]: joint for joint in root.iterfind("joint")}
    for said in robot.joints:
        joint = joints[said.name]
        if joint.attrib["type"] == "continuous":
            joint.attrib["type"] = "revolute"  # Pinocchio has two numbers for the other kind
        limit = joint.find("limit")
        if limit is None:
            limit = ET.SubElement(joint, "limit", {"effort": "0"})
        for key, value in (("lower", said.lower), ("upper", said.upper), ("velocity", said.speed)):
            if value is not None:
                limit.attrib[key] = repr(value)


def _shape_palm(root: ET.Element, robot: Manipulator) -> None:
    if robot.gripper.palm:
        (link,) = (one for one in root.iterfind("link") if one.attrib["name"] == robot.gripper.mount.link)
        for shape in link.findall("collision"):
            link.remove(shape)
        link.extend(gripper.palm_urdf(robot.gripper))


def _drop_friction(root: ET.Element) -> None:
    # Dry friction would only add stiction to servos that are ideal otherwise.
    for dynamics in root.iterfind("joint/dynamics"):
        dynamics.attrib["friction"] = "0"


def _put_on_stand(root: ET.Element, base: Base) -> None:
    """Hang the first link on another one, which lies in the scene's origin, and draw what carries it."""
    for element in root.iter():
        for key in ("name", "link"):
            if element.tag in ("link", "parent", "child") and element.attrib.get(key) == _WORLD:
                element.attrib[key] = f"{_WORLD}_link"  # MuJoCo takes it for its own, wherever it is
    (first,) = faults.first_links(root)
    x, y, z = base.position
    column = ""
    if z > 0.0:
        shape = f'<origin xyz="{x} {y} {z / 2}"/><geometry><box size="{_COLUMN} {_COLUMN} {z}"/></geometry>'
        column = f"<visual>{shape}</visual><collision>{shape}</collision>"
    joint = fixed_urdf(first, Mount(STAND, base.position, (0.0, 0.0, base.yaw)))
    added = list(ET.fromstring(f'<added><link name="{STAND}">{column}</link>{joint}</added>'))
    added[1].attrib["name"] = f"{STAND}_joint"
    for element in reversed(added):
        root.insert(0, element)
