"""Many samples as few: what keeps a model's memory and time bounded."""

import numpy as np

from lfd.arrays import Array
from lfd.distances import squared_distances
from lfd.models.adaptive.scale import ConditionScale


def condensed(conditions: Array, vectors: Array, most: int, scale: ConditionScale) -> tuple[Array, Array]:
    """At most `most` samples: those beyond it are averaged into the nearest of the first.

    Up to `most` samples nothing changes.

    Args:
        conditions: Shape (M, c).
        vectors: Shape (M, D).
        most: How many may stay, at least 1.
        scale: Of the conditions, by which nearness is judged.

    Returns:
        Conditions (m, c) and vectors (m, D), m = min(M, most).
    """
    if len(conditions) <= most:
        return conditions, vectors
    z = scale.standard(conditions)
    blocks = np.split(z[most:], range(_BLOCK, len(z) - most, _BLOCK))
    nearest = [squared_distances(block, z[:most]).argmin(axis=1) for block in blocks]
    owners = np.concatenate([np.arange(most), *nearest])
    counts = np.bincount(owners, minlength=most)[:, None]
    mean_conditions, mean_vectors = (
        np.column_stack([np.bincount(owners, weights=column, minlength=most) for column in values.T]) / counts
        for values in (conditions, vectors)
    )
    return mean_conditions, mean_vectors


_BLOCK = 500  # samples whose distances are taken at once, for the sake of memory
