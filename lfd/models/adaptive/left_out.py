"""What a regression predicts for a condition that it has not seen, without fitting it anew."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array
from lfd.models.adaptive.moments import Moments
from lfd.models.adaptive.trend import (
    TrendOptions,
    directions,
    limited,
    reach_variance,
    slopes,
    slopes_by_coordinate,
)


@dataclass(frozen=True, eq=False)
class LeftOut:
    """Errors at each demonstration of regressions that have seen no demonstration of its condition.

    Attributes:
        errors: Of each trend, of one that is followed everywhere, and, where an object's place tells of coordinates, of
            each trend coordinate by coordinate, without a process: shape (K + 1, M, D) or (2 K + 1, M, D).
        leverage: How far each trend had to reach, relative to a motion's variance, shape (M,).
        unexplained: Share of the departures from the trend that the others leave open there, shape (M,).
        telling: Whether the rest still taught a trend in all directions, shape (M,).
    """

    errors: Array
    leverage: Array
    unexplained: Array
    telling: NDArray[np.bool_]


def leave_out(
    z: Array,
    Y: Array,
    groups: Sequence[NDArray[np.intp]],
    inverse: Array,
    *,
    noise: float,
    options: TrendOptions,
    depends: NDArray[np.bool_] | None = None,
) -> LeftOut:
    """Each group of demonstrations predicted from all others.

    What a Gaussian process of the departures from the rest's trend misses at a group, without the group, comes from
    the inverse with it (Rasmussen and Williams 2006, eq. 5.12, for more than one left out).

    Args:
        z: Conditions about their mean, shape (M, c).
        Y: Vectors about their mean, shape (M, D).
        groups: Indices of each condition's demonstrations, at least two groups.
        inverse: (K + noise I)^-1, shape (M, M).
        noise: Variance of a motion about its condition's, relative.
        options: Of the trends.
        depends: See `slopes_by_coordinate`, where coordinates are known.
    """
    M = len(z)
    owner = np.zeros(M, dtype=np.intp)
    for g, group in enumerate(groups):
        owner[group] = g
    rest = Moments.without_each(z, Y, owner)
    B, variance = slopes(rest, options), reach_variance(rest, options)
    ones, S, X = inverse.sum(axis=1), inverse @ z, inverse @ Y
    about = z - rest.s_mean[:, None]
    distances = np.einsum("gmc,gmc->gm", about, about)
    distances[owner, np.arange(M)] = 0.0
    radius = np.sqrt(distances.max(axis=1))
    away = z - rest.s_mean[owner]
    followed = limited(away, radius[owner], options)
    cut, K = away - followed, len(options.shrinkages)
    C = None if depends is None else slopes_by_coordinate(rest, depends, options)
    errors = np.zeros((K + 1 if C is None else 2 * K + 1, M, Y.shape[1]))
    unexplained = np.zeros(M)
    sizes = np.array([len(group) for group in groups])
    for size in sorted(set(sizes.tolist())):  # those of one size at once
        these = np.flatnonzero(sizes == size)
        members = np.array([groups[g] for g in these.tolist()])
        block = np.linalg.inv(inverse[members[:, :, None], members[:, None]])
        weights = ones[members][:, :, None]
        solved = block @ (X[members] - weights * rest.mean[these, None])
        regressed = block @ (S[members] - weights * rest.s_mean[these, None])
        trends = (cut[members] - regressed)[:, None] @ B[these]
        errors[:K, members] = solved + np.swapaxes(trends, 0, 1)
        errors[K, members] = solved - regressed @ B[these, 0]
        if C is not None:
            missed = (Y[members] - rest.mean[these, None])[:, None] - followed[members][:, None] @ C[these]
            errors[K + 1 :, members] = np.swapaxes(missed, 0, 1)
        unexplained[members] = (np.diagonal(block, axis1=1, axis2=2) - noise).clip(0.0, 1.0)
    leverage = 1.0 / rest.count[owner] + np.einsum("mc,mcd,md->m", away, variance[owner], away)
    rank = np.count_nonzero(directions(Moments.of(z, Y), options)[2])
    telling = directions(rest, options)[2].sum(axis=1)[owner] == rank
    return LeftOut(errors, leverage, unexplained, telling)
