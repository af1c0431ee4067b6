"""What demonstrations say: their vectors as a function of the condition, trusted as far as they bear each other out."""

from __future__ import annotations

from dataclasses import dataclass, field
from functools import cached_property

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array
from lfd.bounds import NOT_NEGATIVE, POSITIVE, check_options
from lfd.distances import squared_distances
from lfd.models.adaptive.kinds import Kinds
from lfd.models.adaptive.left_out import LeftOut, leave_out
from lfd.models.adaptive.moments import Moments
from lfd.models.adaptive.scale import ConditionScale
from lfd.models.adaptive.trend import TrendOptions, limited, reach_variance, slopes, slopes_by_coordinate
from lfd.motion.alignment import group_by_condition

Groups = list[NDArray[np.intp]]


@dataclass(frozen=True)
class RegressionOptions:
    """Fixed once for all data; lengths are in units of `ConditionScale`.

    Chosen on recordings of people, by what a model predicts at a condition that was left out (`deploy/bench learning`,
    part "tune"): all of them lie on a plateau.

    Attributes:
        same: Conditions nearer than this count as one.
        near: Length over which a departure from the trend fades (length-scale of the Gaussian process).
        near_spread: The same, as a fraction of the conditions' spread; the two lengths are added as squares.
        noise: Variance of a motion about its condition's, relative to the departures from the trend [-].
        sharpness: How much more a trend counts that predicts left-out conditions better: its share goes with their
            mean square error to the minus this (stacking).
        trend: Of the trends.

    Raises:
        OutOfRange: One is not what it can be.
    """

    same: float = 0.04
    near: float = 0.12
    near_spread: float = 0.2
    noise: float = 0.3
    sharpness: float = 8.0
    trend: TrendOptions = field(default_factory=TrendOptions)

    def __post_init__(self) -> None:
        check_options(
            self,
            same=NOT_NEGATIVE,
            near=POSITIVE,
            near_spread=NOT_NEGATIVE,
            noise=POSITIVE,
            sharpness=NOT_NEGATIVE,
            trend=TrendOptions,
        )


@dataclass(frozen=True, eq=False)
class Expectation:
    """A condition, and what the demonstrations say about it.

    Attributes:
        s: The condition, shape (c,).
        z: The same in units of the scale, shape (c,).
        outside: How far the trend is not followed there, in these units, shape (c,); zero among the conditions shown.
        mean: The vector expected there, shape (D,).
        unexplained: The share of the departures from the trend that the demonstrations leave open there, 1 to 0.
    """

    s: Array
    z: Array
    outside: Array
    mean: Array
    unexplained: float


