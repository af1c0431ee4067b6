"""Lines through way-points that do not swing out between them, and how far along them one is."""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_FINENESS = 50  # points between two way-points by which lengths are measured


def through(points: Array, numbers: Array) -> Array:
    """A C1 line through points, at fractional point numbers; monotone wherever the points are.

    Piecewise cubic Hermite interpolation with the slopes of Fritsch and Butland (1984), as SciPy's PCHIP on even
    knots; loading that takes a second of every process' start.

    Args:
        points: Shape (n, d), n at least 2.
        numbers: From 0 to n - 1, shape (k,).

    Returns:
        Shape (k, d).
    """
    steps = np.diff(points, axis=0)
    slopes = _slopes(steps)
    i = np.clip(numbers.astype(int), 0, len(points) - 2)
    t = (numbers - i)[:, None]
    hermite = points[i] + t * (
        slopes[i]
        + t * (3.0 * steps[i] - 2.0 * slopes[i] - slopes[i + 1] + t * (slopes[i] + slopes[i + 1] - 2.0 * steps[i]))
    )
    return np.asarray(hermite, dtype=np.float64)


def covered_shares(points: Array) -> Array:
    """The share of its length that a line has covered at each of its points, shape (n,), from 0 to 1.

    Args:
        points: Shape (n, d); where all are one point the shares are even.
    """
    lengths = np.concatenate([[0.0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
    if lengths[-1] == 0.0:
        return np.linspace(0.0, 1.0, len(points))
    return np.asarray(lengths / lengths[-1], dtype=np.float64)


def numbers_at(points: Array, shares: Array) -> Array:
    """Which fractional point number of the line `through` points is reached at shares of its length.

    Args:
        points: Shape (n, d), n at least 2.
        shares: From 0 to 1, shape (k,).

    Returns:
        From 0 to n - 1, shape (k,).
    """
    fine = np.linspace(0.0, len(points) - 1.0, _FINENESS * (len(points) - 1) + 1)
    return np.interp(shares, covered_shares(through(points, fine)), fine)


def shares_of(points: Array) -> Array:
    """Return at which shares of the length of the line `through` points they lie, shape (n,): see `numbers_at`.

    Args:
        points: Shape (n, d), n at least 2.
    """
    fine = np.linspace(0.0, len(points) - 1.0, _FINENESS * (len(points) - 1) + 1)
    return covered_shares(through(points, fine))[::_FINENESS]


def minimum_jerk(time: Array) -> Array:
    """The share of the way covered by a minimum-jerk movement at each share of its time, both from 0 to 1."""
    return time**3 * (10.0 + time * (-15.0 + 6.0 * time))


def _slopes(steps: Array) -> Array:
    """The harmonic mean of two steps of one sign, else zero; at the ends one-sided, kept monotone."""
    if len(steps) == 1:
        return np.repeat(steps, 2, axis=0)
    before, after = steps[:-1], steps[1:]
    product, total = before * after, before + after
    inner = np.where(product > 0.0, 2.0 * product / np.where(total == 0.0, 1.0, total), 0.0)
    return np.vstack([_end(steps[0], steps[1]), inner, _end(steps[-1], steps[-2])])


def _end(outer: Array, inner: Array) -> Array:
    slope = 1.5 * outer - 0.5 * inner
    slope = np.where(np.sign(slope) != np.sign(outer), 0.0, slope)
    turns = (np.sign(outer) != np.sign(inner)) & (np.abs(slope) > 3.0 * np.abs(outer))
    return np.where(turns, 3.0 * outer, slope)
