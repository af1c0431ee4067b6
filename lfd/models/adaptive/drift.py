"""The corrections' own trend over the condition: what several of them show together, and none of them alone.

What one correction changed is carried to other conditions as it is (`lfd.models.adaptive.covariance`). Where changes
grow with the condition, that leaves most of the next one to be given. So a linear trend of them is fitted beside the
Gaussian process, which then tells what departs from it: universal kriging, whose trend is called drift (Matheron 1969).
It is one of how far a condition lies outside what the demonstrations show, so that nothing changes where they do show;
or one of the condition itself.

It is trusted as far as corrections that are left out bear it out. Let q be the sum of the squared errors at them
(Allen's PRESS 1974) with a drift, relative to that without. Of n conditions, p of which a drift needs, n - p bear it
out, each in as many independent directions d as the corrections have. Then q^(d (n - p) / 2) is how probable the
corrections are without it, relative to with it (the pseudo-Bayes factor of Geisser and Eddy 1979).

A trend leads away for ever, and nobody has shown that it does. No number of the condition is followed beyond the
corrections and the demonstrations: what grew to one side of them is not its opposite on the other.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Self

import numpy as np

from lfd.arrays import Array
from lfd.bounds import POSITIVE, at_least, check_options
from lfd.models.adaptive.covariance import Applied, Solved
from lfd.models.adaptive.kinds import POSITION


@dataclass(frozen=True)
class DriftOptions:
    """When corrections show a trend.

    Attributes:
        conditions: How many different ones it takes.
        doubt: Odds at which nothing is trusted yet: less than three to one is "not worth more than a bare mention"
            (Kass and Raftery 1995).
        least: Standard deviation of the conditions in a direction in which half of the trend is believed, in units of
            `ConditionScale`.

    Raises:
        OutOfRange: One is not what it can be.
    """

    conditions: int = 3
    doubt: float = 3.0
    least: float = 0.01

    def __post_init__(self) -> None:
        check_options(self, conditions=at_least(3), doubt=POSITIVE, least=POSITIVE)


@dataclass(frozen=True, eq=False)
class Told:
    """The corrections of one way, and what they are without a drift.

    Attributes:
        z: Their conditions in units of the scale, shape (J, c).
        outside: How far these lie outside what the demonstrations show, shape (J, c).
        groups: Indices of the corrections of each condition.
        products: Inner products of their changes in each kind, shape (3, J, J).
        largest: Of their changes, see `Kinds.largest`, shape (2, 3, J).
        solved: The Gaussian process without a drift.
        aged: By how much less each is believed for its age, see `lfd.models.adaptive.age`, shape (J,).
    """

    z: Array
    outside: Array
    groups: Sequence[Sequence[int]]
    products: Array
    largest: Array
    solved: Solved
    aged: Array


@dataclass(frozen=True, eq=False)
class Drift:
    """That of J corrections, as far as it is trusted.

    Attributes:
        of_outside: Its features are how far a condition lies outside; else they are one and the condition.
        lower: Least of each feature that is followed, shape (f,).
        upper: The largest, shape (f,).
        onto: From features to numbers whose squares add up to a leverage, shape (f, r).
        reach: The largest leverage of a condition that was corrected.
        weights: From the numbers to weights of the changes in each kind, shape (3, r, J).
        own: The weights at the corrections, shape (3, J, J).
        largest: Of the changes, see `Kinds.largest`, shape (2, 3): beyond that nothing is changed.
        known: How much of the positions it tells where corrections are left out, from 0 to 1.
        near: Length over which that fades beyond what is followed, in units of the scale.
    """

    of_outside: bool
    lower: Array
    upper: Array
    onto: Array
    reach: float
    weights: Array
    own: Array
    largest: Array
    known: float
    near: float

    @classmethod
    def of(cls, told: Told, near: float, options: DriftOptions) -> Self | None:
        """That of corrections; None where they bear out none."""
        holds = told.solved.acting.min(axis=0)
        groups = [held for group in told.groups if (held := [j for j in group if holds[j]])]
        if len(groups) < options.conditions:
            return None
        conditions = _Conditions.of(told, groups)
        one_and_z = np.concatenate([np.ones((len(told.z), 1)), told.z], axis=1)
        # What the demonstrations left open is no reason to doubt what they show.
        odds = np.log((conditions.surprise + _EVEN) / (1.0 - conditions.surprise + _EVEN))
        outside = _Trend.of(told.outside, conditions, odds, options)
        inside = _Trend.of(one_and_z, conditions, np.zeros_like(odds), options)
        trend = outside if outside.cost <= inside.cost else inside
        if not trend.trust.any():
            return None
        whitened = trend.features @ trend.onto
        weights = trend.trust[:, None, None] * trend.weights
        at_conditions = conditions.mean @ trend.features
        # One of what lies outside is nothing among the demonstrations, and followed from there.
        zero = np.zeros((int(trend is outside), at_conditions.shape[1]))
        followed, leverage = np.append(at_conditions, zero, axis=0), conditions.mean @ whitened
        return cls(
            trend is outside,
            followed.min(axis=0),
            followed.max(axis=0),
            trend.onto,
            float(np.vecdot(leverage, leverage).max()),
            weights,
            whitened @ weights,
            (told.largest * told.solved.acting).max(axis=-1),
            float(trend.trust[POSITION] * (1.0 - trend.missed[POSITION])),
            near,
        )

    def beside(self, applied: Applied, z: Array, outside: Array) -> tuple[Array, Applied]:
        """The drift at a condition, and the Gaussian process of what departs from it.

        Args:
            applied: What of the corrections applies there without a drift.
            z: The condition in units of the scale, shape (c,).
            outside: How far it lies outside what the demonstrations show, shape (c,).

        Returns:
            The weights of the changes in the drift, shape (3, J), and what applies of each change beside it.
        """
        features = outside if self.of_outside else np.concatenate([_ONE, z])
        followed = np.minimum(np.maximum(features, self.lower), self.upper)
        whitened = followed @ self.onto
        # Where it has to reach further than for any correction, it is taken back by as much.
        held = math.sqrt(self.reach / max(float(whitened @ whitened), self.reach))
        weights = (held * whitened) @ self.weights * applied.near[:, None]
        departing, carried = (x - (x[:, None] @ self.own)[:, 0] for x in (applied.weights, applied.carried))
        beyond = features - followed
        told = self.known * held * math.exp(-math.sqrt(beyond @ beyond) / self.near)
        left = np.minimum(applied.left, 1.0 - told * applied.near)
        return weights, Applied(departing, carried, applied.evidence, left, applied.surprise, applied.near)


@dataclass(frozen=True, eq=False)
class _Conditions:
    """The conditions that were corrected.

    Attributes:
        mean: From values at the corrections to those of the conditions, shape (g, J).
        belief: In each of them, shape (g,).
        products: See `Told`.
        size: Sum of the squares of their changes in each kind, shape (3,).
        missed: That of the errors of the Gaussian process where a condition is left out, shape (3,).
        surprise: Share of the squares that the demonstrations did not leave open, shape (3,).
        directions: In how many independent ones the changes differ, shape (3,).
    """

    mean: Array
    belief: Array
    products: Array
    size: Array
    missed: Array
    surprise: Array
    directions: Array

    @classmethod
    def of(cls, told: Told, groups: Sequence[Sequence[int]]) -> Self:
        """Those of groups of corrections that hold."""
        mean = np.zeros((len(groups), len(told.z)))
        for g, group in enumerate(groups):
            mean[g, group] = 1.0 / len(group)
        belief = mean @ (1.0 / (1.0 + told.aged))
        averages = np.sqrt(belief)[:, None] * mean
        inner = averages @ told.products @ averages.T
        size = np.maximum(np.einsum("kgg->k", inner), _TINY)
        missed = _sizes(np.sqrt(belief)[:, None] * _left_out(told.solved.inverse, groups), told.products)
        surprise = (told.solved.surprises**2 @ mean.T @ belief / size).clip(0.0, 1.0)
        directions = (size / np.sqrt(np.maximum((inner**2).sum(axis=(1, 2)), _TINY))) ** 2
        return cls(mean, belief, told.products, size, np.minimum(missed, size), surprise, directions)


@dataclass(frozen=True, eq=False)
class _Trend:
    """A ridge regression of the changes on some features.

    Attributes:
        features: At the corrections, shape (J, f).
        onto: See `Drift`, shape (f, r).
        weights: See `Drift`, of a trend that is believed, shape (r, J).
        missed: Share of the squares of the changes in each kind that it misses at conditions left out, shape (3,).
        trust: In each kind, shape (3,).
        cost: Logarithm of how probable the corrections are without it, relative to with it.
    """

    features: Array
    onto: Array
    weights: Array
    missed: Array
    trust: Array
    cost: float

    @classmethod
    def of(cls, features: Array, conditions: _Conditions, odds: Array, options: DriftOptions) -> Self:
        """That of conditions.

        Args:
            features: See the class.
            conditions: That bear it out or not.
            odds: Against it in each kind, before that is looked at, as logarithms, shape (3,).
            options: Of drifts.
        """
        averages = np.sqrt(conditions.belief)[:, None] * conditions.mean
        U, S, Vt = np.linalg.svd(averages @ features, full_matrices=False)
        ridged = np.sqrt(S**2 + len(averages) * options.least**2)
        hat = (U * (S / ridged) ** 2) @ U.T
        errors = (averages - hat @ averages) / (1.0 - hat.diagonal())[:, None]
        missed = _sizes(errors, conditions.products)
        spare = max(float(conditions.belief.sum() - hat.trace()), 0.0)
        ratio = np.maximum(missed, _TINY) / np.maximum(conditions.missed, _TINY)
        evidence = 0.5 * conditions.directions * spare * np.log(ratio)
        trust = 1.0 - options.doubt * np.exp(np.minimum(evidence + np.maximum(odds, 0.0), 0.0))
        trust = np.where(conditions.size > _TINY, np.maximum(trust, 0.0), 0.0)
        weights = (S / ridged)[:, None] * (U.T @ averages)
        cost = float((evidence + odds) @ (trust > 0.0))
        return cls(features, Vt.T / ridged, weights, np.minimum(missed / conditions.size, 1.0), trust, cost)


def _left_out(inverse: Array, groups: Sequence[Sequence[int]]) -> Array:
    """Errors of Gaussian processes at conditions left out, as combinations of the changes, shape (3, g, J).

    Args:
        inverse: (C + R)^-1, shape (3, J, J); see Rasmussen and Williams (2006), eq. 5.12, for more than one left out.
        groups: Indices of the corrections of each condition.
    """
    if max(map(len, groups)) == 1:
        alone = [j for group in groups for j in group]
        return np.asarray(inverse[:, alone] / inverse[:, alone, alone][..., None], dtype=np.float64)
    blocks = (np.linalg.inv(inverse[:, np.array(group)[:, None], group]) @ inverse[:, group] for group in groups)
    return np.stack([block.mean(axis=1) for block in blocks], axis=1)


def _sizes(combinations: Array, products: Array) -> Array:
    """Sums of the squares of combinations (m, J) or (3, m, J) of vectors of inner products (3, J, J), shape (3,)."""
    return np.asarray(np.vecdot(combinations @ products, combinations).sum(axis=-1).clip(0.0), dtype=np.float64)


_ONE = np.ones(1)
_EVEN = 0.1  # what is left of either explanation where the other is the likeliest
_TINY = 1e-300
