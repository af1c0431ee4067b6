"""The way that a person steers an arm through a corridor, when they teach offline with the stylus (thesis, OffStyl)."""

from collections.abc import Callable
from functools import partial
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.interpolation import minimum_jerk, numbers_at, through
from sim.person.scatter import CAREFUL, deviation
from sim.tasks.scene import Corridor, Freedom

Array = NDArray[np.float64]

_REACHING = 10.0  # [s] that a person takes to reach a thing: the thesis' time of an execution
_GRASPING = 1.5  # [s] that they stand while the gripper moves
_CARRYING, _SHORTEST = 0.08, 1.5  # [m/s] with what is in it; [s] that each part takes at least


class Steered(NamedTuple):
    """A steered motion at equal steps of time.

    Attributes:
        positions: Of the grasping frame in the base frame, shape (n, 3) [m].
        orientations: Scalar first, shape (n, 4).
        opening: Of the gripper, shape (n,) [m]; None where it takes no part.
        longer: Than the way to where the gripper moves first: all of it takes so many times as long.
    """

    positions: Array
    orientations: Array
    opening: Array | None = None
    longer: float = 1.0


def steer(
    corridor: Corridor,
    rng: np.random.Generator | None,
    n: int = 200,
    freedom: Freedom | None = None,
    scatter: float = CAREFUL,
) -> Steered:
    """Steer from a corridor's first way-point to its last.

    The speed along the way is that of a minimum-jerk movement (Flash and Hogan 1985), where it is the person's; the
    deviation from the way is slow, and vanishes where a person aims at something. Way-points turn by a few degrees
    only, so that their quaternions are interpolated like positions.

    Args:
        corridor: To steer through.
        rng: Of the person's deviation; None for a steady hand.
        n: Number of samples.
        freedom: Of the person; all of it by default.
        scatter: Of the person, see `deviation` [m].
    """
    if corridor.openings is not None:
        return _handling(corridor, corridor.openings, partial(steer, rng=rng, n=n, freedom=freedom, scatter=scatter), n)
    freedom = freedom or Freedom()
    time = np.linspace(0.0, 1.0, n)
    way = corridor.positions
    shares = minimum_jerk(time) if freedom.tempo else time
    numbers = numbers_at(way, shares) if freedom.tempo else (len(way) - 1) * shares
    orientations = through(corridor.orientations, numbers)
    orientations /= np.linalg.norm(orientations, axis=1, keepdims=True)
    positions = through(way, numbers)
    if rng is not None:
        positions = positions + freedom.axes * deviation(shares, scatter, rng, freedom.targets)
    return Steered(positions, orientations)


def _handling(corridor: Corridor, openings: Array, steered: Callable[[Corridor], Steered], n: int) -> Steered:
    """From each place where the gripper moves to the next one, standing there while it does."""
    moves = np.flatnonzero(np.diff(openings)) + 1
    ends = [*moves.tolist(), len(openings) - 1]
    legs, standing = [], []
    seconds: list[float] = []
    first = 0
    for last in ends:
        if last > first:
            part = Corridor(corridor.positions[first : last + 1], corridor.orientations[first : last + 1])
            legs.append(steered(part))
            length = float(np.sum(np.linalg.norm(np.diff(part.positions, axis=0), axis=1)))
            seconds.append(max(length / _CARRYING, _SHORTEST) if seconds else _REACHING)
            standing.append(openings[first])
            first = last
        if last in moves:
            still = legs[-1].positions[-1], legs[-1].orientations[-1]
            legs.append(Steered(np.tile(still[0], (n, 1)), np.tile(still[1], (n, 1))))
            seconds.append(_GRASPING)
            standing.append(openings[last])
    begins = np.concatenate([[0.0], np.cumsum(seconds)])
    times = np.linspace(0.0, begins[-1], n)
    numbers = np.clip(np.searchsorted(begins, times, side="right") - 1, 0, len(legs) - 1)
    at = [round((n - 1) * (time - begins[i]) / seconds[i]) for time, i in zip(times, numbers, strict=True)]
    return Steered(
        np.array([legs[i].positions[k] for i, k in zip(numbers, at, strict=True)]),
        np.array([legs[i].orientations[k] for i, k in zip(numbers, at, strict=True)]),
        np.array([standing[i] for i in numbers]),
        float(begins[-1] / _REACHING),
    )
