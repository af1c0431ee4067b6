"""Where a camera is: somewhere in the scene, or on one of the robot's links."""

from __future__ import annotations

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


class Place(Protocol):
    """Where a camera is."""

    def pose(self, now_ns: int) -> Pose | None:
        """Now, in the base frame; None where that is not known."""
        ...


class Standing(NamedTuple):
    """In the scene; see `Place`."""

    at: Pose

    def pose(self, now_ns: int) -> Pose:
        """See `Place.pose`."""
        del now_ns
        return self.at


class Carried(NamedTuple):
    """By a link, as the robot's joints are measured; see `Place`."""

    mounting: Mounting
    links: Links
    robot: Subscription[RobotState]

    def pose(self, now_ns: int) -> Pose | None:
        """See `Place.pose`; nobody knows it while the robot is not heard."""
        state = self.robot.fresh(now_ns)
        if state is None:
            return None
        at = self.links.pose(self.mounting.link, dict(zip(state.joint_names, state.q, strict=False)))
        return self.mounting.on(at.position, at.orientation)


def mounting(said: Mounted) -> Mounting:
    """As a configuration says it: roll, pitch and yaw one after another about the link's axes."""
    orientation = np.array([1.0, 0.0, 0.0, 0.0])
    for axis, angle in zip(np.eye(3), said.turned, strict=True):
        orientation = multiply(exp_map(angle * axis), orientation)
    return Mounting(said.link, said.position, quaternion(orientation))
