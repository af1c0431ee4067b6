"""What demonstrations say: their vectors as a function of the condition, shrunk as far as they ask for it."""

from __future__ import annotations

import math
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve

from lfd.arrays import Array
from lfd.distances import squared_distances
from lfd.models.adaptive.moments import Moments
from lfd.motion.alignment import group_by_condition

Groups = list[NDArray[np.intp]]


@dataclass(frozen=True)
class RegressionOptions:
    """Fixed once for all data; lengths are fractions of the extent, so that metres and millimetres give the same.

    Chosen on recordings of people, by what a model predicts at a condition that was left out (`deploy/bench learning`):
    all of them lie on a plateau, and a choice by cross-validation on each set did no better.

    Attributes:
        same: Conditions nearer than this count as one.
        marker_noise: Differences of the condition below this teach no trend.
        undetermined: Share of the whole shrinkage where there are too few conditions to tell whether a trend predicts.
        near: Length over which a departure from the trend fades.
        near_spread: The same, as a fraction of the conditions' spread; the two lengths are added as squares.
        noise: Variance of a motion about its condition's, relative to the departures from the trend [-].
    """

    same: float = 0.04
    marker_noise: float = 0.1
    undetermined: float = 0.15
    near: float = 0.12
    near_spread: float = 0.2
    noise: float = 0.3


@dataclass(frozen=True, eq=False)
class Expectation:
    """A condition, and what the demonstrations say about it.

    Attributes:
        s: The condition, shape (c,).
        nearness: k(s, S), how near the demonstrations' conditions are, 1 to 0, shape (M,).
        solved: (K + r I)^-1 of that, shape (M,).
        mean: The vector expected there, shape (D,).
    """

    s: Array
    nearness: Array
    solved: Array
    mean: Array

    @property
    def unexplained(self) -> float:
        """The share of the departures from the trend that the demonstrations leave open there, 1 to 0."""
        return max(1.0 - float(self.nearness @ self.solved), 0.0)


