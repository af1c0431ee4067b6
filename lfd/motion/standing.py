"""A motion through waypoints that stands where its gripper opens or closes: when it is where."""

from dataclasses import dataclass
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array, frozen
from lfd.motion.opening import SAME_OPENING

STANDS_S = 1.0
"""So long a motion stands at a waypoint at which the gripper opens or closes: its fingers take their time [s]."""

MOST_STANDING = 0.5
"""Share of a motion's time that it stands in all."""


@dataclass(frozen=True, eq=False)
class Standing:
    """When a motion is where on its way, and when its gripper opens or closes.

    It slows down before it stands and goes on from rest: between, as a cubic of the time.

    Attributes:
        times: Shares of the motion's time, ascending from 0 to 1, shape (m,).
        ways: The phases of its way at these times, shape (m,); the same for as long as it stands.
        steps: Shares of the time at which the opening changes, shape (s,).
        openings: What it is before the first of them, and from each on, shape (s + 1,) [m].
    """

    times: Array
    ways: Array
    steps: Array
    openings: Array

    @classmethod
    def at(cls, phases: Array, opening: Array, duration: float) -> Self:
        """That of waypoints.

        Args:
            phases: At which a motion that does not stand passes them, shape (k,), from 0 to 1.
            opening: Of the gripper from each of them on, shape (k,) [m].
            duration: Of the motion, all that it stands included [s].
        """
        stops: NDArray[np.intp] = np.flatnonzero(np.abs(np.diff(opening)) > SAME_OPENING) + 1
        stand = min(STANDS_S / duration, MOST_STANDING / max(len(stops), 1))
        moving = 1.0 - stand * len(stops)
        times, ways = [np.zeros(1)], [np.zeros(1)]
        steps: list[float] = []
        now = done = 0.0
        for place in [*phases[stops].tolist(), *([] if len(opening) - 1 in stops else [1.0])]:
            stands = len(steps) < len(stops)
            u = _SHARES[1:]
            times.append(now + moving * (place - done) * u)
            ways.append(done + (place - done) * _eased(u, start=bool(steps), end=stands))
            now, done = float(times[-1][-1]), place
            if stands:
                steps.append(now)
                now += stand
                times.append(np.array([now]))
                ways.append(np.array([place]))
        all_times = np.concatenate(times)
        openings = frozen(opening[[0, *stops.tolist()]])
        return cls(frozen(all_times / all_times[-1]), frozen(np.concatenate(ways)), frozen(steps), openings)

    def way_at(self, times: Array) -> Array:
        """The phases of the way at shares of the time (n,), shape (n,)."""
        return np.asarray(np.interp(times, self.times, self.ways), dtype=np.float64)

    def reached(self, ways: Array) -> Array:
        """The shares of the time at which phases of the way (k,) are reached, shape (k,)."""
        first = np.searchsorted(self.ways, ways - _ROUNDING).clip(1, len(self.ways) - 1)
        before, after = self.ways[first - 1], self.ways[first]
        share = np.clip((ways - before) / np.maximum(after - before, _ROUNDING), 0.0, 1.0)
        return np.asarray(self.times[first - 1] + share * (self.times[first] - self.times[first - 1]))

    def opening_at(self, times: Array) -> Array:
        """The opening at shares of the time (n,), shape (n,) [m]: it changes at once, when the waypoint is reached."""
        return np.asarray(self.openings[np.searchsorted(self.steps, times, side="right")], dtype=np.float64)


def _eased(u: Array, *, start: bool, end: bool) -> Array:
    """Shares of a way at shares u (n,) of its time, from rest or to rest or neither."""
    if start and end:
        return np.asarray(u**2 * (3.0 - 2.0 * u))
    if end:
        return np.asarray(0.5 * u * (3.0 - u**2))
    return 1.0 - _eased(1.0 - u, start=False, end=True) if start else u


_SHARES = np.linspace(0.0, 1.0, 33)
_ROUNDING = 1e-12
