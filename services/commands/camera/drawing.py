"""The robot at home with its cameras where they are said, or were measured, to be."""

from __future__ import annotations

import math
from collections.abc import Iterator, Mapping

import numpy as np

from lfd.motion.rotations import rotate
from protocol.messages import Pose
from services.bus.arrays import vector3
from services.camera.calibrated import calibrated
from services.camera.places import Mounting
from services.commands.camera.eyes import eyes
from services.process.config import Configuration
from services.process.exceptions import CommandFailed
from services.process.robots import scene_of
from sim.robots.robot import Base
from sim.tasks import described
from sim.tasks.reaching import ReachingScene
from sim.world.links import Links
from sim.world.pictures import png
from sim.world.portrait import Dot, portrait

_COLOURS = ((0.85, 0.15, 0.12, 1.0), (0.15, 0.65, 0.20, 1.0), (0.15, 0.30, 0.85, 1.0))
_LENGTHS = (0.06, 0.06, 0.30)  # [m] of the axes: what a camera looks along is the longest
_STEP = 0.02


def drawn(chosen: Configuration) -> bytes:
    """A PNG file.

    Raises:
        CommandFailed: the scene has no arm.
        CameraUnfit: a camera is fixed to a link that is not there.
        SimError: the robot cannot be drawn.
    """
    scene = scene_of(chosen.robot)
    if not isinstance(scene, ReachingScene):
        raise CommandFailed(f"there is no arm in scene {scene.name}: take another one")
    robot, links, base = scene.manipulator, Links(scene, described(scene)), scene.stance.base or Base()
    joints = dict(zip(robot.joint_names, robot.home, strict=True))
    dots = [
        dot
        for name, eye in eyes(chosen).items()
        for dot in _axes(_placed(links, joints, calibrated(chosen.name, name).mounting or eye.mounting, name), base)
    ]
    return png(portrait(robot, dots=dots))


def _placed(links: Links, joints: Mapping[str, float], fixed: Mounting, camera: str) -> Pose:
    if not fixed.link:
        return Pose(fixed.position, fixed.orientation)
    links.check(camera, fixed.link)
    at = links.pose(fixed.link, joints)
    return fixed.on(at.position, at.orientation)


def _axes(eye: Pose, base: Base) -> Iterator[Dot]:
    """Along the axes of a camera, in the frame of the robot's first link."""
    upright = np.array([math.cos(base.yaw / 2), 0.0, 0.0, -math.sin(base.yaw / 2)])
    for axis, length, colour in zip(np.eye(3), _LENGTHS, _COLOURS, strict=True):
        for along in np.arange(0.0, length, _STEP):
            place = np.array(eye.position) + rotate(np.array(eye.orientation), along * axis)
            yield Dot(vector3(rotate(upright, place - base.position)), colour)
