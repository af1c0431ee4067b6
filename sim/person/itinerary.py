"""Where a person leads a robot that nothing else leads: from place to place, or along a way in one go."""

import math

import numpy as np
from numpy.typing import NDArray

from sim.interpolation import numbers_at, shares_of, through
from sim.pose import Pose
from sim.tasks.scene import Corridor

Array = NDArray[np.float64]

NEAR = 0.02  # [m] from a place a person says that they are there
NEAR_TURN = 0.15  # [rad] the same of how it is turned
STILL = 0.3  # [s] that it has to stand there
GRASPS = 1.5  # [s] that the robot stands while the gripper moves
PACE = 0.06  # [m/s] at which a way is led along
APART = 0.05  # [m] from one place that somebody stops at to the next
AHEAD = 0.05  # [m] beyond which nobody looks further along it


class Itinerary:
    """The aim of somebody who leads.

    Args:
        way: From where the robot stands to the object.
        stops: They stop at each of its places; else they go through.
    """

    def __init__(self, way: Corridor, *, stops: bool) -> None:
        self._way = _apart(way) if stops else way
        self._stops = stops
        self._length = float(np.sum(np.linalg.norm(np.diff(way.positions, axis=0), axis=1)))
        self._share = 0.0
        self._place = 1
        self._near_since = math.inf
        self._time: float | None = None
        self._grasps = _Grasps(self._way)

    @property
    def opening(self) -> float | None:
        """What is asked of the gripper now [m]; None where it takes no part."""
        return self._grasps.opening

    @property
    def aim(self) -> Pose:
        """Where to lead the robot now."""
        if self._stops:
            number = min(self._place, len(self._way.positions) - 1)
            return Pose(self._way.positions[number], self._way.orientations[number])
        numbers = numbers_at(self._way.positions, np.array([self._share]))
        turned = through(self._way.orientations, numbers)[0]
        return Pose(through(self._way.positions, numbers)[0], turned / np.linalg.norm(turned))

    @property
    def over(self) -> bool:
        """All of it was led."""
        return self._place >= len(self._way.positions)

    def arrived(self, time: float, left: Array) -> bool:
        """Whether the robot stands where it was led to; the next place is aimed at from then on.

        Args:
            time: Of any clock that does not go back [s].
            left: From where the robot should be now to the aim, shape (6,) [m, rad].
        """
        dt = time - self._time if self._time is not None else 0.0
        self._time = time
        away = float(np.linalg.norm(left[:3]))
        if not self._stops and self._share < 1.0:
            self._go_on(away, dt, time)
            return False
        if away > NEAR or np.linalg.norm(left[3:]) > NEAR_TURN:
            self._near_since = math.inf
            return False
        self._near_since = min(self._near_since, time)
        if time - self._near_since < STILL or self._grasps.keeps(self._place if self._stops else -1, time):
            return False
        self._near_since = math.inf
        self._place = self._place + 1 if self._stops else len(self._way.positions)
        return True

    def _go_on(self, away: float, dt: float, time: float) -> None:
        """Further along the way, unless the robot is left behind, or stands to grasp."""
        if self._share >= self._grasps.next_share:
            if away < NEAR and not self._grasps.keeps(self._grasps.next_place, time):
                self._grasps.done()
        elif away < AHEAD:
            self._share = min(1.0, self._grasps.next_share, self._share + dt * PACE / self._length)


class _Grasps:
    """Where on a way the gripper moves, one place after another.

    Args:
        way: That is led along.
    """

    def __init__(self, way: Corridor) -> None:
        openings = way.openings
        self.opening: float | None = None if openings is None else float(openings[0])
        self._openings = openings
        places = [] if openings is None else (np.flatnonzero(np.diff(openings)) + 1).tolist()
        shares = shares_of(way.positions)
        self._next = [(place, float(shares[place])) for place in places if place < len(shares) - 1]
        self._until = -math.inf

    @property
    def next_place(self) -> int:
        """Number of the way-point at which it moves next."""
        return self._next[0][0]

    @property
    def next_share(self) -> float:
        """Share of the way at which it does; beyond its end where it does not any more."""
        return self._next[0][1] if self._next else math.inf

    def keeps(self, place: int, time: float) -> bool:
        """Whether the robot has to stand at a way-point yet, since the gripper moves there.

        Args:
            place: Number of the way-point.
            time: Of any clock that does not go back [s].
        """
        if self._openings is None:
            return False
        wanted = float(self._openings[place])
        if self.opening != wanted:
            self.opening, self._until = wanted, time + GRASPS
        return time < self._until

    def done(self) -> None:
        """It has moved there."""
        self._next.pop(0)


def _apart(way: Corridor) -> Corridor:
    """Of places that lie close together the first one, and the last of all."""
    kept = [0]
    grasps = [] if way.openings is None else (np.flatnonzero(np.diff(way.openings)) + 1).tolist()
    for number in range(1, len(way.positions) - 1):
        nearest = min(float(np.linalg.norm(way.positions[number] - way.positions[other])) for other in (kept[-1], -1))
        if nearest >= APART or number in grasps:
            kept.append(number)
    kept.append(len(way.positions) - 1)
    openings = None if way.openings is None else way.openings[kept]
    return Corridor(way.positions[kept], way.orientations[kept], openings)
