"""A robot's MJCF as URDF, which is what everything here reads: links, joints, inertias, shapes, and sites as frames."""

import hashlib
import xml.etree.ElementTree as ET
from collections.abc import Iterator
from functools import partial
from pathlib import Path

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.cache import kept
from sim.exceptions import DescriptionInvalid
from sim.robots import meshes

Array = NDArray[np.float64]

_URDF_NAME = "robot.urdf"
_LEAST_DRAWN, _MOST_DRAWN = 0, 2  # groups of geoms that MuJoCo's viewers show
_KINDS = {mujoco.mjtJoint.mjJNT_HINGE: "revolute", mujoco.mjtJoint.mjJNT_SLIDE: "prismatic"}
_GEOM = mujoco.mjtGeom


def is_mjcf(path: Path) -> bool:
    """Whether a file holds a description for MuJoCo."""
    try:
        _, first = next(ET.iterparse(path, events=("start",)))
    except (ET.ParseError, StopIteration, OSError):
        return False
    return str(first.tag) == "mujoco"


def converted(path: Path, cache: Path | None = None) -> Path:
    """Return a URDF of the same robot, made at first use, with its meshes beside it.

    Args:
        path: Of the MJCF.
        cache: Where to keep it; see `sim.cache`.

    Raises:
        DescriptionInvalid: MuJoCo cannot read it, or it has a joint that no arm has.
    """
    try:
        model = mujoco.MjModel.from_xml_path(str(path))
    except ValueError as error:
        raise DescriptionInvalid(str(path), " ".join(str(error).split()), "mend the file") from None
    own = Path(__file__).read_bytes()
    numbers = (model.body_pos, model.body_quat, model.jnt_axis, model.jnt_range, model.geom_pos, model.mesh_vert)
    key = hashlib.sha256(b"".join((own, path.read_bytes(), *(array.tobytes() for array in numbers)))).hexdigest()[:16]
    return kept(f"mjcf-{key}", partial(_write, model, path), cache) / _URDF_NAME


def _write(model: mujoco.MjModel, path: Path, scratch: Path, target: Path) -> None:
    scratch.mkdir()
    for number in range(model.nmesh):
        vertices = model.mesh_vert[model.mesh_vertadr[number] :][: model.mesh_vertnum[number]]
        faces = model.mesh_face[model.mesh_faceadr[number] :][: model.mesh_facenum[number]]
        meshes.write_stl(scratch / _mesh_name(number), vertices[faces].astype(np.float32))
    root = ET.Element("robot", {"name": "robot"})
    root.append(ET.Element("link", {"name": "world_link"}))
    for body in range(1, model.nbody):
        root.extend(list(_body(model, body, path, target)))
    ET.ElementTree(root).write(scratch / _URDF_NAME, encoding="utf-8", xml_declaration=True)


def _body(model: mujoco.MjModel, body: int, path: Path, target: Path) -> Iterator[ET.Element]:
    """A body's link, the joints by which it hangs on its parent, a link between any two of them, and its sites."""
    name, parent = _name(model, body), _name(model, int(model.body_parentid[body]))
    position, orientation = model.body_pos[body], model.body_quat[body]
    first = int(model.body_jntadr[body])
    for number in range(first, first + int(model.body_jntnum[body])):
        joint = str(model.joint(number).name)
        kind = _KINDS.get(mujoco.mjtJoint(model.jnt_type[number]))
        if kind is None or model.qpos0[model.jnt_qposadr[number]] != 0.0:
            raise DescriptionInvalid(str(path), f"joint {joint} is free, a ball, or not at zero", "no arm has such")
        anchor, between = model.jnt_pos[number], f"{name}_at_{joint}"
        moving = _joint(joint, kind, (parent, between), position + _turned(orientation, anchor), orientation)
        ET.SubElement(moving, "axis", {"xyz": _words(model.jnt_axis[number])})
        limit = {"effort": "0"}
        if model.jnt_limited[number]:
            limit |= dict(zip(("lower", "upper"), map(repr, model.jnt_range[number].tolist()), strict=True))
        ET.SubElement(moving, "limit", limit)
        yield ET.Element("link", {"name": between})
        yield moving
        parent, position, orientation = between, -anchor, np.array([1.0, 0.0, 0.0, 0.0])
    yield _joint(f"{name}_fixed", "fixed", (parent, name), position, orientation)
    yield _link(model, body, target)
    for number in np.flatnonzero(model.site_bodyid == body).tolist():
        site = model.site(number).name or f"site_{number}"
        yield ET.Element("link", {"name": site})
        yield _joint(f"{site}_fixed", "fixed", (name, site), model.site_pos[number], model.site_quat[number])


