"""The way that a person steers an arm through a corridor, when they teach offline with the stylus (thesis, OffStyl)."""

from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from sim.interpolation import minimum_jerk, numbers_at, through
from sim.tasks.scene import Corridor, Freedom

Array = NDArray[np.float64]

_UNSTEADINESS = 0.004  # [m] largest amplitude of one wave of the deviation from the way meant
_WAVES = 3  # slow waves that the deviation is made of, on each axis


class Steered(NamedTuple):
    """A steered motion at equal steps of time.

    Attributes:
        positions: Of the grasping frame in the base frame, shape (n, 3) [m].
        orientations: Scalar first, shape (n, 4).
    """

    positions: Array
    orientations: Array


def steer(corridor: Corridor, rng: np.random.Generator | None, n: int = 200, freedom: Freedom | None = None) -> Steered:
    """Steer from a corridor's first way-point to its last.

    The speed along the way is that of a minimum-jerk movement (Flash and Hogan 1985), where it is the person's; the
    deviation from the way is slow, and vanishes at both ends, where a person takes care. Way-points turn by a few
    degrees only, so that their quaternions are interpolated like positions.

    Args:
        corridor: To steer through.
        rng: Of the person's unsteadiness; None for a steady hand.
        n: Number of samples.
        freedom: Of the person; all of it by default.
    """
    freedom = freedom or Freedom()
    time = np.linspace(0.0, 1.0, n)
    way = corridor.positions
    numbers = numbers_at(way, minimum_jerk(time)) if freedom.tempo else (len(way) - 1) * time
    orientations = through(corridor.orientations, numbers)
    orientations /= np.linalg.norm(orientations, axis=1, keepdims=True)
    positions = through(way, numbers)
    return Steered(positions if rng is None else positions + freedom.axes * _deviation(n, rng), orientations)


def _deviation(n: int, rng: np.random.Generator) -> Array:
    """Sines of whole half periods, so that both ends are zero."""
    time = np.linspace(0.0, np.pi, n)[:, None]
    amplitudes = rng.uniform(-_UNSTEADINESS, _UNSTEADINESS, size=(_WAVES, 3))
    return sum((a / k * np.sin(k * time) for k, a in enumerate(amplitudes, 1)), start=np.zeros((n, 3)))
