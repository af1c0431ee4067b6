"""Distances among points; SciPy's take longer to be loaded than a model of one day takes to be learnt."""

import numpy as np

from lfd.arrays import Array


def squared_distances(a: Array, b: Array) -> Array:
    """|a_i - b_j|^2 of points (m, c) and (n, c), shape (m, n)."""
    squares: Array = np.zeros((len(a), len(b)))
    for of_a, of_b in zip(a.T, b.T, strict=True):
        squares += np.subtract.outer(of_a, of_b) ** 2
    return squares
