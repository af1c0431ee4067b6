"""Three numbers that a hand leads, as fast as the clock goes and not as fast as messages come."""

from __future__ import annotations

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
        reach: largest [u].
    """

    growth: float
    decay: float
    reach: float


def pushed(value: float, deflection: float, dt: float, law: Law) -> float:
    """One number after dt [s]: grows as far as it is pushed, from -1 to 1, decays to zero where it is not [u]."""
    if deflection == 0.0:
        return _towards_zero(value, law.decay * dt)
    return _within(value + deflection * law.growth * dt, law.reach)


def _towards_zero(value: float, distance: float) -> float:
    return max(0.0, value - distance) if value > 0.0 else min(0.0, value + distance)


def _within(value: float, reach: float) -> float:
    return max(-reach, min(reach, value))


class Lever:
    """Three numbers, zero at first, each by itself.

    Args:
        law: by which they answer.
    """

    def __init__(self, law: Law) -> None:
        self._law = law
        self.value = ZERO

    def take_over(self, value: Vector3) -> None:
        """Go on from a value, as far as the reach allows."""
        x, y, z = (_within(v, self._law.reach) for v in value)
        self.value = (x, y, z)

    def push(self, deflections: Vector3, dt: float) -> None:
        """Be pushed for dt [s], each number as far as its deflection says."""
        x, y, z = (pushed(v, way, dt, self._law) for v, way in zip(self.value, deflections, strict=True))
        self.value = (x, y, z)

    def drag(self, distances: Vector3) -> None:
        """Be dragged, each number by its distance in reaches."""
        x, y, z = (
            _within(v + way * self._law.reach, self._law.reach) for v, way in zip(self.value, distances, strict=True)
        )
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
        self.take_over(self.value)
        x, y, z = (_towards_zero(v, self._law.reach / LET_GO_S * dt) for v in self.value)
        self.value = (x, y, z)


class TurnLever(Lever):
    """The same of a rotation vector: what leads alone turns about the base axes, however far it has turned."""

    def lead(self, deflections: Vector3, distances: Vector3, dt: float) -> None:
        """See `Lever`."""
        step = dt * self._law.growth * np.array(deflections) + self._law.reach * np.array(distances)
        self.value = vector3(log_map(multiply(exp_map(step), exp_map(np.array(self.value)))))
