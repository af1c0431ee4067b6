"""What was measured of a device becomes a profile: where its axes rest, how far they go, how much they drift."""

from __future__ import annotations

import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

from protocol.messages import Controller
from services.master.devices.profiles import Profiles
from services.process.profile import Way

MOVED = 0.25
"""An axis that left its rest by less was not moved."""

MARGIN = 2.0
"""The dead zone is so many times what a stick strays by at rest."""

LEAST_DEAD_ZONE = 0.05
MOST_DEAD_ZONE = 0.4
ENDS = 0.9
"""An axis that rests beyond this is a trigger: it has one end."""

_LEADS = ("y", "x", "yaw", "z")
"""What the sticks of a device lead whose order no standard tells, as they are counted."""


@dataclass(frozen=True)
class Axis:
    """What was measured of one axis.

    Attributes:
        rest: the middle of what it said while nobody touched it.
        strays: by how much it strayed from there meanwhile.
        low: the least that it ever said.
        high: the most.
    """

    rest: float
    strays: float
    low: float
    high: float

    @property
    def moved(self) -> bool:
        """Somebody has moved it."""
        return self.high - self.rest >= MOVED or self.rest - self.low >= MOVED

    @property
    def is_trigger(self) -> bool:
        """It rests at one end."""
        return abs(self.rest) >= ENDS

    @property
    def share(self) -> float:
        """By which part of its way it strays."""
        sides = [side for side in (self.high - self.rest, self.rest - self.low) if side >= MOVED]
        return self.strays / min(sides) if sides else 0.0


def measured(resting: Sequence[Controller], moving: Sequence[Controller]) -> tuple[Axis, ...]:
    """What the axes of one device did: first at rest, then moved to all their ends."""
    n = min(len(one.axes) for one in (*resting, *moving))
    return tuple(_axis([one.axes[i] for one in resting], [one.axes[i] for one in moving]) for i in range(n))


def _axis(resting: Sequence[float], moving: Sequence[float]) -> Axis:
    rest = statistics.median(resting)
    strays = max(abs(value - rest) for value in resting)
    return Axis(rest, strays, min((*resting, *moving)), max((*resting, *moving)))


def profile(device: Controller, axes: Sequence[Axis]) -> dict[str, Any]:
    """What a profile of the device has to say.

    Args:
        device: as it was heard.
        axes: as measured.
    """
    ways = Profiles().of(device).ways
    leads = {name: way for name in ways.__struct_fields__ if (way := getattr(ways, name)).axis is not None}
    if device.kind == "gamepad" and not device.standard:
        sticks = [i for i, axis in enumerate(axes) if axis.moved and not axis.is_trigger]
        leads = {name: Way(axis=i, sign=-1) for name, i in zip(_LEADS, sticks, strict=False)}
    used = {name: way for name, way in leads.items() if way.axis is not None and way.axis < len(axes)}
    share = max((axes[way.axis].share for way in used.values() if way.axis is not None), default=0.0)
    return {
        "kind": device.kind,
        "device": device.name,
        "dead_zone": round(min(MOST_DEAD_ZONE, max(LEAST_DEAD_ZONE, MARGIN * share)), 3),
        "ways": {name: _said(way, axes[way.axis]) for name, way in used.items() if way.axis is not None},
    }


def _said(way: Way, axis: Axis) -> dict[str, Any]:
    said: dict[str, Any] = {"axis": way.axis, "sign": way.sign, "rest": round(axis.rest, 3)}
    if axis.moved:
        said |= {"low": round(axis.low, 3), "high": round(axis.high, 3)}
    return said


def remarks(axes: Sequence[Axis]) -> list[str]:
    """What a person should know of the axes, a line each."""
    told = []
    for i, axis in enumerate(axes):
        if not axis.moved:
            told.append(f"axis {i} was not moved")
        elif axis.is_trigger:
            told.append(f"axis {i} rests at {axis.rest:+.2f}: a trigger")
        elif axis.share > MOST_DEAD_ZONE / MARGIN:
            told.append(f"axis {i} strays by {100 * axis.share:.0f} % at rest: worn out, let nothing be led by it")
    return told
