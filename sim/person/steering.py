"""The way that a person steers an arm through a corridor, when they teach offline with the stylus (thesis, OffStyl)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.interpolation import minimum_jerk, numbers_at, through
from sim.person.scatter import CAREFUL, deviation
from sim.tasks.scene import Corridor, Freedom

Array = NDArray[np.float64]


class Steered(NamedTuple):
    """A steered motion at equal steps of time.

    Attributes:
        positions: Of the grasping frame in the base frame, shape (n, 3) [m].
        orientations: Scalar first, shape (n, 4).
    """

    positions: Array
    orientations: Array


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
