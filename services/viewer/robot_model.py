"""The robot's shape, moved by its joints."""

from __future__ import annotations

import xml.etree.ElementTree as ET
from collections.abc import Sequence
from pathlib import Path

import numpy as np
import rerun as rr
from numpy.typing import NDArray

from services.viewer import entities
from services.viewer.run import Run
from sim.robots.gripper import Gripper

Floats = NDArray[np.float64]

_LINKS = f"{entities.ROBOT}/links"
_MOVING = f"{entities.ROBOT}/moving"


class RobotModel:
    """The robot in a run of the viewer.

    Args:
        urdf: its description.
        run: where it is drawn.
        gripper: of it.
    """

    def __init__(self, urdf: Path, run: Run, gripper: Gripper) -> None:
        self._run = run
        self._gripper = gripper
        self._tree = rr.urdf.UrdfTree.from_file_path(
            urdf, entity_path_prefix=entities.ROBOT.removeprefix("/"), static_transform_entity_path=_LINKS
        )
        self._joints = _Joints(self._tree, ())
        run.always("robot", self._tree.log_urdf_to_recording)
        for path in _primitives(urdf, self._tree):
            run.log_always(path, rr.Boxes3D.from_fields(fill_mode="solid"))
        # What is drawn at paths, without a frame of its own, stands in the robot's base frame.
        base = rr.Transform3D(parent_frame=f"tf#{entities.WORLD}", child_frame=self._tree.root_link().name)
        run.log_always(f"{entities.ROBOT}/base", base)

    def move(self, names: Sequence[str], q: Sequence[float], opening: float) -> None:
        """Put the joints where they are; those that the description does not have are left out.

        Args:
            names: of the joints.
            q: positions, in the order of `names` [rad, m].
            opening: of the gripper [m].
        """
        if len(q) != len(names):
            return
        fingers = self._gripper.positions(opening)
        moving = (*names, *fingers)
        if moving != self._joints.names:
            self._joints = _Joints(self._tree, moving)
        if self._joints.rows:
            self._run.row(_MOVING, self._joints, (*q, *fingers.values()))


class _Joints:
    """Where the links of some joints are, each in its parent's frame; of the kind whose values are their positions.

    Args:
        tree: the description.
        names: of the joints; those that it does not have are left out.
    """

    def __init__(self, tree: rr.urdf.UrdfTree, names: tuple[str, ...]) -> None:
        self.names = names
        pairs = [(i, joint) for i, name in enumerate(names) if (joint := tree.get_joint_by_name(name)) is not None]
        joints = [joint for _, joint in pairs]
        self.rows = len(joints)
        self._parents, self._children = [joint.parent_link for joint in joints], [joint.child_link for joint in joints]
        self._index = np.array([i for i, _ in pairs], dtype=int)
        self._slides = np.array([joint.joint_type == "prismatic" for joint in joints], dtype=bool)[:, None]
        self._axes = np.array([joint.axis for joint in joints]).reshape(-1, 3)
        self._origins = np.array([joint.origin_xyz for joint in joints]).reshape(-1, 3)
        self._rotations = _quaternions(np.array([joint.origin_rpy for joint in joints]).reshape(-1, 3))

    def columns(self, values: Sequence[Sequence[float]]) -> list[rr.ComponentColumn]:
        """A row for each joint, as often as there are values [rad, m]."""
        translations, quaternions = self.transforms(np.array(values))
        return list(
            rr.Transform3D.columns(
                translation=translations.reshape(-1, 3),
                quaternion=quaternions.reshape(-1, 4),
                parent_frame=self._parents * len(values),
                child_frame=self._children * len(values),
            )
        )

    def transforms(self, q: Floats) -> tuple[Floats, Floats]:
        """Translations, shape (..., n, 3) [m], and quaternions as Rerun has them, scalar last, shape (..., n, 4)."""
        value = q[..., self._index, None]
        slide = np.where(self._slides, value, 0.0) * self._axes
        half = np.where(self._slides, 0.0, value) / 2
        turned = _product(self._rotations, np.concatenate([np.sin(half) * self._axes, np.cos(half)], axis=-1))
        conjugate = self._rotations * [-1.0, -1.0, -1.0, 1.0]
        along = _product(_product(self._rotations, np.concatenate([slide, np.zeros_like(half)], axis=-1)), conjugate)
        return self._origins + along[..., :3], turned


def _product(p: Floats, q: Floats) -> Floats:
    """Hamilton products of quaternions, scalar last, shapes (..., n, 4)."""
    pv, pw, qv, qw = p[..., :3], p[..., 3:], q[..., :3], q[..., 3:]
    scalar = pw * qw - np.sum(pv * qv, axis=-1, keepdims=True)
    return np.concatenate([pw * qv + qw * pv + np.cross(pv, qv), scalar], axis=-1)


def _quaternions(rpy: Floats) -> Floats:
    """Roll, pitch and yaw about fixed axes, shape (n, 3) [rad], as quaternions, scalar last, shape (n, 4)."""
    x, y, z = (
        np.hstack([np.sin(angle) * axis, np.cos(angle)])
        for angle, axis in zip(np.split(rpy / 2, 3, axis=1), np.eye(3), strict=True)
    )
    return _product(z, _product(y, x))


def _primitives(urdf: Path, tree: rr.urdf.UrdfTree) -> list[str]:
    """The paths of the links that are made of boxes: the loader draws their edges and a translucent filling."""
    links = ET.parse(urdf).getroot().iterfind("link")
    boxy = [link.attrib["name"] for link in links if link.find("visual/geometry/box") is not None]
    return [path for name in boxy for path in tree.get_visual_geometry_paths(name)]
