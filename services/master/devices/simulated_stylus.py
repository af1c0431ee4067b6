"""A haptic stylus without the hardware, and whoever pushes it."""

from __future__ import annotations

from typing import Protocol

from protocol.messages import Vector3
from sim.person.stylus import Stylus, StylusState


class Push(Protocol):
    """Whoever pushes and turns the stylus."""

    @property
    def rotation(self) -> Vector3 | None:
        """How the handle is held, rotation vector in base axes; None where nobody holds it [rad]."""
        ...

    def force(self, stylus: StylusState) -> Vector3:
        """The push [N]."""
        ...


class SimulatedStylus:
    """See `HapticDevice`.

    Args:
        stylus: the body.
        hand: who pushes it.
    """

    def __init__(self, stylus: Stylus, hand: Push) -> None:
        self._stylus = stylus
        self._hand = hand

    @property
    def state(self) -> StylusState:
        """See `HapticDevice`."""
        return self._stylus.state

    def exchange(self, force: Vector3, dt: float) -> StylusState:
        """See `HapticDevice`: the hand pushes against what it feels."""
        (hx, hy, hz), (fx, fy, fz) = self._hand.force(self._stylus.state), force
        return self._stylus.step((hx + fx, hy + fy, hz + fz), dt, self._hand.rotation)
