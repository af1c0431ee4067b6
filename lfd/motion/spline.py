"""Splines: smooth lines through points.

SciPy's do the same or nearly, but loading them takes a second of every process' start.
"""

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array


def cubic_spline(x: Array, y: Array, wanted: Array) -> Array:
    """The not-a-knot cubic spline through points; a parabola through three, a straight line through two.

    Its curvature is continuous, and it is exact for cubics.

    The second derivatives solve the equations that make the first derivatives continuous, closed by the third
    derivatives' continuity at the second and the last but one point (de Boor, A Practical Guide to Splines, ch. IV).

    Args:
        x: Strictly increasing, shape (n,), n at least 2.
        y: Values, shape (n, d).
        wanted: Where to evaluate, within x, shape (k,).

    Returns:
        Shape (k, d).
    """
    h = np.diff(x)
    m = _curvatures(h, np.diff(y, axis=0) / h[:, None])
    i = _pieces(x, wanted)
    width = h[i][:, None]
    right = (wanted - x[i])[:, None] / width
    left = 1.0 - right
    bend = (left**3 - left) * m[i] + (right**3 - right) * m[i + 1]
    return np.asarray(left * y[i] + right * y[i + 1] + width**2 / 6.0 * bend, dtype=np.float64)


def quadratic_spline(x: Array, y: Array, wanted: Array) -> Array:
    """The quadratic spline through points whose first piece is straight: equations (E.1) to (E.6) with a_1 = 0.

    Each piece is a parabola through its two points. That the first derivatives are continuous, (E.3) to (E.6), gives
    the slope at each point from the one before, so no equations have to be solved. SciPy's
    `interp1d(kind="quadratic")`, which the thesis' implementation used, is closed by another condition and is another
    curve, except where the points lie on a straight line. Nothing damps what a bend sets off: a kink between two
    pieces swings on, as large, to the last.

    Args:
        x: Strictly increasing, shape (n,), n at least 2.
        y: Values, shape (n, d).
        wanted: Where to evaluate, within x, shape (k,).

    Returns:
        Shape (k, d).
    """
    h = np.diff(x)
    means = np.diff(y, axis=0) / h[:, None]
    slopes = np.empty_like(y)
    slopes[0] = means[0]
    for left, mean in enumerate(means):
        slopes[left + 1] = 2.0 * mean - slopes[left]
    i = _pieces(x, wanted)
    t = (wanted - x[i])[:, None]
    a = (slopes[i + 1] - slopes[i]) / (2.0 * h[i][:, None])
    return np.asarray(y[i] + slopes[i] * t + a * t**2, dtype=np.float64)


def _pieces(x: Array, wanted: Array) -> NDArray[np.intp]:
    """Index of the piece between points x (n,) in which each of the wanted (k,) lies."""
    return np.clip(np.searchsorted(x, wanted, side="right") - 1, 0, len(x) - 2)


def _curvatures(h: Array, slopes: Array) -> Array:
    """Second derivatives at the n points, from the n - 1 widths and mean slopes between them."""
    n = len(h) + 1
    bends = np.diff(slopes, axis=0)
    if n == 2:
        return np.zeros((2, slopes.shape[1]))
    if n == 3:
        return np.repeat(2.0 * bends / (h[0] + h[1]), 3, axis=0)
    equations = np.zeros((n, n))
    inner = np.arange(1, n - 1)
    equations[inner, inner - 1] = h[:-1]
    equations[inner, inner] = 2.0 * (h[:-1] + h[1:])
    equations[inner, inner + 1] = h[1:]
    equations[0, :3] = h[1], -(h[0] + h[1]), h[0]
    equations[-1, -3:] = h[-1], -(h[-2] + h[-1]), h[-2]
    right_side = np.zeros((n, slopes.shape[1]))
    right_side[1:-1] = 6.0 * bends
    return np.asarray(np.linalg.solve(equations, right_side), dtype=np.float64)
