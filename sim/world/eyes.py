"""Cameras in a MuJoCo model, each fixed to a link or to the scene."""

from collections.abc import Iterable

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.exceptions import CameraUnfit
from sim.robots.gripper import Mount
from sim.robots.robot import Camera
from sim.rotations import rotated


def add_cameras(spec: mujoco.MjSpec, cameras: Iterable[Camera]) -> None:
    """Add cameras; one of a name that is there already takes that one's place.

    Args:
        spec: Of the model.
        cameras: To add.

    Raises:
        CameraUnfit: One is fixed to a link that is not there.
    """
    for camera in cameras:
        before = spec.camera(camera.name)
        if before is not None:
            spec.delete(before)
        link = camera.mount.link
        body = spec.body(link) if link else spec.worldbody
        if body is None:
            raise CameraUnfit(camera.name, link)
        body.add_camera(name=camera.name, pos=camera.mount.position, quat=_seeing(camera.mount), fovy=camera.fovy)


def _seeing(mount: Mount) -> NDArray[np.float64]:
    """Return how MuJoCo has a camera, which looks along -z there with y up: optical axes, half a turn about x."""
    orientation = np.array([1.0, 0.0, 0.0, 0.0])
    for axis, angle in zip(np.eye(3), mount.rpy, strict=True):
        orientation = rotated(orientation, angle * axis)
    turned = np.zeros(4)
    mujoco.mju_mulQuat(turned, orientation, np.array([0.0, 1.0, 0.0, 0.0]))
    return turned
