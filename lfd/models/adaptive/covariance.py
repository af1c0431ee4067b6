"""The covariance C of what may have changed: in three parts, see `lfd.models.adaptive.correction`."""

from dataclasses import dataclass
from functools import cached_property
from typing import Self

import numpy as np

from lfd.arrays import Array
from lfd.bounds import NOT_NEGATIVE, POSITIVE, check_number, check_options
from lfd.distances import squared_distances
from lfd.exceptions import OutOfRange
from lfd.models.adaptive.kinds import DURATION, KINDS


@dataclass(frozen=True)
class CovarianceOptions:
    """Lengths are in units of `ConditionScale`, sizes in a kind's own unit.

    Attributes:
        open_slope: By how much a motion may change as its condition goes beyond those shown.
        near_std: Size of what is a detail of one place.
        value_std: The same for a coordinate at a phase: what a correction changed there by less, as one motion
            differs from another that is meant alike, is hardly carried to other places.
        near: Length over which that fades.
        reach: Length over which a surprising correction fades, in each kind: what the world changed in one place it
            changed wherever the same motion leads through it. What the gripper does is carried as far as the tempo.
        beside: Length over which the surprise at a place follows that of the corrections beside it.

    Raises:
        OutOfRange: One is not what it can be.
    """

    open_slope: float = 1.0
    near_std: float = 0.02
    value_std: float = 0.05
    near: float = 0.3
    reach: tuple[float, float, float] = (2.5, 2.5, 2.5)
    beside: float = 0.1

    def __post_init__(self) -> None:
        check_options(
            self, open_slope=NOT_NEGATIVE, near_std=POSITIVE, value_std=POSITIVE, near=POSITIVE, beside=POSITIVE
        )
        if len(self.reach) != KINDS:
            raise OutOfRange("CovarianceOptions.reach", self.reach, f"{KINDS} numbers, one for each kind of output")
        for reach in self.reach:
            check_number("CovarianceOptions.reach", reach, POSITIVE)

    @cached_property
    def rates(self) -> Array:
        """By which a surprising correction fades in each kind, that of openings last, shape (4,)."""
        return _ROOT_3 / np.array([*self.reach, self.reach[DURATION]])


@dataclass(frozen=True, eq=False)
class Nearness:
    """How near m places are to the J corrections, as the covariance sees it.

    Attributes:
        fixed: Parts 1 and 2, Levy's Brownian motion, faded, and what is a detail of one place, in each kind for a unit
            of one, shape (3, m, J).
        wide: Part 3 at a surprise of one, in each kind: the Matern kernel of order 3/2, shape (3, m, J).
        beside: The corrections' shares in the surprise at the places, before they are normalised, shape (m, J).
        detail: How much of what is a detail of one place applies, where all else does, shape (m, J).
    """

    fixed: Array
    wide: Array
    beside: Array
    detail: Array

    @classmethod
    def of(cls, distances: Array, levy: Array, options: CovarianceOptions, kinds: int = KINDS) -> Self:
        """That of places.

        Args:
            distances: From them to the corrections, shape (m, J).
            levy: See `levy`, shape (m, J).
            options: Of the covariance.
            kinds: How many there are.
        """
        r = options.rates[:kinds, None, None] * distances
        wide = (1.0 + r) * np.exp(-r)
        detail = np.exp(distances * (-1.0 / options.near))
        fixed = _SLOPE_AT * options.open_slope**2 * levy * wide + options.near_std**2 * detail
        beside = np.exp((distances.min(axis=1, keepdims=True) - distances) * (1.0 / options.beside))
        return cls(fixed, wide, beside, detail)

    def surprise(self, surprises: Array, acting: Array) -> Array:
        """Root mean square surprise at the places in each kind (3, m), from that of the corrections (3, J)."""
        total = acting @ self.beside.T
        return np.asarray(surprises @ self.beside.T / np.maximum(total, _TINY), dtype=np.float64)


@dataclass(frozen=True, eq=False)
class Applied:
    """What of the corrections of one way applies at a place, in each kind.

    Attributes:
        weights: How much of each change, of all together at most as much as is near, shape (3, J).
        carried: How much of that, at most all, is there because of part 3 alone, where no other correction says as
            much, shape (3, J).
        evidence: How many corrections speak for it, at least 1, shape (3,).
        left: The share of the variance, shape (3,).
        surprise: Mean square of what might be a surprise there, shape (3,).
        near: How much the nearest alone would count in part 3, shape (3,).
    """

    weights: Array
    carried: Array
    evidence: Array
    left: Array
    surprise: Array
    near: Array


