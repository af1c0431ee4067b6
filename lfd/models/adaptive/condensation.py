"""Many samples as few: what keeps a model's memory and time bounded."""

import numpy as np

from lfd.arrays import Array
from lfd.distances import squared_distances


def condensed(conditions: Array, vectors: Array, most: int) -> tuple[Array, Array]:
    """At most `most` samples: those beyond it are averaged into the nearest of the first.

    Up to `most` samples nothing changes.

    Args:
        conditions: Shape (M, c).
        vectors: Shape (M, D).
        most: How many may stay, at least 1.

    Returns:
        Conditions (m, c) and vectors (m, D), m = min(M, most).
    """
    if len(conditions) <= most:
        return conditions, vectors
    nearest = squared_distances(conditions[most:], conditions[:most]).argmin(axis=1)
    owners = np.concatenate([np.arange(most), nearest])
    counts = np.bincount(owners, minlength=most)[:, None]
    mean_conditions, mean_vectors = (
        np.column_stack([np.bincount(owners, weights=column, minlength=most) for column in values.T]) / counts
        for values in (conditions, vectors)
    )
    return mean_conditions, mean_vectors
