"""How the operator teaches: by which method, through which waypoints, from which motion on. Pure values."""

from __future__ import annotations

from dataclasses import dataclass, replace

from protocol.messages import MOST_WAYPOINTS, Method, Motion, Origin, Waypoint
from services.station.press import Press

LEAST_WAYPOINTS = 3
"""Of a motion."""

METHODS = (Method.REFINE, Method.WAYPOINTS, Method.DEMONSTRATE)
"""That an operator chooses from."""

BASES = (Origin.MODEL, Origin.REFINEMENT)
"""What a refinement starts from: the prediction, or what the previous one at this place came to."""


@dataclass(frozen=True)
class Approach:
    """How the operator teaches at this place.

    Attributes:
        method: that was chosen.
        waypoints: that were stored, in order.
        basis: what the next refinement starts from.
        previous: what the previous refinement at this place came to; None before the first.
        shown: what was led by hand, to be learnt or done alone; None where nothing was.
    """

    method: Method = Method.REFINE
    waypoints: tuple[Waypoint, ...] = ()
    basis: Origin = Origin.MODEL
    previous: Motion | None = None
    shown: Motion | None = None

    @property
    def replays(self) -> Origin | None:
        """Where a motion comes from that the operator has shown, and that the robot can do alone; None before one."""
        if self.method is Method.WAYPOINTS and len(self.waypoints) >= LEAST_WAYPOINTS:
            return Origin.WAYPOINTS
        return Origin.DEMONSTRATION if self.method is Method.DEMONSTRATE and self.shown is not None else None

    def chosen(self, method: str) -> Approach:
        """With another method, by its name; as it was where there is no such one."""
        return replace(self, method=next((one for one in METHODS if one.value == method), self.method))

    def based(self, basis: str) -> Approach:
        """With another basis, by its name; as it was where there is none."""
        known = BASES if self.previous is not None else BASES[:1]
        return replace(self, basis=next((one for one in known if one.value == basis), self.basis))

    def elsewhere(self) -> Approach:
        """At another place, where nothing was shown yet."""
        return Approach(self.method)

    def stored(self, here: Waypoint, number: str) -> Approach:
        """With a waypoint more, or one of them moved, here.

        Args:
            here: pose of the grasping frame, and what its gripper does.
            number: of the waypoint that is moved, from 1; empty to add one.
        """
        if not number:
            full = len(self.waypoints) >= MOST_WAYPOINTS
            return self if full else replace(self, waypoints=(*self.waypoints, here))
        i = self._index(number)
        if i is None:
            return self
        return replace(self, waypoints=(*self.waypoints[:i], here, *self.waypoints[i + 1 :]))

    def deleted(self, number: str) -> Approach:
        """Without one of the waypoints."""
        i = self._index(number)
        return self if i is None else replace(self, waypoints=(*self.waypoints[:i], *self.waypoints[i + 1 :]))

    def moved(self, number: str, by: int) -> Approach:
        """With a waypoint that changed its place in the order, by -1 or 1."""
        i = self._index(number)
        if i is None or not 0 <= i + by < len(self.waypoints):
            return self
        order = list(self.waypoints)
        order[i], order[i + by] = order[i + by], order[i]
        return replace(self, waypoints=tuple(order))

    def cleared(self) -> Approach:
        """Without anything that was shown."""
        return replace(self, waypoints=(), shown=None)

    def _index(self, number: str) -> int | None:
        known = number.isascii() and number.isdecimal() and 1 <= int(number) <= len(self.waypoints)
        return int(number) - 1 if known else None


def edited(approach: Approach, presses: tuple[Press, ...], here: Waypoint | None) -> Approach:
    """With what was pressed about its waypoints, in order.

    Args:
        approach: as it was.
        presses: of the operator, those about something else included.
        here: pose with which a waypoint is stored; None where the robot is not heard, or may not be led now.
    """
    for press in presses:
        match press.action:
            case "store" if here is not None:
                approach = approach.stored(here, press.argument)
            case "delete":
                approach = approach.deleted(press.argument)
            case "earlier":
                approach = approach.moved(press.argument, -1)
            case "later":
                approach = approach.moved(press.argument, +1)
            case "clear":
                approach = approach.cleared()
    return approach
