"""Where a camera is: somewhere in the scene, or on one of the robot's links."""

from __future__ import annotations

from collections.abc import Mapping
from typing import NamedTuple, Protocol

import numpy as np

from lfd.motion.rotations import exp_map, multiply, rotate
from protocol.messages import Pose, Quaternion, RobotState, Vector3
from services.bus.arrays import Floats, quaternion, vector3
from services.bus.subscription import Subscription
from services.process.cameras import Mounted
from sim.world.links import Links


class Mounting(NamedTuple):
    """How a camera is fixed: its optical frame (x right, y down, z forward) in that of a link.

    Attributes:
        link: of the robot; empty for the base frame.
        position: [m].
        orientation: unit quaternion, scalar first.
    """

    link: str
    position: Vector3
    orientation: Quaternion

    def on(self, position: Floats, orientation: Floats) -> Pose:
        """Where the camera is in the base frame, while the link is there."""
        at = position + rotate(orientation, np.array(self.position))
        return Pose(vector3(at), quaternion(multiply(orientation, np.array(self.orientation))))


Joints = Mapping[str, float]
"""Positions of a robot's joints, by name [rad, m]."""


class Place(Protocol):
    """Where a camera is."""

    def joints(self, now_ns: int) -> Joints | None:
        """Of the robot now, as far as the camera's place depends on them; None where they are not known.

        Safe to use from any thread: they are read when a picture comes, whenever it is looked at.
        """
        ...

    def pose(self, joints: Joints) -> Pose:
        """In the base frame, while the joints are so."""
        ...


class Standing(NamedTuple):
    """In the scene; see `Place`."""

    at: Pose

    def joints(self, now_ns: int) -> Joints:
        """See `Place.joints`."""
        del now_ns
        return {}

    def pose(self, joints: Joints) -> Pose:
        """See `Place.pose`."""
        del joints
        return self.at


class Carried(NamedTuple):
    """By a link, as the robot's joints are measured; see `Place`."""

    mounting: Mounting
    links: Links
    robot: Subscription[RobotState]

    def joints(self, now_ns: int) -> Joints | None:
        """See `Place.joints`."""
        state = self.robot.fresh(now_ns)
        return None if state is None else dict(zip(state.joint_names, state.q, strict=False))

    def pose(self, joints: Joints) -> Pose:
        """See `Place.pose`."""
        at = self.links.pose(self.mounting.link, joints)
        return self.mounting.on(at.position, at.orientation)


def mounting(said: Mounted) -> Mounting:
    """As a configuration says it: roll, pitch and yaw one after another about the link's axes."""
    orientation = np.array([1.0, 0.0, 0.0, 0.0])
    for axis, angle in zip(np.eye(3), said.turned, strict=True):
        orientation = multiply(exp_map(angle * axis), orientation)
    return Mounting(said.link, said.position, quaternion(orientation))