@dataclass(frozen=True, eq=False)
class Regression:
    """A linear trend over the condition, and by a Gaussian process what it does not explain.

    The trend is a ridge regression whose ridge is q times a third of the scatter of the conditions. q is how badly the
    trend predicts conditions that are left out, relative to the mean: 0 where it predicts them exactly, so that a
    linear family is recovered whatever its size, and 1 where it is no better than no trend at all.

    Attributes:
        conditions: S, shape (M, c).
        vectors: X, shape (M, D).
        measure: Linear map from vectors to numbers whose sum of squares is what counts as the error, shape (D, P).
        extent: E, the length that the options' fractions are of, in units of the condition, positive.
        options: Parameters.
        tested_shrinkage: q as tested elsewhere, for demonstrations that cannot tell; see `tested`.
    """

    conditions: Array
    vectors: Array
    measure: Array
    extent: float
    options: RegressionOptions
    tested_shrinkage: float | None = None

    def at(self, s: Array) -> Expectation:
        """What the demonstrations say about a condition, shape (c,)."""
        nearness = self.kernel(s[None], self.conditions)[0]
        mean = np.asarray(self.trend(s) + nearness @ self._gain, dtype=np.float64)
        return Expectation(s, nearness, self.solved(nearness), mean)

    def mean(self, s: Array) -> Array:
        """The vector expected at a condition (c,), shape (D,)."""
        return self.at(s).mean

    def trend(self, s: Array) -> Array:
        """The trend alone at s, shape (..., c) to (..., D)."""
        s_mean, mean = self._centre
        return np.asarray(mean + (s - s_mean) @ self._slope, dtype=np.float64)

    def kernel(self, a: Array, b: Array) -> Array:
        """exp(-d^2 / 2 l^2) of conditions (m, c) and (n, c), shape (m, n)."""
        return np.asarray(np.exp(-0.5 * squared_distances(a, b) / self.length**2), dtype=np.float64)

    def solved(self, k: Array) -> Array:
        """(K + r I)^-1 k, shape (M, ...)."""
        return np.asarray(cho_solve(self._factor, k, check_finite=False), dtype=np.float64)

    def leverage(self, s: Array) -> float:
        """How far the trend has to reach for s: 1 / M at the middle of the conditions, more with distance."""
        away = s - self._centre[0]
        return float(1.0 / len(self.conditions) + away @ self._slope_variance @ away)

    def uncertainty(self, expected: Expectation) -> float:
        """Variance of a motion at a place relative to the departures from the trend [-]."""
        return self.options.noise + expected.unexplained * (1.0 + self.leverage(expected.s))

    @cached_property
    def length(self) -> float:
        """The kernel's l, in units of the condition."""
        return float(np.hypot(self.options.near * self.extent, self.options.near_spread * self.spread))

    @cached_property
    def spread(self) -> float:
        """Root mean square distance of the conditions from their mean."""
        return float(np.sqrt(np.mean(np.sum((self.conditions - self._centre[0]) ** 2, axis=1))))

    @cached_property
    def groups(self) -> Groups:
        """Indices of the demonstrations of each condition."""
        groups = group_by_condition(self.conditions, self.options.same * self.extent)
        return [np.array(group, dtype=np.intp) for group in groups]

    @property
    def determined(self) -> bool:
        """Whether the demonstrations can tell by themselves how far their trend is to be trusted."""
        return self._left_out_ratio is not None

    @property
    def shrinkage(self) -> float:
        """q, from 0 for a trend that is trusted to 1 for one that is shrunk most."""
        if self._left_out_ratio is not None:
            return self._left_out_ratio
        return self.options.undetermined if self.tested_shrinkage is None else self.tested_shrinkage

    def tested(self, conditions: Array, vectors: Array) -> Self:
        """The same, with its trend tested at conditions (J, c) where vectors (J, D) were right.

        A test speaks only in the trend's favour: where it fails, the world may have changed. It has passed if it
        predicts a quarter of what is measured. Demonstrations that can tell by themselves do not listen.

        Args:
            conditions: At least one.
            vectors: Right there.
        """
        about_mean = vectors - self._centre[1]
        about_trend = about_mean - self._unshrunk(self._moments, conditions - self._centre[0])
        errors, totals = (np.sum((x @ self.measure) ** 2, axis=0) for x in (about_trend, about_mean))
        counted = totals > _NEGLIGIBLE * totals.max()
        passed = float(np.quantile(errors[counted] / totals[counted], 0.25)) if counted.any() else 1.0
        shrinkage = min(passed, self.options.undetermined)
        known = self.tested_shrinkage is not None and math.isclose(self.tested_shrinkage, shrinkage, abs_tol=1e-9)
        return self if known else replace(self, tested_shrinkage=shrinkage)

    def _unshrunk(self, moments: Moments, away: Array) -> Array:
        """What a trend without shrinkage adds to its mean at distances (m, c) from the mean condition, shape (m, D)."""
        directions, values = self._directions(moments)
        return np.asarray(away @ directions / values @ directions.T @ moments.cross, dtype=np.float64)

    @cached_property
    def _left_out_ratio(self) -> float | None:
        """The squared error of an unshrunk trend at left-out conditions, relative to that of their mean, 0 to 1.

        A condition whose loss leaves the trend undetermined says nothing about it; None where that is so of all.
        """
        if len(self.groups) < 2:
            return 1.0
        dimensions = len(self._directions(self._moments)[1])
        error = total = 0.0
        for group in self.groups:
            rest = self._moments.without(self._deviations[group], self._departures[group])
            if len(self._directions(rest)[1]) < dimensions:
                continue
            about_mean = self._departures[group] - rest.mean
            about_trend = about_mean - self._unshrunk(rest, self._deviations[group] - rest.s_mean)
            error += float(np.sum((about_trend @ self.measure) ** 2))
            total += float(np.sum((about_mean @ self.measure) ** 2))
        return min(error / total, 1.0) if total > 0.0 else None

    @cached_property
    def left_out(self) -> tuple[Array, Array]:
        """Errors at each condition of a regression that has not seen it, and what it expected of them.

        Returns:
            Errors (M, D) and their relative variances (M,), as of `uncertainty`; NaN where nothing would be left.
        """
        M = len(self.conditions)
        errors, variances = np.full_like(self.vectors, np.nan), np.full(M, np.nan)
        if len(self.groups) < 2:
            return errors, variances
        inverse = self.solved(np.eye(M))
        ones, S, X = inverse.sum(axis=1), inverse @ self._deviations, inverse @ self._departures
        for group in self.groups:
            rest = self._moments.without(self._deviations[group], self._departures[group])
            slope, slope_variance = self._ridge(rest)
            # What a Gaussian process of the departures from that trend misses there, without the group, from the
            # inverse with it (Rasmussen and Williams 2006, eq. 5.12, for more than one left out).
            solved = X[group] - np.outer(ones[group], rest.mean - rest.s_mean @ slope) - S[group] @ slope
            block = np.linalg.inv(inverse[np.ix_(group, group)])
            errors[group] = block @ solved
            away = self._deviations[group] - rest.s_mean
            reach = 1.0 + 1.0 / rest.count + np.sum(away @ slope_variance * away, axis=1)
            unexplained = np.clip(np.diag(block) - self.options.noise, 0.0, 1.0)
            variances[group] = self.options.noise + unexplained * reach
        return errors, variances

    @cached_property
    def _centre(self) -> tuple[Array, Array]:
        return self.conditions.mean(axis=0), self.vectors.mean(axis=0)

    @cached_property
    def _deviations(self) -> Array:
        return self.conditions - self._centre[0]

    @cached_property
    def _departures(self) -> Array:
        return self.vectors - self._centre[1]

    @cached_property
    def _moments(self) -> Moments:
        S, X = self._deviations, self._departures
        return Moments(len(S), np.zeros(S.shape[1]), np.zeros(X.shape[1]), S.T @ S, S.T @ X)

    def _directions(self, moments: Moments) -> tuple[Array, Array]:
        """The directions in which conditions differ by more than `same`, shape (c, r), and their scatter (r,)."""
        values, axes = np.linalg.eigh(moments.scatter)
        differs = values > moments.count * (self.options.same * self.extent) ** 2
        return axes[:, differs], values[differs]

    def _ridge(self, moments: Moments) -> tuple[Array, Array]:
        """Slope (c, D) of a trend through the mean, and its variance relative to that of a motion (c, c)."""
        q, scatter, count = self.shrinkage, moments.scatter, moments.count
        total, squared = float(np.trace(scatter)), float(np.sum(scatter**2))
        # In how many directions the conditions spread: each of them is shrunk alike, however many there are.
        directions = max(total**2 / squared, 1.0) if squared > 0.0 else 1.0
        ridge = q * (total / (3.0 * directions) + count * (self.options.marker_noise * self.extent) ** 2)
        precision = scatter + ridge * np.eye(len(scatter))
        slope = np.linalg.lstsq(precision, moments.cross, rcond=_RANK_TOLERANCE)[0]
        values, axes = np.linalg.eigh(precision)
        sureness = np.maximum(values, 0.0) + count * (self.options.same * self.extent) ** 2
        return np.asarray(slope, dtype=np.float64), np.asarray(axes / sureness @ axes.T)

    @cached_property
    def _trend_fit(self) -> tuple[Array, Array]:
        return self._ridge(self._moments)

    @property
    def _slope(self) -> Array:
        return self._trend_fit[0]

    @property
    def _slope_variance(self) -> Array:
        return self._trend_fit[1]

    @cached_property
    def _factor(self) -> tuple[Array, bool]:
        K = self.kernel(self.conditions, self.conditions)
        factor: tuple[Array, bool] = cho_factor(K + self.options.noise * np.eye(len(K)))
        return factor

    @cached_property
    def _gain(self) -> Array:
        return self.solved(self.vectors - self.trend(self.conditions))


_RANK_TOLERANCE = 1e-12
_NEGLIGIBLE = 1e-3  # of the largest