@dataclass(frozen=True, eq=False)
class Solved:
    """The corrections of one way, and the inverse of their C + R in each kind.

    Attributes:
        options: Of the covariance.
        variances: Units of the kinds, squared, shape (3,).
        acting: 1 where a correction acts in a kind, 0 where it does not, shape (3, J).
        surprises: By which each exceeds parts 1 and 2, shape (3, J).
        std: The same, with those beside it, shape (3, J).
        inverse: Shape (3, J, J); of those that act.
    """

    options: CovarianceOptions
    variances: Array
    acting: Array
    surprises: Array
    std: Array
    inverse: Array

    @classmethod
    def of(
        cls,
        nearness: Nearness,
        squares: Array,
        acting: Array,
        *,
        doubt: tuple[Array, Array],
        units: Array,
        options: CovarianceOptions,
    ) -> Self:
        """Solve for corrections.

        Args:
            nearness: Of the corrections to each other.
            squares: Of their changes in each kind, shape (3, J).
            acting: See the class.
            doubt: R, relative to C, shape (J,), and as it is, shape (3, J).
            units: Of the kinds, shape (3,).
            options: Of the covariance.
        """
        variances = units**2
        fixed = variances[:, None, None] * nearness.fixed
        own = fixed.diagonal(axis1=1, axis2=2)
        surprises = acting * np.sqrt(np.maximum(squares - own, 0.0))
        std = acting * nearness.surprise(surprises, acting)
        C = fixed + std[:, :, None] * std[:, None] * nearness.wide
        relative, absolute = doubt
        diagonal = np.einsum("kjj->kj", C)  # a view
        diagonal *= 1.0 + relative
        diagonal += absolute
        both_act = acting[:, :, None] * acting[:, None]
        C *= both_act
        diagonal += 1.0 - acting  # what does not act stands alone, with a variance of one, and is asked nothing
        inverse = np.linalg.inv(C) * both_act
        return cls(options, variances, acting, surprises, std, inverse)

    def at(self, place: Nearness, beyond: float) -> Applied:
        """What applies at a place.

        Args:
            place: Its nearness to the corrections.
            beyond: How far it lies outside what the demonstrations show.
        """
        fixed, wide = place.fixed[:, 0], place.wide[:, 0]
        std = place.surprise(self.surprises, self.acting)
        surprise = std[:, 0] ** 2
        surprising = std * self.std * wide
        rows = self.variances[:, None] * fixed + surprising
        elsewhere = surprising * (1.0 - place.detail[0])
        weights, carried = (np.stack([rows, elsewhere])[:, :, None] @ self.inverse)[:, :, 0]
        own = self.variances * open_variance(beyond, self.options) + surprise
        left = (1.0 - np.vecdot(weights, rows) / own).clip(0.0, 1.0)
        # Together no more than the nearest of them could do alone: corrections against each other do not run away.
        most = np.maximum((self.acting * wide).max(axis=1, keepdims=True), _TINY)
        total = np.abs(weights).sum(axis=1, keepdims=True)
        limit = 1.0 / np.maximum(total / most, 1.0)
        # What is a detail of one place is not known where another correction says as much: their mean tells then.
        evidence = _evidence(weights)
        alone = np.maximum(2.0 / evidence - 1.0, 0.0)[:, None]
        carried = carried.clip(np.minimum(weights, 0.0), np.maximum(weights, 0.0))
        return Applied(weights * limit, carried * (limit * alone), evidence, left, surprise, most[:, 0])


def _evidence(weights: Array) -> Array:
    """How many corrections of the same weight would have such a mean, of weights (3, J), shape (3,)."""
    squares = np.vecdot(weights, weights)
    sums = np.abs(weights).sum(axis=1) ** 2
    evidence: Array = np.divide(sums, squares, out=np.ones_like(sums), where=squares > 0.0)
    return np.maximum(evidence, 1.0)


def levy(a: Array, b: Array) -> Array:
    """Covariance of Levy's Brownian motion between places (m, c) and (n, c), shape (m, n): zero about the origin."""
    of_a, of_b = (np.sqrt(np.vecdot(x, x)) for x in (a, b))
    return np.asarray(0.5 * (of_a[:, None] + of_b - np.sqrt(squared_distances(a, b))), dtype=np.float64)


def open_variance(beyond: float, options: CovarianceOptions) -> float:
    """Parts 1 and 2 at a place that lies so far beyond what the demonstrations show."""
    return _SLOPE_AT * options.open_slope**2 * beyond + options.near_std**2


_ROOT_3 = 3.0**0.5
_SLOPE_AT = 0.2  # distance beyond what was shown at which the open slope is meant
_TINY = 1e-300
