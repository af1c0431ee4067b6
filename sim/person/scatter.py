"""How far a person's motions lie apart that are meant alike: no two ways of one person are the same.

Where one person did the same twice, recorded ways lie 18 to 52 mm apart, least where they begin and end; careful
demonstrations of one motion 19 mm.
"""

from collections.abc import Sequence

import numpy as np
from numpy.typing import NDArray

from sim.interpolation import minimum_jerk

Array = NDArray[np.float64]

CAREFUL = 0.018  # [m] of a demonstration
USUAL = 0.030  # [m] of a correction that is given while the robot moves

_WAVES = 3  # slow waves that a deviation is made of, on each axis
_AIMED = 0.2  # share of the way before and after a target, over which a person aims at it


def deviation(shares: Array, scatter: float, rng: np.random.Generator, targets: Sequence[float] = ()) -> Array:
    """Draw by how much one motion deviates from what was meant.

    Sines of whole half periods with normal amplitudes a / k for k = 1, 2, 3, of the same expected size on each axis:
    smooth, and nothing at both ends. Two such motions are independent, so that each deviates by scatter / sqrt(2).

    Args:
        shares: Of the way at which it is wanted, from 0 to 1, shape (n,).
        scatter: Expected root mean square of the distance between two motions, over the way [m].
        rng: Of the draw.
        targets: Shares of the way at which the person aims at something, and deviates by nothing.

    Returns:
        Shape (n, 3) [m].
    """
    k = np.arange(1, _WAVES + 1)
    a = scatter / np.sqrt(3.0 * np.sum(1.0 / k**2))  # 3 axes, and the mean square of a sine is one half
    amplitudes = rng.normal(0.0, a / k, (3, _WAVES))
    aimed = np.ones_like(shares)
    for target in targets:
        aimed *= minimum_jerk(np.clip(np.abs(shares - target) / _AIMED, 0.0, 1.0))
    return np.asarray(aimed[:, None] * np.sin(np.pi * np.outer(shares, k)) @ amplitudes.T, dtype=np.float64)
