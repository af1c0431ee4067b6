"""Tests by ranks: Wilcoxon's signed-rank test, Mann and Whitney's, Kruskal and Wallis', and Holm's adjustment.

Small samples have exact p-values, conditional on the ranks that were observed: the null distribution is enumerated by
the shift algorithm (Streitberg and Röhmel 1986), which needs no sample without ties. Large ones have the normal
approximation, its variance from the same ranks, which is what a correction for ties comes to.
"""

from __future__ import annotations

from collections.abc import Sequence
from functools import lru_cache

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtr
from scipy.stats import rankdata

from services.study.analysis.hypotheses import Direction

Array = NDArray[np.float64]

EXACT_UP_TO = 50
"""Observations whose null distribution is enumerated: its counts are below 2^53, so that floats hold them."""

_DECIMALS = 9  # that values are compared in: what differs by less is the same, whatever was added up to it


class RankTest(msgspec.Struct, frozen=True):
    """What a test by ranks found.

    Attributes:
        statistic: W+, the rank sum of positive differences; U of the first group; H.
        opposite: W-, or U of the second group; none of H.
        n: observations in the test, without differences of zero.
        zeros: differences of zero, which were left out (Wilcoxon 1949).
        p: of the alternative that was asked for.
        exact: p is enumerated, or from permutations of the groups, and no approximation.
    """

    statistic: float
    opposite: float | None
    n: int
    zeros: int
    p: float
    exact: bool


def signed_rank(differences: ArrayLike, direction: Direction, exact_up_to: int = EXACT_UP_TO) -> RankTest:
    """Wilcoxon's signed-rank test of differences within pairs against a distribution symmetric about zero.

    Args:
        differences: of the first from the second, shape (n,); infinite ones rank last.
        direction: of the first against the second, in the alternative.
        exact_up_to: so many differences the distribution is enumerated.
    """
    d = rounded(differences)
    kept = d[d != 0.0]
    ranks = rankdata(np.abs(kept))
    plus, minus = float(ranks[kept > 0.0].sum()), float(ranks[kept < 0.0].sum())
    exact = len(kept) <= exact_up_to
    if exact:
        low, high = _tails(_signed_sums(_doubled(ranks)), plus)
    else:
        low, high = _normal_tails(plus - ranks.sum() / 2.0, float(np.sqrt(np.sum(ranks**2) / 4.0)))
    return RankTest(plus, minus, len(kept), len(d) - len(kept), _p(low, high, direction), exact)


def mann_whitney(first: ArrayLike, second: ArrayLike, direction: Direction, exact_up_to: int = EXACT_UP_TO) -> RankTest:
    """Mann and Whitney's test of two groups against one distribution for both.

    Args:
        first: values of the one group, shape (m,), at least one.
        second: of the other, shape (n,), at least one.
        direction: of the first against the second, in the alternative.
        exact_up_to: so many values of both the distribution is enumerated.
    """
    x, y = rounded(first), rounded(second)
    m, n = len(x), len(y)
    ranks = rankdata(np.concatenate((x, y)))
    total = float(ranks[:m].sum())
    u = total - m * (m + 1) / 2.0
    exact = m + n <= exact_up_to
    if exact:
        low, high = _tails(_subset_sums(_doubled(ranks), m), total)
    else:
        low, high = _normal_tails(u - m * n / 2.0, float(np.sqrt(m * n * np.var(ranks, ddof=1) / (m + n))))
    return RankTest(u, m * n - u, m + n, 0, _p(low, high, direction), exact)


def kruskal_wallis(groups: Sequence[ArrayLike], rng: np.random.Generator, permutations: int = 10_000) -> RankTest:
    """Kruskal and Wallis' test of groups against one distribution for all; p by random permutations of the values.

    Args:
        groups: values of each, two groups at least, each of one value at least.
        rng: draws the permutations.
        permutations: as many.
    """
    sizes = np.array([np.size(group) for group in groups])
    ranks = rankdata(np.concatenate([rounded(group) for group in groups]))
    edges = np.concatenate(([0], np.cumsum(sizes)[:-1]))
    middle = (len(ranks) + 1) / 2.0

    def h(arranged: Array) -> Array:
        means = np.add.reduceat(arranged, edges, axis=-1) / sizes
        between = (sizes * (means - middle) ** 2).sum(axis=-1)
        spread = float(np.var(ranks, ddof=1))
        return np.asarray(between / spread if spread else between)

    found = float(h(ranks))
    drawn = h(rng.permuted(np.tile(ranks, (permutations, 1)), axis=1))
    p = (1.0 + np.count_nonzero(drawn >= found - 1e-9)) / (permutations + 1.0)
    return RankTest(found, None, len(ranks), 0, float(p), exact=True)


def holm(p: Sequence[float]) -> list[float]:
    """Holm's adjusted p-values (1979), in the order of the p-values."""
    adjusted, least = [0.0] * len(p), 0.0
    for rank, i in enumerate(sorted(range(len(p)), key=p.__getitem__)):
        least = max(least, min(1.0, (len(p) - rank) * p[i]))
        adjusted[i] = least
    return adjusted


def rounded(values: ArrayLike) -> Array:
    """Values as they are compared: without what rounding has added."""
    return np.asarray(np.round(np.asarray(values, dtype=np.float64), _DECIMALS), dtype=np.float64)


def null_signed(n: int) -> Array:
    """P(W+ = w) for n differences without ties, shape (n (n + 1) / 2 + 1,)."""
    counts = _signed_sums(tuple(range(1, n + 1)))
    return np.asarray(counts / counts.sum(), dtype=np.float64)


def null_rank_sum(m: int, n: int) -> Array:
    """P(U = u) for groups of m and n values without ties, shape (m n + 1,)."""
    counts = _subset_sums(tuple(range(1, m + n + 1)), m)[m * (m + 1) // 2 :][: m * n + 1]
    return np.asarray(counts / counts.sum(), dtype=np.float64)


def _doubled(ranks: Array) -> tuple[int, ...]:
    """Twice the ranks, which ties make halves of: whole numbers."""
    return tuple(sorted(int(rank) for rank in np.rint(2.0 * ranks)))


@lru_cache(maxsize=64)
def _signed_sums(weights: tuple[int, ...]) -> Array:
    """Of all choices of signs, how many have each sum of the weights with a positive one."""
    counts = np.zeros(sum(weights) + 1)
    counts[0] = 1.0
    for weight in weights:
        counts[weight:] += counts[: len(counts) - weight].copy()
    return counts


@lru_cache(maxsize=64)
def _subset_sums(weights: tuple[int, ...], size: int) -> Array:
    """Of all subsets of that size, how many have each sum of weights."""
    counts = np.zeros((size + 1, sum(weights) + 1))
    counts[0, 0] = 1.0
    for weight in weights:
        counts[1:, weight:] += counts[:-1, : counts.shape[1] - weight].copy()
    return np.asarray(counts[size], dtype=np.float64)


def _tails(counts: Array, statistic: float) -> tuple[float, float]:
    """P(W <= w) and P(W >= w) of a statistic of doubled ranks."""
    w = round(2.0 * statistic)
    total = counts.sum()
    return float(counts[: w + 1].sum() / total), float(counts[w:].sum() / total)


def _normal_tails(deviation: float, spread: float) -> tuple[float, float]:
    z = deviation / spread if spread else 0.0
    return float(ndtr(z)), float(ndtr(-z))


def _p(low: float, high: float, direction: Direction) -> float:
    match direction:
        case Direction.LESS:
            return low
        case Direction.GREATER:
            return high
        case Direction.DIFFERENT:
            return min(1.0, 2.0 * min(low, high))
