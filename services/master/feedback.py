"""The force that a hand may feel: eq. 14 and contact, within a limit, rising slowly, and none once nobody answers."""

from __future__ import annotations

import math

from lfd import haptics
from protocol.messages import Vector3
from services.master.contact import ContactForce, room_for
from services.master.devices.device import ZERO
from sim.person.stylus import StylusState

FRESH_S = 0.05
"""Up to this age of what is known of the robot the force is whole [s]."""

STALE_S = 0.1
"""From this age on it is zero; between the two it falls [s]."""

SOFT_START_S = 0.5
"""In this time it rises from zero to the whole [s]."""


def spring_damper(stylus: StylusState, stiffness: float, damping: float) -> Vector3:
    """Eq. 14 [N]. Axis by axis: for a vector of three NumPy takes longer than all the rest of a step.

    Args:
        stylus: where it is.
        stiffness: k [N/m].
        damping: d [N s/m].
    """
    (x, y, z), (vx, vy, vz) = stylus.position, stylus.velocity
    return (
        haptics.force(x, vx, stiffness, damping),
        haptics.force(y, vy, stiffness, damping),
        haptics.force(z, vz, stiffness, damping),
    )


def limited(force: Vector3, limit: float) -> Vector3:
    """The force, or one of the same direction that is no larger than the limit [N]."""
    size = math.hypot(*force)
    return force if size <= limit else _times(force, limit / size)


class Feedback:
    """The force of one device.

    Args:
        stiffness: k of eq. 14 [N/m].
        damping: d of eq. 14 [N s/m].
        limit: of the force [N].

    Attributes:
        gain: share of the force that is rendered now.
        contact: what is felt of what the robot touches.
    """

    def __init__(self, stiffness: float, damping: float, limit: float) -> None:
        self._stiffness = stiffness
        self._damping = damping
        self._limit = limit
        self.gain = 0.0
        self.contact = ContactForce()

    def restart(self) -> None:
        """Rise from zero again."""
        self.gain = 0.0

    def force(self, stylus: StylusState, age_s: float, dt: float) -> Vector3:
        """What the hand feels now [N].

        Args:
            stylus: where it is.
            age_s: of the newest that is known of the robot [s].
            dt: since the call before [s].
        """
        self.contact.move(stylus.position)
        self.gain = min(self.gain + dt / SOFT_START_S, share_of_fresh(age_s))
        if self.gain <= 0.0:
            self.contact.render(ZERO)
            return ZERO
        local = _times(limited(spring_damper(stylus, self._stiffness, self._damping), self._limit), self.gain)
        contact = room_for(self.contact.wanted(stylus.velocity, self.gain, dt), local, self._limit)
        self.contact.render(contact)
        return (local[0] + contact[0], local[1] + contact[1], local[2] + contact[2])


def share_of_fresh(age_s: float) -> float:
    """1 up to `FRESH_S`, 0 from `STALE_S` on, a line between."""
    return max(0.0, min(1.0, (STALE_S - age_s) / (STALE_S - FRESH_S)))


def _times(force: Vector3, share: float) -> Vector3:
    return (force[0] * share, force[1] * share, force[2] * share)
