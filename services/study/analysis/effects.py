"""How large a difference is, and how sure that is."""

from __future__ import annotations

import msgspec
import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.special import ndtri
from scipy.stats import rankdata

from services.study.analysis.ranks import EXACT_UP_TO, null_rank_sum, null_signed, rounded

Array = NDArray[np.float64]

RESAMPLES = 5_000


class Effect(msgspec.Struct, frozen=True):
    """An estimate with its interval.

    Attributes:
        value: of the effect; None where nobody can be compared.
        low: lower end; None where the data do not bound it.
        high: upper end.
    """

    value: float | None
    low: float | None = None
    high: float | None = None


def rank_biserial(differences: ArrayLike, confidence: float, seed: int) -> Effect:
    """The matched-pairs rank-biserial correlation (Kerby 2014): (W+ - W-) / (W+ + W-), from -1 to 1.

    The interval is the percentile bootstrap over pairs. Where all differences have one sign every resample has it,
    too, and nothing bounds the effect: there is none.

    Args:
        differences: shape (n,).
        confidence: of the interval.
        seed: of the resampling.
    """
    # Sorted, so that the order of the people is no matter.
    d = np.sort(rounded(differences))
    value = _biserial(d[None, :])[0]
    if not np.isfinite(value):
        return Effect(None)
    if abs(value) == 1.0:
        return Effect(float(value))
    rng = np.random.default_rng(seed)
    drawn = _biserial(rng.choice(d, (RESAMPLES, len(d))))
    low, high = np.nanquantile(drawn, [(1.0 - confidence) / 2.0, (1.0 + confidence) / 2.0])
    return Effect(float(value), float(low), float(high))


def _biserial(d: Array) -> Array:
    """Of each row of differences, shape (k,); NaN where all are zero."""
    zeros = (d == 0.0).sum(axis=1, keepdims=True)
    # Zeros have the least ranks; without them the others move down.
    ranks = np.where(d == 0.0, 0.0, rankdata(np.abs(d), axis=1) - zeros)
    total = ranks.sum(axis=1)
    signed = np.asarray((np.sign(d) * ranks).sum(axis=1), dtype=np.float64)
    return np.asarray(np.divide(signed, total, out=np.full(len(d), np.nan), where=total > 0.0), dtype=np.float64)


def shift_within(differences: ArrayLike, confidence: float) -> Effect:
    """Hodges and Lehmann's shift (1963): the median of all means of two differences, each with itself included.

    The interval is exact, from the signed-rank distribution (Hollander and Wolfe 1999, section 3.3): of at least that
    confidence.

    Args:
        differences: shape (n,).
        confidence: of the interval.
    """
    d = np.asarray(differences, dtype=np.float64)
    if not len(d) or not np.all(np.isfinite(d)):
        return Effect(None)
    i, j = np.triu_indices(len(d))
    means = np.sort((d[i] + d[j]) / 2.0)
    n = len(d)
    spread = n * (n + 1) * (2 * n + 1) / 24.0
    k = _cut(null_signed(n), confidence) if n <= EXACT_UP_TO else _normal_cut(len(means) / 2.0, spread, confidence)
    return _between(means, k)


def shift_between(first: ArrayLike, second: ArrayLike, confidence: float) -> Effect:
    """Hodges and Lehmann's shift of the first group from the second: the median of all differences between them.

    Args:
        first: values, shape (m,).
        second: values, shape (n,).
        confidence: of the interval, which is exact as in `shift_within`.
    """
    x, y = np.asarray(first, dtype=np.float64), np.asarray(second, dtype=np.float64)
    m, n = len(x), len(y)
    differences = np.sort((x[:, None] - y[None, :]).ravel())
    if not len(differences) or not np.all(np.isfinite(differences)):
        return Effect(None)
    spread = m * n * (m + n + 1) / 12.0
    exact = m + n <= EXACT_UP_TO
    k = _cut(null_rank_sum(m, n), confidence) if exact else _normal_cut(m * n / 2.0, spread, confidence)
    return _between(differences, k)


def cliffs_delta(first: ArrayLike, second: ArrayLike, confidence: float, seed: int) -> Effect:
    """Cliff's delta (1993): P(first > second) - P(first < second), from -1 to 1, as the values have it.

    The interval is the percentile bootstrap within each group; none where the groups do not overlap.

    Args:
        first: values, shape (m,).
        second: values, shape (n,).
        confidence: of the interval.
        seed: of the resampling.
    """
    x, y = np.sort(rounded(first)), np.sort(rounded(second))
    if not len(x) or not len(y):
        return Effect(None)
    value = float(np.sign(x[:, None] - y[None, :]).mean())
    if abs(value) == 1.0:
        return Effect(value)
    rng = np.random.default_rng(seed)
    a, b = rng.choice(x, (RESAMPLES, len(x))), rng.choice(y, (RESAMPLES, len(y)))
    drawn = np.sign(a[:, :, None] - b[:, None, :]).mean(axis=(1, 2))
    low, high = np.quantile(drawn, [(1.0 - confidence) / 2.0, (1.0 + confidence) / 2.0])
    return Effect(value, float(low), float(high))


def _cut(null: Array, confidence: float) -> int:
    """How many of the least values lie outside the interval: the most k with P(W < k) within half of what is left."""
    below = np.concatenate(([0.0], np.cumsum(null)))
    return int(np.searchsorted(below, (1.0 - confidence) / 2.0 + 1e-12, side="right")) - 1


def _normal_cut(middle: float, variance: float, confidence: float) -> int:
    return max(0, int(np.floor(middle - float(ndtri((1.0 + confidence) / 2.0)) * np.sqrt(variance))))


def _between(values: Array, k: int) -> Effect:
    """The median of sorted values, from the k-th to the k-th from behind."""
    middle = float(np.median(values))
    return Effect(middle, float(values[k - 1]), float(values[-k])) if k > 0 else Effect(middle)
