"""What demonstrations say: their vectors as a function of the condition, shrunk as far as they ask for it."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np
from numpy.typing import NDArray
from scipy.linalg import cho_factor, cho_solve
from scipy.spatial.distance import cdist

from lfd.alignment import group_by_condition
from lfd.arrays import Array

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
    """

    conditions: Array
    vectors: Array
    measure: Array
    extent: float
    options: RegressionOptions

    def mean(self, s: Array) -> Array:
        """The vector expected at a condition (c,), shape (D,)."""
        return np.asarray(self.trend(s) + self.near(s) @ self._gain, dtype=np.float64)

    def trend(self, s: Array) -> Array:
        """The trend alone at s, shape (..., c) to (..., D)."""
        s_mean, mean = self._centre
        return np.asarray(mean + (s - s_mean) @ self._slope, dtype=np.float64)

    def near(self, s: Array) -> Array:
        """How near the demonstrations' conditions are to s: k(s, S), 1 to 0, shape (M,)."""
        nearness: Array = self.kernel(s[None], self.conditions)[0]
        return nearness

    def kernel(self, a: Array, b: Array) -> Array:
        """exp(-d^2 / 2 l^2) of conditions (m, c) and (n, c), shape (m, n)."""
        return np.asarray(np.exp(-0.5 * cdist(a, b, "sqeuclidean") / self.length**2), dtype=np.float64)

    def solved(self, k: Array) -> Array:
        """(K + r I)^-1 k, shape (M, ...)."""
        return np.asarray(cho_solve(self._factor, k), dtype=np.float64)

    def leverage(self, s: Array) -> float:
        """How far the trend has to reach for s: 1 / M at the middle of the conditions, more with distance."""
        away = s - self._centre[0]
        return float(1.0 / len(self.conditions) + away @ self._slope_variance @ away)

    def uncertainty(self, s: Array, k: Array) -> float:
        """Variance of a motion at s relative to the departures from the trend, given k = `near(s)` [-]."""
        unexplained = max(1.0 - float(k @ self.solved(k)), 0.0)
        return self.options.noise + unexplained * (1.0 + self.leverage(s))

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

    @cached_property
    def shrinkage(self) -> float:
        """q: the squared error of an unshrunk trend at left-out conditions, relative to that of their mean, 0 to 1.

        A condition whose loss leaves the trend undetermined says nothing about it.
        """
        if len(self.groups) < 2:
            return 1.0
        measured = self.vectors @ self.measure
        dimensions = len(self._directions(self._deviations)[1])
        error = total = 0.0
        for group in self.groups:
            rest = np.setdiff1d(np.arange(len(self.conditions)), group)
            S, Y = self.conditions[rest], measured[rest]
            s_mean, mean = S.mean(axis=0), Y.mean(axis=0)
            directions, values = self._directions(S - s_mean)
            if len(values) < dimensions:
                continue
            coordinates = (S - s_mean) @ directions
            slope = (coordinates / values**2).T @ (Y - mean)
            trend = mean + (self.conditions[group] - s_mean) @ directions @ slope
            error += float(np.sum((measured[group] - trend) ** 2))
            total += float(np.sum((measured[group] - mean) ** 2))
        return min(error / total, 1.0) if total > 0.0 else self.options.undetermined

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
        for group in self.groups:
            rest = np.setdiff1d(np.arange(M), group)
            S, X = self.conditions[rest], self.vectors[rest]
            s_mean, mean = S.mean(axis=0), X.mean(axis=0)
            slope, slope_variance = self._ridge(S - s_mean, X - mean)
            departures = self.vectors - mean - (self.conditions - s_mean) @ slope
            # What a Gaussian process without the group misses there, from the inverse with it (Rasmussen and Williams
            # 2006, eq. 5.12, for more than one left out).
            block = np.linalg.inv(inverse[np.ix_(group, group)])
            errors[group] = block @ (inverse[group] @ departures)
            away = self.conditions[group] - s_mean
            reach = 1.0 + 1.0 / len(rest) + np.sum(away @ slope_variance * away, axis=1)
            unexplained = np.clip(np.diag(block) - self.options.noise, 0.0, 1.0)
            variances[group] = self.options.noise + unexplained * reach
        return errors, variances

    @cached_property
    def _centre(self) -> tuple[Array, Array]:
        return self.conditions.mean(axis=0), self.vectors.mean(axis=0)

    @cached_property
    def _deviations(self) -> Array:
        return self.conditions - self._centre[0]

    def _directions(self, deviations: Array) -> tuple[Array, Array]:
        """The directions in which conditions differ by more than `same`, shape (c, r), and their singular values."""
        _, values, axes = np.linalg.svd(deviations, full_matrices=False)
        differs = values > np.sqrt(len(deviations)) * self.options.same * self.extent
        return axes[differs].T, values[differs]

    def _ridge(self, deviations: Array, departures: Array) -> tuple[Array, Array]:
        """Slope (c, D) of a trend through the mean, and its variance relative to that of a motion (c, c)."""
        q, M = self.shrinkage, len(deviations)
        scatter = deviations.T @ deviations
        total, squared = float(np.trace(scatter)), float(np.sum(scatter**2))
        # In how many directions the conditions spread: each of them is shrunk alike, however many there are.
        directions = total**2 / squared if squared > 0.0 else 1.0
        ridge = q * (total / (3.0 * directions) + M * (self.options.marker_noise * self.extent) ** 2)
        precision = scatter + ridge * np.eye(len(scatter))
        slope = np.linalg.lstsq(precision, deviations.T @ departures, rcond=_RANK_TOLERANCE)[0]
        values, axes = np.linalg.eigh(precision)
        sureness = np.maximum(values, 0.0) + M * (self.options.same * self.extent) ** 2
        return np.asarray(slope, dtype=np.float64), np.asarray(axes / sureness @ axes.T)

    @cached_property
    def _trend_fit(self) -> tuple[Array, Array]:
        return self._ridge(self._deviations, self.vectors - self._centre[1])

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