def _link(model: mujoco.MjModel, body: int, target: Path) -> ET.Element:
    link = ET.Element("link", {"name": _name(model, body)})
    inertial = ET.SubElement(link, "inertial")
    inertial.append(_origin(model.body_ipos[body], model.body_iquat[body]))
    ET.SubElement(inertial, "mass", {"value": repr(float(model.body_mass[body]))})
    moments = dict(zip(("ixx", "iyy", "izz"), map(repr, model.body_inertia[body].tolist()), strict=True))
    ET.SubElement(inertial, "inertia", {"ixy": "0", "ixz": "0", "iyz": "0", **moments})
    for geom in np.flatnonzero(model.geom_bodyid == body).tolist():
        collides = bool(model.geom_contype[geom] or model.geom_conaffinity[geom])
        drawn = _LEAST_DRAWN <= model.geom_group[geom] <= _MOST_DRAWN
        for kind, wanted in (("visual", drawn or not collides), ("collision", collides)):
            if wanted:
                link.extend(list(_shapes(model, geom, kind, target)))
    return link


def _shapes(model: mujoco.MjModel, geom: int, kind: str, target: Path) -> Iterator[ET.Element]:
    """A geom; a capsule is a cylinder with two balls, and what is neither of URDF's shapes the box around it."""
    size, position, orientation = model.geom_size[geom], model.geom_pos[geom], model.geom_quat[geom]
    radius, half = repr(float(size[0])), float(size[1])
    match _GEOM(model.geom_type[geom]):
        case _GEOM.mjGEOM_MESH:
            forms = [("mesh", {"filename": str(target / _mesh_name(int(model.geom_dataid[geom])))}, 0.0)]
        case _GEOM.mjGEOM_SPHERE:
            forms = [("sphere", {"radius": radius}, 0.0)]
        case _GEOM.mjGEOM_CYLINDER:
            forms = [("cylinder", {"radius": radius, "length": repr(2.0 * half)}, 0.0)]
        case _GEOM.mjGEOM_CAPSULE:
            balls = [("sphere", {"radius": radius}, end) for end in (-half, half)]
            forms = [("cylinder", {"radius": radius, "length": repr(2.0 * half)}, 0.0), *balls]
        case _:
            forms = [("box", {"size": _words(2.0 * size)}, 0.0)]
    for tag, numbers, along in forms:
        shape = ET.Element(kind)
        shape.append(_origin(position + _turned(orientation, np.array([0.0, 0.0, along])), orientation))
        ET.SubElement(ET.SubElement(shape, "geometry"), tag, numbers)
        if kind == "visual":
            material = ET.SubElement(shape, "material", {"name": f"colour_{geom}"})
            ET.SubElement(material, "color", {"rgba": _words(model.geom_rgba[geom])})
        yield shape


def _joint(name: str, kind: str, between: tuple[str, str], position: Array, orientation: Array) -> ET.Element:
    joint = ET.Element("joint", {"name": name, "type": kind})
    for end, link in zip(("parent", "child"), between, strict=True):
        ET.SubElement(joint, end, {"link": link})
    joint.append(_origin(position, orientation))
    return joint


def _origin(position: Array, orientation: Array) -> ET.Element:
    matrix = np.zeros(9)
    mujoco.mju_quat2Mat(matrix, orientation)
    m = matrix.reshape(3, 3)
    pitch = np.arctan2(-m[2, 0], np.hypot(m[0, 0], m[1, 0]))
    if np.hypot(m[0, 0], m[1, 0]) > 1e-9:
        roll, yaw = np.arctan2(m[2, 1], m[2, 2]), np.arctan2(m[1, 0], m[0, 0])
    else:  # straight up or down roll and yaw are one
        roll, yaw = np.arctan2(-m[1, 2], m[1, 1]), 0.0
    return ET.Element("origin", {"xyz": _words(position), "rpy": _words(np.array([roll, pitch, yaw]))})


def _turned(orientation: Array, vector: Array) -> Array:
    turned = np.zeros(3)
    mujoco.mju_rotVecQuat(turned, vector, orientation)
    return turned


def _name(model: mujoco.MjModel, body: int) -> str:
    return "world_link" if body == 0 else str(model.body(body).name) or f"body_{body}"


def _mesh_name(number: int) -> str:
    return f"mesh_{number}.stl"


def _words(values: Array) -> str:
    return " ".join(repr(float(value)) for value in values)
