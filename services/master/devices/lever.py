"""Three numbers that a hand leads, as fast as the clock goes and not as fast as messages come."""

from __future__ import annotations

import math
from dataclasses import dataclass

import numpy as np

from lfd.motion.rotations import exp_map, log_map, multiply
from protocol.messages import Vector3
from services.bus.arrays import vector3
from services.master.devices.device import ZERO

LET_GO_S = 0.2
"""Within this time all of them are zero after focus, tab, link, device or process was lost [s]."""


@dataclass(frozen=True)
class Law:
    """How the numbers answer; their unit u is the metre or the radian.

    Attributes:
        growth: of a number while it is pushed all the way [u/s].
        decay: towards zero while it is not [u/s].
        reach: farthest that it can be pushed or dragged [u].
    """

    growth: float
    decay: float
    reach: float


def pushed(value: float, deflection: float, dt: float, law: Law) -> float:
    """One number after dt [s]: grows as far as it is pushed, from -1 to 1, decays to zero where it is not [u]."""
    if deflection == 0.0:
        return _towards_zero(value, law.decay * dt)
    return _moved(value, deflection * law.growth * dt, law.reach)


def turned(vector: Vector3, yaw: float) -> Vector3:
    """The vector, turned about the z axis, counter-clockwise from above [rad]."""
    x, y, z = vector
    cosine, sine = math.cos(yaw), math.sin(yaw)
    return (cosine * x - sine * y, sine * x + cosine * y, z)


def _moved(value: float, by: float, reach: float) -> float:
    """As far as it reaches; what is beyond that already goes no further, and does not jump back."""
    return _within(value + by, max(reach, abs(value)))


def _towards_zero(value: float, distance: float) -> float:
    return max(0.0, value - distance) if value > 0.0 else min(0.0, value + distance)


def _within(value: float, reach: float) -> float:
    return max(-reach, min(reach, value))


class Lever:
    """Three numbers along three axes, zero at first, each by itself.

    Args:
        law: by which they answer.
    """

    def __init__(self, law: Law) -> None:
        self._law = law
        self.value = ZERO

    def take_over(self, value: Vector3) -> None:
        """Go on from a value, which may lie beyond the reach: nothing jumps."""
        self.value = value

    def turn_axes(self, yaw: float) -> None:
        """Tell the same value in other axes, turned about z by this much [rad]."""
        self.value = turned(self.value, -yaw)

    def push(self, deflections: Vector3, dt: float) -> None:
        """Be pushed for dt [s], each number as far as its deflection says."""
        x, y, z = (pushed(v, way, dt, self._law) for v, way in zip(self.value, deflections, strict=True))
        self.value = (x, y, z)

    def drag(self, distances: Vector3) -> None:
        """Be dragged, each number by its distance in reaches."""
        reach = self._law.reach
        x, y, z = (_moved(v, way * reach, reach) for v, way in zip(self.value, distances, strict=True))
        self.value = (x, y, z)

    def lead(self, deflections: Vector3, distances: Vector3, dt: float) -> None:
        """Be pushed and dragged as far as it goes, and stay where nothing does either."""
        x, y, z = (
            v + way * self._law.growth * dt + far * self._law.reach
            for v, way, far in zip(self.value, deflections, distances, strict=True)
        )
        self.value = (x, y, z)

    def let_go(self, dt: float) -> None:
        """Return to zero, within `LET_GO_S` from anywhere that it reaches."""
        reach = self._law.reach
        x, y, z = (_towards_zero(_within(v, reach), reach / LET_GO_S * dt) for v in self.value)
        self.value = (x, y, z)


class TurnLever(Lever):
    """The same of a rotation vector: what leads alone turns about the base axes, however far it has turned."""

    def lead(self, deflections: Vector3, distances: Vector3, dt: float) -> None:
        """See `Lever`."""
        step = dt * self._law.growth * np.array(deflections) + self._law.reach * np.array(distances)
        self.value = vector3(log_map(multiply(exp_map(step), exp_map(np.array(self.value)))))
