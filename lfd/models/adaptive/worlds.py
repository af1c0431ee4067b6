"""Which corrections of one condition still hold: noise is averaged, a change of the world is followed.

A Bayesian change-point model (Barry and Hartigan 1993; Adams and MacKay 2007): the corrections of a condition, in
order, fall into stretches. Within one the world is the same, and corrections scatter about their mean with a variance
sigma^2 that is unknown and shared by all conditions; between two, the mean jumps. The most probable stretches and
sigma^2 are taken, and the last stretch is what holds.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array
from lfd.bounds import POSITIVE, check_options


@dataclass(frozen=True)
class WorldOptions:
    """What is assumed before; sizes are fractions of a kind's own unit.

    Attributes:
        noise: Standard deviation of corrections of one world.
        evidence: How many corrections this assumption is worth.
        jump: Standard deviation of the mean of a world.
        stays: How many times likelier it is, per independent direction of a correction and per place at which it could
            have changed, that the world stays as it is.

    Raises:
        OutOfRange: One is not what it can be.
    """

    noise: float = 0.01
    evidence: float = 1.5
    jump: float = 0.3
    stays: float = 2.5

    def __post_init__(self) -> None:
        check_options(self, noise=POSITIVE, evidence=POSITIVE, jump=POSITIVE, stays=POSITIVE)


@dataclass(frozen=True, eq=False)
class Worlds:
    """What was found.

    Attributes:
        current: Which corrections hold in each kind, shape (K, J).
        shared: How many hold at the condition of each, shape (K, J).
        noise: sigma^2 in each kind, in its unit, squared, shape (K,).
    """

    current: NDArray[np.bool_]
    shared: Array
    noise: Array


def find_worlds(products: Array, groups: Sequence[Sequence[int]], units: Array, options: WorldOptions) -> Worlds:
    """Tell noise from change, in each kind by itself.

    Args:
        products: Inner products of the corrections in each kind, shape (K, J, J).
        groups: Indices of the corrections of each condition, oldest first.
        units: Of the corrections in each kind, shape (K,).
        options: What is assumed.
    """
    shape = products.shape[:2]
    current, shared, noise = np.ones(shape, dtype=np.bool_), np.ones(shape), (options.noise * units) ** 2
    several = [group for group in groups if len(group) > 1]
    for kind, unit in enumerate(units.tolist() if several else []):
        candidates = noise[kind] * _VARIANCES
        fits = [_stretches(_scatters(products[kind][np.ix_(g, g)]), candidates, unit, options) for g in several]
        prior = options.evidence * (noise[kind] / candidates + np.log(candidates))
        best = int(np.argmin(prior + np.sum([costs for costs, _ in fits], axis=0)))
        noise[kind] = candidates[best]
        for group, (_, lasts) in zip(several, fits, strict=True):
            length = int(lasts[best])
            current[kind, group[:-length]] = False
            shared[kind, group] = length
    return Worlds(current, shared, noise)


def _scatters(products: Array) -> Array:
    """Sum of squares about their mean of the corrections i to j - 1, at [i, j], shape (n, n + 1)."""
    n = len(products)
    sums = np.zeros((n + 1, n + 1))
    sums[1:, 1:] = products.cumsum(axis=0).cumsum(axis=1)
    squares = np.append(0.0, np.diag(products).cumsum())
    diagonal = np.diag(sums)
    total = squares[None] - squares[:n, None]
    inner = diagonal[None] - sums[:n] - sums[:, :n].T + diagonal[:n, None]
    count = np.maximum(np.arange(n + 1)[None] - np.arange(n)[:, None], 1)
    return np.asarray(np.maximum(total - inner / count, 0.0), dtype=np.float64)


def _stretches(scatter: Array, noises: Array, unit: float, options: WorldOptions) -> tuple[Array, NDArray[np.intp]]:
    """For each variance (V,): twice the least negative log evidence per direction, and the last stretch's length."""
    n = len(scatter)
    change = 2.0 * float(np.log(options.stays * n))
    count = np.arange(n + 1)[None] - np.arange(n)[:, None]
    mean = np.log(np.maximum(count, 1)) + 2.0 * float(np.log(options.jump * unit)) + change
    costs = scatter / noises[:, None, None] + (count - 1) * np.log(noises)[:, None, None] + mean
    least = np.full((len(noises), n + 1), -change)  # the first stretch is no change
    begins = np.zeros(len(noises), dtype=np.intp)
    for end in range(1, n + 1):
        whole = least[:, :end] + costs[:, :end, end]
        begins = whole.argmin(axis=1)
        least[:, end] = whole.min(axis=1)
    return least[:, n], n - begins


_VARIANCES = 2.0 ** np.arange(0.0, 5.5, 0.5)  # of what is assumed: people may be up to six times less steady
