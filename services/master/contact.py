"""The hand's port of the network between hand and contact: the contact force comes out, what the hand does goes in.

See `lfd.passivity`. The force that the robot tells is rendered as far as it does no work on the hand that contact did
not do on the robot; the local force (eq. 14) is no part of it.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from lfd.passivity import Port
from protocol.messages import RobotState, Vector3
from services.master.devices.device import ZERO

SMOOTHED_S = 0.01
"""Time constant with which the force follows what is told [s]: it is told a hundred times a second."""

FARTHEST = 0.02
"""From one frame to the next no hand moves further [m]: the neutral place was set anew."""


class _Told(NamedTuple):
    force: Vector3 = ZERO
    source: int = 0
    energy: float = 0.0


class ContactForce:
    """What the hand feels of what the robot touches.

    One thread hears, another one feels and moves.
    """

    def __init__(self) -> None:
        self._port = Port()
        self._told: _Told | None = None
        self._smooth = self._rendered = ZERO
        self._before: Vector3 | None = None

    @property
    def energy_in(self) -> float:
        """That the hand put in against the contact force since the beginning [J]."""
        return self._port.energy_in

    def hear(self, robot: RobotState | None, lever: float = 1.0) -> None:
        """Take note of what the robot feels; None where nothing of it is to be felt.

        Args:
            robot: newest that is known.
            lever: by how much further the robot moves than the hand. The force is larger by as much, so that both ends
                of the lever do the same work.
        """
        if robot is None:
            self._told = None
            return
        x, y, z = robot.contact_force
        self._told = _Told((lever * x, lever * y, lever * z), robot.publisher, robot.contact_energy)

    def move(self, position: Vector3) -> None:
        """The device was seen at a position [m], with the force of before: count what that force did."""
        before, self._before = self._before, position
        (x, y, z), (fx, fy, fz) = position, self._rendered
        if before is None or self._rendered == ZERO or math.dist(position, before) > FARTHEST:
            return
        self._port.observe(fx * (x - before[0]) + fy * (y - before[1]) + fz * (z - before[2]))

    def wanted(self, velocity: Vector3, gain: float, dt: float) -> Vector3:
        """The force that may be rendered in this frame [N].

        Args:
            velocity: of the device [m/s].
            gain: share of the force that counts now.
            dt: duration of the frame [s].
        """
        told = self._told
        fx, fy, fz = told.force if told is not None else ZERO
        if told is not None:
            self._port.hear(told.source, told.energy)
        share = -math.expm1(-dt / SMOOTHED_S)
        x, y, z = self._smooth
        self._smooth = x, y, z = x + share * (fx - x), y + share * (fy - y), z + share * (fz - z)
        return self._port.force((gain * x, gain * y, gain * z), velocity)

    def render(self, force: Vector3) -> None:
        """What of it is rendered from now on [N]."""
        self._rendered = force


def room_for(part: Vector3, beside: Vector3, limit: float) -> Vector3:
    """So much of a force that with what is rendered beside it the limit is kept; the direction stays [N].

    Args:
        part: the force.
        beside: no larger than the limit.
        limit: of the sum.
    """
    # The largest share s in [0, 1] with |beside + s part| <= limit; the product of both roots is not positive.
    a = part[0] ** 2 + part[1] ** 2 + part[2] ** 2
    b = part[0] * beside[0] + part[1] * beside[1] + part[2] * beside[2]
    c = beside[0] ** 2 + beside[1] ** 2 + beside[2] ** 2 - limit**2
    if a + 2.0 * b + c <= 0.0:
        return part
    root = math.sqrt(max(0.0, b * b - a * c))
    share = max(0.0, min(1.0, (root - b) / a if b <= 0.0 else -c / (root + b))) if a > 0.0 else 0.0
    return (share * part[0], share * part[1], share * part[2])
