"""The pad of the operator's page, in place of a stylus: a mouse or a pen drags what it grips.

The page counts how far was dragged without end, so that a sample that is lost loses no distance.
"""

from __future__ import annotations

from collections.abc import Mapping

from protocol.messages import OperatorInput, Vector3
from services.master.devices.controllers import is_pressed
from services.master.devices.curve import position
from services.master.devices.device import ZERO
from services.master.devices.hand import Hand
from services.master.devices.profiles import Profiles

GRIP = 0
"""The button that the page gives for a pen that is down."""

Place = tuple[Vector3, Vector3]


class Pad:
    """The pad.

    Args:
        profiles: how it is read.
    """

    kind = "pointer"

    def __init__(self, profiles: Profiles) -> None:
        self._profiles = profiles
        self._before: Place | None = None

    def look(self, operator: OperatorInput) -> Mapping[str, Hand]:
        """By how much it was dragged since the look before, while it was gripped then and is now."""
        pad = next((one for one in operator.controllers if one.kind == self.kind), None)
        if pad is None:
            self._before = None
            return {}
        profile = self._profiles.of(pad)
        gripped = is_pressed(pad, GRIP)
        ways = profile.ways
        place: Place = (
            _scaled(profile.scale, *(position(pad, way) for way in (ways.x, ways.y, ways.z))),
            _scaled(profile.turn_scale, *(position(pad, way) for way in (ways.roll, ways.pitch, ways.yaw))),
        )
        before, self._before = self._before, place if gripped else None
        if before is None or not gripped:
            return {self.kind: Hand(held=gripped, grips=gripped, lifted=not gripped)}
        drag, twist = (_difference(now, then) for now, then in zip(place, before, strict=True))
        return {self.kind: Hand(ZERO, ZERO, drag, twist, held=True, grips=True)}

    def close(self) -> None:
        """The page reads it."""


def _scaled(scale: float, x: float, y: float, z: float) -> Vector3:
    return (scale * x, scale * y, scale * z)


def _difference(now: Vector3, then: Vector3) -> Vector3:
    return (now[0] - then[0], now[1] - then[1], now[2] - then[2])
