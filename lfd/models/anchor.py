"""How a motion leaves the start that it is given: straight blended out, or soon.

Where the starts that were shown differ, as seen from the object, the demonstrations tell how a motion changes with
them, on top of a straight blend over all of it. Along a direction in which they never differ nothing says that anything
but the motion shown is safe: it is rejoined soon, as a dynamic movement primitive of the usual gains does, like a
critically damped spring (Ijspeert et al., 2013, alpha_z = 25 = 4 beta_z). Of a single condition there is no telling
which directions these are, and all is blended straight.
"""

from dataclasses import dataclass
from functools import lru_cache
from typing import Self

import numpy as np

from lfd.arrays import Array, frozen

RETURN_RATE = 12.5  # per duration: alpha_z / 2, so that 5 % of a displacement are left after 0.38 of the motion
SAME = 0.02  # standard deviation on each axis, in extents or radians, within which starts count as one


@dataclass(frozen=True, eq=False)
class Anchor:
    """The starts that were shown: positions relative to the origin [m] and rotation vectors [rad], base axes.

    Attributes:
        home: Their mean, shape (6,).
        strays: What of a displacement from it lies in directions in which they do not differ, a linear map (6, 6).
    """

    home: Array
    strays: Array

    @classmethod
    def straight(cls) -> Self:
        """That blends every start out straight."""
        return cls(frozen(np.zeros(6)), frozen(np.zeros((6, 6))))

    @classmethod
    def of(cls, starts: Array, extent: float) -> Self:
        """The anchor of motions.

        Args:
            starts: Where each begins, shape (M, 6), M at least 1.
            extent: How far they lead from there [m], positive.
        """
        home = starts.mean(axis=0)
        unit = SAME * np.array([extent] * 3 + [1.0] * 3)
        away = (starts - home) / unit
        shown = away.T @ away / len(starts)
        total = float(np.trace(shown)) ** 2  # squares: between "they differ" and "they do not" there is little
        share = total / (1.0 + total) * np.linalg.inv(shown @ shown + np.eye(6))
        return cls(frozen(home), frozen(unit[:, None] * share / unit))

    def at(self, start: Array, phases: Array) -> Array:
        """What the start (6,) alone contributes to a motion at phases (T,) from 0 to 1, shape (T, 6)."""
        stray = self.strays @ (start - self.home)
        return np.asarray(_blends(phases.tobytes()) @ np.array([start - stray, stray]), dtype=np.float64)

    def rates(self, start: Array, phases: Array) -> Array:
        """Derivatives of `at` by the phase, shape (T, 6)."""
        stray = self.strays @ (start - self.home)
        return np.outer(_fading_rate(phases), stray) - (start - stray)


def fading(phases: Array) -> Array:
    """How much of a stray start is left at phases (T,), from 1 to exactly 0, shape (T,)."""
    kt = RETURN_RATE * phases
    return np.asarray((1.0 + kt) * np.exp(-kt) - _LEFT * phases, dtype=np.float64)


@lru_cache(maxsize=16)
def _blends(phases: bytes) -> Array:
    """What is left at phases (T,) of what is blended out straight, and of a stray start, shape (T, 2)."""
    t = np.frombuffer(phases)
    return frozen(np.column_stack([1.0 - t, fading(t)]))


def _fading_rate(phases: Array) -> Array:
    kt = RETURN_RATE * phases
    return np.asarray(-RETURN_RATE * kt * np.exp(-kt) - _LEFT, dtype=np.float64)


_LEFT = float((1.0 + RETURN_RATE) * np.exp(-RETURN_RATE))  # of a spring's displacement at the end
