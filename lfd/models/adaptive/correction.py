"""What corrections change: a Gaussian process over the condition, on top of what the demonstrations say.

The change at s, given the changes y_j that the corrections made at s_j, is C(s, s_j) (C + R)^-1 y. C has two parts:

1. What the demonstrations left open: how uncertain their mean and trend are, and the room between their conditions.
   A correction that this explains says nothing new about places where the demonstrations are sure.
2. Where the corrections are larger than that, the world has changed: a part as large as the surprise, and a few times
   as wide as the motion is long.

So a correction acts near its condition and, smoothly, less with distance; it acts wider the more it surprises.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from lfd.arrays import Array
from lfd.distances import squared_distances
from lfd.models.adaptive.regression import Expectation, Regression


@dataclass(frozen=True)
class CorrectionOptions:
    """Fixed once for all data; lengths are fractions of the extent of the motions.

    Attributes:
        noise: Variance of a correction relative to what it could have changed [-].
        forgetting: Variance added to a correction for each newer one at its condition, relative as the noise [-].
        mean_std: Uncertainty of one demonstration as the mean of its condition.
        near_std: Of the room between the demonstrations' conditions.
        slope_std: By how much a motion may change as its condition changes by one unit, both lengths [-].
        reach: Length over which a surprising correction fades: what the world changed in one place it changed wherever
            the same motion leads through it.
        most: Corrections kept; beyond it the most outdated is forgotten.
    """

    noise: float = 0.003
    forgetting: float = 2.0
    mean_std: float = 0.02
    near_std: float = 0.003
    slope_std: float = 1.0
    reach: float = 2.5
    most: int = 200


@dataclass(frozen=True, eq=False)
class Effect:
    """What corrections do at a place.

    Attributes:
        change: Of the vector, shape (D,).
        open_share: The share of the variance that they have left: 1 far from all, nearly 0 at the newest.
    """

    change: Array
    open_share: float


@dataclass(frozen=True, eq=False)
class Corrections:
    """The corrections of a regression, oldest first.

    Attributes:
        regression: What is corrected.
        options: Parameters.
        conditions: s_j, shape (J, c).
        changes: y_j = x_j - m(s_j), where m is the regression's mean, shape (J, D).
        solved: (K + r I)^-1 k(s_j, S), of the demonstrations' kernel K, shape (J, M).
        openness: Part 1 of C between the corrections, shape (J, J).
        middle: Mean condition of the demonstrations, shape (c,).
        slope_covariance: Of each output's slope there, as the demonstrations left it, shape (c, c).
    """

    regression: Regression
    options: CorrectionOptions
    conditions: Array
    changes: Array
    solved: Array
    openness: Array
    middle: Array
    slope_covariance: Array

    @classmethod
    def none(cls, regression: Regression, options: CorrectionOptions) -> Self:
        """No correction yet."""
        M, c = regression.conditions.shape
        D = regression.vectors.shape[1]
        middle = regression.conditions.mean(axis=0)
        return cls(
            regression,
            options,
            conditions=np.zeros((0, c)),
            changes=np.zeros((0, D)),
            solved=np.zeros((0, M)),
            openness=np.zeros((0, 0)),
            middle=middle,
            slope_covariance=_slope_covariance(regression.conditions - middle, options, regression.extent),
        )

    def __len__(self) -> int:
        return len(self.conditions)

    def added(self, expected: Expectation, x: Array) -> Self:
        """With a newer correction: at a place the vector is x (D,)."""
        row, corner = self._open(expected), self._open_at(expected)
        longer = replace(
            self,
            conditions=np.vstack([self.conditions, expected.s]),
            changes=np.vstack([self.changes, x - expected.mean]),
            solved=np.vstack([self.solved, expected.solved]),
            openness=np.block([[self.openness, row[:, None]], [row[None], np.full((1, 1), corner)]]),
        )
        return longer if len(longer) <= self.options.most else longer.without(int(np.argmax(longer._outdated)))

    @property
    def vectors(self) -> Array:
        """x_j, what the corrections said, shape (J, D)."""
        return self._first_vectors(len(self))

    def _first_vectors(self, n: int) -> Array:
        changes = self.changes[:n]
        vectors: Array = changes + np.reshape([self.regression.mean(s) for s in self.conditions[:n]], changes.shape)
        return vectors

    def on(self, regression: Regression) -> Self:
        """The same corrections of another regression."""
        corrections = type(self).none(regression, self.options)
        for s, x in zip(self.conditions, self.vectors, strict=True):
            corrections = corrections.added(regression.at(s), x)
        return corrections

    def tested(self) -> Self:
        """The same, their regression's trend tested by the oldest of them, where it cannot tell by itself."""
        if self.regression.determined:
            return self
        if not len(self):
            return self.on(replace(self.regression, tested_shrinkage=None))
        regression = self.regression.tested(self.conditions[:_TESTS], self._first_vectors(_TESTS))
        return self if regression is self.regression else self.on(regression)

    def without(self, index: int) -> Self:
        """Without the correction of that index; -1 is the newest."""
        kept = np.delete(np.arange(len(self)), index)
        return replace(
            self,
            conditions=self.conditions[kept],
            changes=self.changes[kept],
            solved=self.solved[kept],
            openness=self.openness[np.ix_(kept, kept)],
        )

    def effect(self, expected: Expectation) -> Effect:
        """What the corrections change at a place."""
        if not len(self):
            return Effect(np.zeros(self.changes.shape[1]), 1.0)
        covariances = self._open(expected) + self.surprise * self._wide(expected.s[None])[0]
        before = self._open_at(expected) + self.surprise
        explained = float(covariances @ cho_solve(self._factor, covariances, check_finite=False))
        return Effect(covariances @ self._gain, max(1.0 - explained / before, 0.0))

    @cached_property
    def surprise(self) -> float:
        """Mean square by which the corrections exceed what the demonstrations left open; the measure's unit squared."""
        if not len(self):
            return 0.0
        return max(float(np.mean(self._squares - np.diag(self.openness))), 0.0)

    @cached_property
    def surprising_share(self) -> float:
        """The share of the corrections' mean square that was a surprise."""
        return self.surprise / float(np.mean(self._squares)) if self.surprise > 0.0 else 0.0

    @cached_property
    def _squares(self) -> Array:
        """Mean squares of the changes, in the measure's unit squared, shape (J,)."""
        return np.asarray(np.sum((self.changes @ self.regression.measure) ** 2, axis=1), dtype=np.float64)

    def _open(self, expected: Expectation) -> Array:
        """Part 1 of C between a place and the corrections, shape (J,)."""
        near = self.regression.kernel(expected.s[None], self.conditions)[0] - self.solved @ expected.nearness
        slopes = (self.conditions - self.middle) @ (self.slope_covariance @ (expected.s - self.middle))
        return np.asarray(self._mean_variance + slopes + self._near_variance * near, dtype=np.float64)

    def _open_at(self, expected: Expectation) -> float:
        away = expected.s - self.middle
        slope = float(away @ self.slope_covariance @ away)
        return self._mean_variance + slope + self._near_variance * expected.unexplained

    @cached_property
    def _mean_variance(self) -> float:
        return (self.options.mean_std * self.regression.extent) ** 2 / len(self.regression.conditions)

    @cached_property
    def _near_variance(self) -> float:
        return (self.options.near_std * self.regression.extent) ** 2

    def _wide(self, s: Array) -> Array:
        """Part 2 of C between s (m, c) and the corrections, at one unit of surprise, shape (m, J).

        The Matern kernel of order 3/2: smooth enough to carry a trend of the corrections on, and less smooth than a
        Gaussian, which carries the slope between two corrections against each other on still further.
        """
        distances = np.sqrt(3.0 * squared_distances(s, self.conditions)) / (self.options.reach * self.regression.extent)
        wide: Array = (1.0 + distances) * np.exp(-distances)
        return wide

    @cached_property
    def _outdated(self) -> Array:
        """How many newer corrections lie at the condition of each, fading with distance, shape (J,)."""
        newer: Array = np.triu(self.regression.kernel(self.conditions, self.conditions) ** 4, k=1)
        return np.asarray(newer.sum(axis=1), dtype=np.float64)

    @cached_property
    def _factor(self) -> tuple[Array, bool]:
        C = self.openness + self.surprise * self._wide(self.conditions)
        noise = np.diag(C) * (self.options.noise + self.options.forgetting * self._outdated)
        factor: tuple[Array, bool] = cho_factor(C + np.diag(noise))
        return factor

    @cached_property
    def _gain(self) -> Array:
        gain: Array = cho_solve(self._factor, self.changes)
        return gain


def _slope_covariance(deviations: Array, options: CorrectionOptions, extent: float) -> Array:
    """Given demonstrations of `mean_std` whose conditions deviate so (M, c), and before them `slope_std`."""
    variance, prior = (options.mean_std * extent) ** 2, options.slope_std**2
    values, axes = np.linalg.eigh(deviations.T @ deviations)
    return np.asarray(axes * (prior * variance / (prior * np.maximum(values, 0.0) + variance)) @ axes.T)


_TESTS = 5  # corrections that a trend is tested by: later ones leave the demonstrations' account as it is
