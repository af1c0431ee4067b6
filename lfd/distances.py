"""Distances among points; SciPy's take longer to be loaded than a model of one day takes to be learnt."""

import numpy as np

from lfd.arrays import Array


def squared_distances(a: Array, b: Array) -> Array:
    """|a_i - b_j|^2 of points (m, c) and (n, c), shape (m, n)."""
    differences = a[:, None] - b
    return np.asarray(np.vecdot(differences, differences), dtype=np.float64)
