"""Several ways: corrections that lead left and right round a thing are two ways, not their average through it."""

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array


def sort_into_ways(products: Array, distances: Array, slope: float, noise: float) -> NDArray[np.intp]:
    """The way of each correction, oldest first, shape (J,).

    Two corrections contradict each other if what lies halfway between them departs less than either, as left and right
    do, if they differ by more than a motion can be thought to change over the distance between their conditions, and
    by more than noise. A correction joins the way of the nearest that neither it nor its way contradicts.

    Args:
        products: Inner products of the corrections of positions, shape (J, J) [m^2].
        distances: Between their conditions, in units of the scale, shape (J, J).
        slope: Change of a motion per unit of the condition [m].
        noise: Variance of a correction [m^2].
    """
    squares = np.diag(products)
    sums = squares[:, None] + squares + 2.0 * products
    differences = squares[:, None] + squares - 2.0 * products
    opposite = sums < np.minimum(squares[:, None], squares)
    steep = differences > (slope * distances) ** 2 + _NOISES**2 * noise
    against = opposite & steep
    ways = np.zeros(len(products), dtype=np.intp)
    if not against.any():
        return ways
    for j in range(1, len(products)):
        taken = ways[:j]
        open_to_it = [way for way in np.unique(taken).tolist() if not against[j, :j][taken == way].any()]
        nearest = {way: float(distances[j, :j][taken == way].min()) for way in open_to_it}
        ways[j] = min(nearest, key=nearest.__getitem__) if nearest else taken.max() + 1
    return ways


def probabilities(distances: Array, ways: NDArray[np.intp], gate: float) -> Array:
    """Of each way at a place, shape (W,): by the nearest correction of each, as a softmax of the distances.

    Args:
        distances: Of the corrections from the place, shape (J,).
        ways: Of the corrections, shape (J,).
        gate: Distance by which one way may be further away to be e times less probable.
    """
    nearest = np.array([distances[ways == way].min() for way in range(int(ways.max()) + 1)])
    weights = np.exp((nearest.min() - nearest) / gate)
    return np.asarray(weights / weights.sum(), dtype=np.float64)


_NOISES = 4.0  # standard deviations beyond which a difference of two corrections is none of noise
