"""How a device's axis becomes a deflection: its rest and range, its dead zone, its curve, what strays from others."""

from __future__ import annotations

import math
from collections.abc import Sequence

from protocol.messages import Controller
from services.process.profile import Profile, Way


def deflection(controller: Controller, way: Way, profile: Profile) -> float:
    """How far a way is deflected along its axis of the convention, from -1 to 1; 0 where the device has not its parts.

    Odd, monotonic and continuous in what the device says: zero in the dead zone, and from its edge on
    (1 - e) w + e w^3, where w is the share of the way from that edge to the end.
    """
    return way.sign * _curved(spanned(_at(controller.axes, way.axis, way.rest), way), profile) + _curved(
        _at(controller.buttons, way.plus, 0.0) - _at(controller.buttons, way.minus, 0.0), profile
    )


def meant(deflections: Sequence[float], crosstalk: float) -> list[float]:
    """What is meant of all that one hand deflects at once: no cap is pushed one way without a little of another.

    Odd, monotonic in each and continuous in all: the furthest deflection m stays, each other d leads by what it goes
    beyond c |m|, (|d| - c |m|) / (1 - c).

    Args:
        deflections: from -1 to 1 each.
        crosstalk: c, from 0 to less than 1.
    """
    astray = crosstalk * max(map(abs, deflections), default=0.0)
    return [math.copysign(max(0.0, abs(one) - astray) / (1.0 - crosstalk), one) for one in deflections]


def position(controller: Controller, way: Way) -> float:
    """Where a way stands that is dragged, as far as it will, along its axis of the convention."""
    return way.sign * (_at(controller.axes, way.axis, way.rest) - way.rest)


def spanned(value: float, way: Way) -> float:
    """An axis' value as a share of its range to the side of its rest where it is, from -1 to 1."""
    side = way.high - way.rest if value > way.rest else way.rest - way.low
    return max(-1.0, min(1.0, (value - way.rest) / side)) if side > 0.0 else 0.0


def _curved(share: float, profile: Profile) -> float:
    beyond = abs(share) - profile.dead_zone
    if beyond <= 0.0:
        return 0.0
    w = beyond / (1.0 - profile.dead_zone)
    curved = (1.0 - profile.expo) * w + profile.expo * w**3
    return curved if share > 0.0 else -curved


def _at(values: tuple[float, ...], index: int | None, otherwise: float) -> float:
    return values[index] if index is not None and index < len(values) else otherwise
