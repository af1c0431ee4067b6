"""What a person sees of a place: its direction well, how far away it is less well.

Positions pointed at scatter along the line of sight more than across it (McIntyre, Stratta and Lacquaniti 1997). Here
the misjudgement is that of the robot against the scene behind it, and its size is an assumption.
"""

import math

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

USUAL = 0.010  # [m] standard deviation of the misjudged depth
_NOISE = 0.25  # of it, by which a glance differs from what is misjudged all the time
_NOISE_TIME = 0.5  # [s] of the noise's correlation


class Sight:
    """One person's view for one episode, from one place: misjudges depth by an amount that stays, and by noise.

    Args:
        eye: Where they look from, shape (3,) [m].
        misjudgement: Standard deviation of the depth's error over episodes [m].
        rng: Of the errors.
    """

    def __init__(self, eye: Array, misjudgement: float, rng: np.random.Generator) -> None:
        self._eye = eye
        self._rng = rng
        self._lasting = misjudgement * rng.standard_normal()
        self._deviation = _NOISE * misjudgement
        self._noise = self._deviation * rng.standard_normal()

    def look(self, place: Array, dt: float) -> Array:
        """Where a place seems to be, shape (3,) [m].

        Args:
            place: Where it is, shape (3,) [m].
            dt: Since the last look [s].
        """
        kept = math.exp(-dt / _NOISE_TIME)
        self._noise = kept * self._noise + math.sqrt(1.0 - kept * kept) * self._deviation * self._rng.standard_normal()
        line = place - self._eye
        return np.asarray(place + (self._lasting + self._noise) / np.linalg.norm(line) * line, dtype=np.float64)
