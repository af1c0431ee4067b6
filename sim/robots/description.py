"""One URDF of the robot that both Pinocchio and MuJoCo read.

The package example-robot-data holds PAL Robotics' TIAGo without a hand (Apache-2.0). Its URDF names
meshes by package, has COLLADA meshes that MuJoCo cannot decode, and inertias that no rigid body can
have. The repaired copy, with a gripper put on, is made once into a cache folder.
"""

import hashlib
import xml.etree.ElementTree as ET
from dataclasses import dataclass
from functools import partial
from importlib.metadata import PackageNotFoundError, distribution
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from sim.cache import kept
from sim.exceptions import DescriptionMissing
from sim.robots import gripper, meshes

CONTROLLED_JOINTS = (
    "torso_lift_joint",
    "arm_1_joint",
    "arm_2_joint",
    "arm_3_joint",
    "arm_4_joint",
    "arm_5_joint",
    "arm_6_joint",
    "arm_7_joint",
)
HEAD_JOINTS = ("head_1_joint", "head_2_joint")
HEAD_CAMERA_FRAME = "xtion_rgb_optical_frame"
GRASPING_FRAME = gripper.GRASPING_FRAME
WRIST_CAMERA_FRAME = gripper.WRIST_CAMERA_FRAME

_PACKAGE = "example-robot-data"
_SOURCE = "cmeel.prefix/share/example-robot-data/robots/tiago_description/robots/tiago_no_hand.urdf"
_MESH_PREFIX = "package://example-robot-data/robots/tiago_description/"
_URDF_NAME = "robot.urdf"
_VISUAL_TRIANGLES = 20_000
_SMALLEST_INERTIA = 1e-7  # [kg m^2]
_MUJOCO_OPTIONS = '<mujoco><compiler strippath="false" fusestatic="false" discardvisual="false" meshdir="."/></mujoco>'


@dataclass(frozen=True)
class RobotDescription:
    """The robot, ready to be read.

    Attributes:
        urdf: The file; its meshes lie beside it and are named by absolute path.
    """

    urdf: Path


def prepare(cache: Path | None = None) -> RobotDescription:
    """Return the robot's description, making it at first use.

    Args:
        cache: Where to keep it; see `sim.cache`.

    Returns:
        The description.

    Raises:
        DescriptionMissing: The package with the robot's meshes is not installed.
        DescriptionInvalid: A mesh of it is damaged.
        CacheUnusable: There is no place for it.
    """
    source = _source()
    return RobotDescription(kept(f"tiago-{_key(source)}", partial(_build, source), cache) / _URDF_NAME)


def _source() -> Path:
    try:
        source = Path(str(distribution(_PACKAGE).locate_file(_SOURCE)))
    except PackageNotFoundError as error:
        raise DescriptionMissing(_PACKAGE) from error
    if not source.exists():
        raise DescriptionMissing(_PACKAGE)
    return source


def _key(source: Path) -> str:
    # Our own text belongs to the key: whoever edits the build gets a new description without a thought.
    texts = [source, *(Path(str(module)) for module in (__file__, meshes.__file__, gripper.__file__))]
    return hashlib.sha256(b"".join(text.read_bytes() for text in texts)).hexdigest()[:16]


def _build(source: Path, scratch: Path, target: Path) -> None:
    scratch.mkdir()
    robot = ET.parse(source).getroot()
    for tag in ("gazebo", "transmission"):
        for element in robot.findall(tag):
            robot.remove(element)
    _convert_meshes(robot, source.parent.parent, scratch, target)
    _fix_wheels(robot)
    _drop_friction(robot)
    robot.extend(ET.fromstring(f"<gripper>{gripper.gripper_urdf()}</gripper>"))
    for inertial in robot.iterfind("link/inertial"):
        _repair_inertia(inertial)
    robot.insert(0, ET.fromstring(_MUJOCO_OPTIONS))
    ET.ElementTree(robot).write(scratch / _URDF_NAME, encoding="utf-8", xml_declaration=True)


def _convert_meshes(robot: ET.Element, folder: Path, scratch: Path, target: Path) -> None:
    """Write every mesh as STL beside the URDF, those that are only drawn with fewer triangles."""
    shapes = [
        (kind, mesh, folder / mesh.attrib["filename"].removeprefix(_MESH_PREFIX))
        for kind in ("visual", "collision")
        for mesh in robot.iterfind(f"link/{kind}/geometry/mesh")
    ]
    loaded = {path: _load(path) for _, _, path in shapes}
    drawn = sum(len(loaded[path]) for path in {path for kind, _, path in shapes if kind == "visual"})
    for kind, mesh, path in shapes:
        triangles = loaded[path]
        if kind == "visual":
            triangles = meshes.thin(triangles, max(1, _VISUAL_TRIANGLES * len(triangles) // drawn))
        name = f"{path.stem}_{kind}.stl"
        meshes.write_stl(scratch / name, triangles)
        mesh.attrib["filename"] = str(target / name)


def _load(path: Path) -> meshes.Triangles:
    return meshes.read_stl(path) if path.suffix == ".stl" else meshes.read_mesh(path)


def _fix_wheels(robot: ET.Element) -> None:
    for joint in robot.iterfind("joint[@type='continuous']"):
        joint.attrib["type"] = "fixed"


def _drop_friction(robot: ET.Element) -> None:
    # Dry friction would only add stiction to servos that are ideal otherwise.
    for dynamics in robot.iterfind("joint/dynamics"):
        dynamics.attrib["friction"] = "0"


def _repair_inertia(inertial: ET.Element) -> None:
    """Make the inertia one that a rigid body can have: positive, and obeying the triangle inequality."""
    mass = inertial.find("mass")
    element = inertial.find("inertia")
    if mass is None or element is None:
        return
    mass.attrib["value"] = str(max(float(mass.attrib["value"]), 1e-4))
    repaired = _physical(_matrix(element.attrib))
    if repaired is not None:
        rows, columns = np.triu_indices(3)
        for row, column in zip(rows, columns, strict=True):
            element.attrib[f"i{'xyz'[row]}{'xyz'[column]}"] = repr(float(repaired[row, column]))


def _matrix(values: dict[str, str]) -> NDArray[np.float64]:
    xx, xy, xz, yy, yz, zz = (float(values[key]) for key in ("ixx", "ixy", "ixz", "iyy", "iyz", "izz"))
    return np.array([[xx, xy, xz], [xy, yy, yz], [xz, yz, zz]])


def _physical(inertia: NDArray[np.float64]) -> NDArray[np.float64] | None:
    """Return the nearest sound inertia, or None if it is sound already."""
    moments, axes = np.linalg.eigh(inertia)
    sound = np.maximum(moments, _SMALLEST_INERTIA)
    # The largest moment may not exceed the sum of the others; a little less, so that rounding cannot undo it.
    sound[2] = min(sound[2], 0.999 * (sound[0] + sound[1]))
    if np.allclose(sound, moments, rtol=1e-12, atol=0.0):
        return None
    return np.asarray((axes * sound) @ axes.T)
