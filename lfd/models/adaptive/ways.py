"""Several ways: corrections that lead left and right round a thing are two ways, not their average through it."""

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array


def contradictions(products: Array, distances: Array, slope: float, noise: float) -> NDArray[np.bool_]:
    """Which corrections contradict each other, shape (J, J).

    Two do if what lies halfway between them departs less than either, as left and right do, if they differ by more
    than a motion can be thought to change over the distance between their conditions, and by more than noise.

    Args:
        products: Inner products of the corrections of positions, shape (J, J) [m^2].
        distances: Between their conditions, in units of the scale, shape (J, J).
        slope: Change of a motion per unit of the condition [m].
        noise: Variance of a correction [m^2].
    """
    if products.min() >= 0.0:  # all to one side, as mostly
        return np.zeros(products.shape, dtype=np.bool_)
    squares = products.diagonal()
    both, twice = squares[:, None] + squares, 2.0 * products
    opposite = both + twice < np.minimum(squares[:, None], squares)
    steep = both - twice > (slope * distances) ** 2 + _NOISES**2 * noise
    return np.asarray(opposite & steep, dtype=np.bool_)


def sort_into_ways(against: NDArray[np.bool_], distances: Array, current: NDArray[np.bool_]) -> NDArray[np.intp]:
    """The way of each correction, oldest first, shape (J,).

    A correction joins the way of the nearest that neither it nor its way contradicts. One that no longer holds has no
    say, and belongs to the way of the nearest that does: its orientation or duration may still hold.

    Args:
        against: See `contradictions`, shape (J, J).
        distances: Between their conditions, shape (J, J).
        current: Which of them hold, at least one, shape (J,).
    """
    ways = np.zeros(len(against), dtype=np.intp)
    if not against.any():
        return ways
    kept = np.flatnonzero(current)
    for count, j in enumerate(kept[1:].tolist(), start=1):
        before = kept[:count]
        taken = ways[before]
        open_to_it = [way for way in sorted(set(taken.tolist())) if not against[j, before][taken == way].any()]
        nearest = {way: float(distances[j, before][taken == way].min()) for way in open_to_it}
        ways[j] = min(nearest, key=nearest.__getitem__) if nearest else taken.max() + 1
    for j in np.flatnonzero(~current).tolist():
        ways[j] = ways[kept[distances[j, kept].argmin()]]
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