@dataclass(frozen=True, eq=False)
class Regression:
    """An average of linear trends over the condition, and by a Gaussian process what they do not explain.

    The trends are ridge regressions, from one that is trusted to none at all; each counts as well as it predicts
    conditions that are left out, for each kind of output by itself. So a linear family is recovered whatever its size,
    what does not depend on the condition is averaged, and the model is about as good as the best of them. None is
    followed far beyond the conditions shown, but for one that predicts exactly.

    Where the condition tells where the object is, each trend is also tried coordinate by coordinate: how a motion goes
    sideways depends on how far aside the object is, and not on how high it is. That leaves far less to learn; it blends
    the frames of the start and of the object (Calinon 2016), each axis by itself. Such a trend stands alone, without
    the process: what departs from it may be noise.

    Attributes:
        scale: Of the conditions.
        conditions: S, shape (M, c).
        vectors: X, shape (M, D).
        kinds: Of the vectors' entries.
        options: Parameters.
    """

    scale: ConditionScale
    conditions: Array
    vectors: Array
    kinds: Kinds
    options: RegressionOptions

    def at(self, s: Array) -> Expectation:
        """What the demonstrations say about a condition, shape (c,)."""
        z = self.scale.standard(s)
        nearness = self.kernel(z[None], self.z)[0]
        mean, outside = self._mean_and_outside(z, nearness)
        unexplained = max(1.0 - float(nearness @ self._inverse @ nearness), 0.0)
        return Expectation(s, z, outside, mean, unexplained)

    def at_each(self, conditions: Array) -> tuple[Array, Array]:
        """`Expectation.mean` and `Expectation.outside` at conditions (m, c), shapes (m, D) and (m, c)."""
        z = self.scale.standard(conditions)
        return self._mean_and_outside(z, self.kernel(z, self.z))

    def kernel(self, a: Array, b: Array) -> Array:
        """exp(-d^2 / 2 l^2) of conditions (m, c) and (n, c) in units of the scale, shape (m, n)."""
        return np.asarray(np.exp(-0.5 / self.length**2 * squared_distances(a, b)), dtype=np.float64)

    def uncertainty(self, expected: Expectation) -> float:
        """Variance of a motion at a place relative to the departures from the trend [-]."""
        away = expected.z - self._centre
        leverage = 1.0 / len(self.z) + float(away @ self._reach_variance @ away)
        return self.options.noise + expected.unexplained * (1.0 + leverage)

    @cached_property
    def left_out(self) -> tuple[Array, Array]:
        """Errors at each condition of a regression that has not seen it, and what it expected of them.

        Returns:
            Errors (M, D) and their relative variances (M,), as of `uncertainty`; NaN where nothing would be left.
        """
        found = self._left_out
        if found is None:
            return np.full_like(self.vectors, np.nan), np.full(len(self.vectors), np.nan)
        errors = np.einsum("kd,kmd->md", self.shares[:, self.kinds.of_column], found.errors)
        return errors, self.options.noise + found.unexplained * (1.0 + found.leverage)

    @cached_property
    def shares(self) -> Array:
        """How much each trend of `LeftOut` counts in each kind, shape (K + 1, kinds) or (2 K + 1, kinds).

        One condition teaches no trend. Two, or others that cannot tell, are joined by a straight line, which is
        followed no further than they lie apart.
        """
        found = self._left_out
        K = len(self.options.trend.shrinkages)
        shares = np.zeros((K + 1 if self._depends is None else 2 * K + 1, self.kinds.count))
        if found is None:
            shares[K - 1] = 1.0
        elif not found.telling.any():
            shares[0] = 1.0
        else:
            errors = self._squares(found.errors[:, found.telling])
            spread = np.maximum(self._squares(self.vectors[None] - self._mean)[0], np.finfo(np.float64).tiny)
            counted = np.maximum(errors, _NEGLIGIBLE * spread)
            weights = (counted.min(axis=0) / counted) ** self.options.sharpness
            weights[K, errors[K] > _EXACT * spread] = 0.0
            shares = weights / weights.sum(axis=0)
        return shares

    @cached_property
    def score(self) -> float:
        """Squared errors at left-out conditions relative to the spread about the mean, summed over the kinds [-].

        Smaller is better; infinite where nothing would be left.
        """
        errors, variances = self.left_out
        if np.isnan(variances).all():
            return np.inf
        missed, spread = (self._squares(x[None])[0] for x in (errors, self.vectors - self._mean))
        varies = spread > _NEGLIGIBLE * max(float(spread.max()), np.finfo(np.float64).tiny)
        return float(np.sum(missed[varies] / spread[varies]))

    @cached_property
    def groups(self) -> Groups:
        """Indices of the demonstrations of each condition."""
        return [np.array(group, dtype=np.intp) for group in group_by_condition(self.z, self.options.same)]

    @cached_property
    def z(self) -> Array:
        """The conditions in units of the scale, shape (M, c)."""
        return self.scale.standard(self.conditions)

    @cached_property
    def length(self) -> float:
        """The kernel's l."""
        spread = float(np.sqrt(np.mean(np.sum((self.z - self._centre) ** 2, axis=1))))
        return float(np.hypot(self.options.near, self.options.near_spread * spread))

    @cached_property
    def _radius(self) -> Array:
        """How far the conditions reach from their mean, shape ()."""
        away = self.z - self._centre
        return np.asarray(np.sqrt(np.vecdot(away, away).max()), dtype=np.float64)

    def _mean_and_outside(self, z: Array, nearness: Array) -> tuple[Array, Array]:
        """Of conditions (..., c) in units of the scale, and of the kernel to the demonstrations (..., M)."""
        away = z - self._centre
        followed = limited(away, self._radius, self.options.trend)
        trends = followed @ self._limited + away @ self._unlimited
        return self._mean + trends + nearness @ self._gain, away - followed

    def _squares(self, X: Array) -> Array:
        """Sums of squares of vectors (K, m, D) in each kind, shape (K, kinds)."""
        flat = self.kinds.sizes(X.reshape(-1, X.shape[-1]))
        return np.asarray(flat.reshape(self.kinds.count, *X.shape[:2]).sum(axis=2).T, dtype=np.float64)

    @cached_property
    def _centre(self) -> Array:
        return np.asarray(self.z.mean(axis=0), dtype=np.float64)

    @cached_property
    def _mean(self) -> Array:
        return np.asarray(self.vectors.mean(axis=0), dtype=np.float64)

    @cached_property
    def _moments(self) -> Moments:
        return Moments.of(self.z, self.vectors - self._mean)

    @cached_property
    def _left_out(self) -> LeftOut | None:
        if len(self.groups) < 2:
            return None
        about_centre, about_mean = self.z - self._centre, self.vectors - self._mean
        return leave_out(
            about_centre,
            about_mean,
            self.groups,
            self._inverse,
            noise=self.options.noise,
            options=self.options.trend,
            depends=self._depends,
        )

    @cached_property
    def _depends(self) -> NDArray[np.bool_] | None:
        """Which entries of the vectors a trend by coordinates lets depend on which dimensions, shape (c, D)."""
        axes, axis_of_column = self.scale.axes[:, None], self.kinds.axis_of_column
        return (axes < 0) | (axis_of_column < 0) | (axes == axis_of_column) if self.scale.lengths.any() else None

    @cached_property
    def _reach_variance(self) -> Array:
        return reach_variance(self._moments, self.options.trend)

    @cached_property
    def _slopes(self) -> tuple[Array, Array, Array]:
        """Of what is followed within the radius, beside the process and alone, and everywhere, each shape (c, D)."""
        counted, B = self.shares[:, self.kinds.of_column], slopes(self._moments, self.options.trend)
        beside = np.einsum("kd,kcd->cd", counted[: len(B)], B)
        alone = np.zeros_like(beside)
        if self._depends is not None:
            by_coordinate = slopes_by_coordinate(self._moments, self._depends, self.options.trend)
            alone = np.einsum("kd,kcd->cd", counted[len(B) + 1 :], by_coordinate)
        return beside, alone, counted[len(B)] * B[0]

    @cached_property
    def _limited(self) -> Array:
        beside, alone, _ = self._slopes
        return beside + alone

    @cached_property
    def _unlimited(self) -> Array:
        return self._slopes[2]

    @cached_property
    def _inverse(self) -> Array:
        return np.asarray(np.linalg.inv(self.kernel(self.z, self.z) + self.options.noise * np.eye(len(self.z))))

    @cached_property
    def _gain(self) -> Array:
        beside, _, everywhere = self._slopes
        share = self.shares[: len(self.options.trend.shrinkages) + 1].sum(axis=0)[self.kinds.of_column]
        departures = share * (self.vectors - self._mean) - (self.z - self._centre) @ (beside + everywhere)
        return np.asarray(self._inverse @ departures, dtype=np.float64)


_NEGLIGIBLE = 1e-14  # of the spread about the mean, as squares: rounding
_EXACT = 1e-6  # of the same: what is predicted so well may be followed everywhere
