"""The ways that somebody drew through a task, as data: way-points that follow the object's place."""

import math
from dataclasses import dataclass

import numpy as np

from sim.robots.gripper import pitched_down
from sim.tasks.scene import Array, Corridor, Quaternion, Vector

AXES = ("x", "y", "z")


@dataclass(frozen=True)
class Coordinate:
    """Of a way-point, along one axis: the first of these that is said.

    Attributes:
        fixed: Here, wherever the object is [m].
        way: A share of the way from the start to the point before the object.
        plus: Beside that [m].
        line: On the straight way there, seen from above, at the way-point's x; the number is the way-point's share of
            the detour beside it.
    """

    fixed: float | None = None
    way: float | None = None
    plus: float = 0.0
    line: float | None = None


@dataclass(frozen=True)
class Point:
    """A way-point.

    Attributes:
        pitch: Of the gripper below the horizontal [rad].
        coordinates: Along x, y and z; none where it is told from the object.
        offset: From the object's centre [m]; None where it is told by coordinates.
        orientation: Of the gripper, scalar first, in the pitch's place.
    """

    pitch: float
    coordinates: tuple[Coordinate, ...] = ()
    offset: Vector | None = None
    orientation: Quaternion | None = None

    @property
    def turned(self) -> Array:
        """How the gripper is turned there, shape (4,)."""
        return pitched_down(self.pitch) if self.orientation is None else np.array(self.orientation)


@dataclass(frozen=True)
class Detour:
    """Left or right round a thing that stands upright.

    Attributes:
        around: Middle of the thing, x and y [m].
        room: Between the middles of thing and hand: half of either, and what a person leaves free [m].
        rounding: Within which a way that is straight goes over into one that bends [m].
        furthest: That a person bends a way at most, rather than going round the other side [m].
    """

    around: tuple[float, float]
    room: float
    rounding: float
    furthest: float

    def bends(self, beside: float) -> tuple[float, ...]:
        """Return how far to the left a way has to bend to be safe, the shortest first [m].

        Args:
            beside: How far to the left of the thing's middle it passes when it is straight [m].
        """
        bends = sorted((self._bend(beside), -self._bend(-beside)), key=abs)
        return tuple(bend for n, bend in enumerate(bends) if n == 0 or abs(bend) <= self.furthest)

    def _bend(self, beside: float) -> float:
        missing = self.room - beside
        return 0.5 * (missing + math.hypot(missing, self.rounding))


@dataclass(frozen=True)
class Way:
    """A way from the start to the object; or two, round a thing.

    Attributes:
        points: After the start.
        before: The point before the object, from the object's centre [m].
        detour: Round what.
    """

    points: tuple[Point, ...]
    before: Vector = (0.0, 0.0, 0.0)
    detour: Detour | None = None

    def corridors(self, start: Array, orientation: Array, place: Array) -> tuple[Corridor, ...]:
        """Return it as it leads to an object, the shortest first.

        Args:
            start: Of the grasping frame, shape (3,) [m].
            orientation: Of it there, shape (4,).
            place: Of the object's centre, shape (3,) [m].
        """
        bends: tuple[float, ...] = (0.0,)
        if self.detour is not None:
            x, y = self.detour.around
            bends = self.detour.bends(self._slope(start, place) * (x - start[0]) + start[1] - y)
        turns = np.array([orientation, *(point.turned for point in self.points)])
        return tuple(
            Corridor(np.array([start, *(self._position(one, start, place, bend) for one in self.points)]), turns)
            for bend in bends
        )

    def _slope(self, start: Array, place: Array) -> float:
        """Of the straight way from the start to the point before the object: dy / dx."""
        x, y = place[:2] - start[:2]
        return float((y + self.before[1]) / (x + self.before[0]))

    def _position(self, point: Point, start: Array, place: Array, bend: float) -> Array:
        if point.offset is not None:
            return np.asarray(place + np.array(point.offset))
        ahead = place + np.array(self.before) - start
        position = np.empty(3)
        for axis, said in enumerate(point.coordinates):
            if said.fixed is not None:
                position[axis] = said.fixed
            elif said.way is not None:
                position[axis] = start[axis] + said.way * ahead[axis] + said.plus
            else:
                straight = start[1] + self._slope(start, place) * (position[0] - start[0])
                position[axis] = straight + (said.line or 0.0) * bend
        return position
