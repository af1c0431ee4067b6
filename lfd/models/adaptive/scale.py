"""The units of a condition: what makes a difference of each of its dimensions comparable to the others'."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array, frozen
from lfd.motion.demonstration import Demonstration

SPREADS = 5.0
"""Standard deviations of a condition that count as much as one extent of the motions, where its unit says nothing."""


@dataclass(frozen=True, eq=False)
class ConditionScale:
    """From conditions (task parameters) in whatever units to numbers without a unit.

    One unit is the extent of the motions in a dimension that is a length, such as the object's place; in any other it
    is `SPREADS` standard deviations of the conditions seen. So no dimension's unit matters. A dimension that never
    varied has no unit: nothing is known of it, and it makes no difference.

    Attributes:
        centre: Of the conditions, shape (c,).
        unit: Shape (c,), in units of the condition, positive; infinite where a dimension has none.
        axes: Which coordinate of the way to the object, 0 to 2, each dimension is, shape (c,); -1: it is no length.
        relevance: Factor by which each dimension counts, shape (c,); 0 switches it off (automatic relevance
            determination).
    """

    centre: Array
    unit: Array
    axes: NDArray[np.intp]
    relevance: Array

    @classmethod
    def of(cls, demonstrations: Sequence[Demonstration], extent: float) -> Self:
        """The scale of demonstrations, at least one, whose motions lead `extent` [m] from their start."""
        conditions = np.array([d.condition for d in demonstrations])
        ways = np.array([d.origin - d.trajectory.positions[0] for d in demonstrations])
        per_metre, axes = _per_metre(conditions, ways)
        return cls.of_conditions(conditions, per_metre * extent, axes)

    @classmethod
    def of_conditions(cls, conditions: Array, unit: Array, axes: NDArray[np.intp]) -> Self:
        """The scale of conditions (M, c), given the unit (c,) of those dimensions that are lengths, and their axes."""
        centre = conditions.mean(axis=0)
        spread = np.sqrt(np.mean((conditions - centre) ** 2, axis=0))
        varies = spread > _ROUNDING * np.abs(conditions).max(axis=0)
        other = np.where(varies, SPREADS * spread, np.inf)
        return cls(frozen(centre), frozen(np.where(axes >= 0, unit, other)), axes, np.ones(len(centre)))

    @property
    def lengths(self) -> NDArray[np.bool_]:
        """Which dimensions are lengths, shape (c,)."""
        return self.axes >= 0

    def standard(self, conditions: Array) -> Array:
        """Conditions (..., c) as numbers about their centre, shape (..., c)."""
        return np.asarray((conditions - self.centre) * self._factor, dtype=np.float64)

    def unseen(self, s: Array) -> bool:
        """Whether a condition (c,) differs in a dimension in which nothing that was taught did."""
        if not self._lacks_units:
            return False
        away = np.abs(s - self.centre) > _ROUNDING * np.maximum(np.abs(self.centre), np.abs(s))
        return bool(np.any(away & np.isinf(self.unit)))

    def completed(self, conditions: Array) -> Self:
        """With units, where there are none, from how far conditions (J, c), at least one, lie from the centre."""
        if not self._lacks_units or not len(conditions):
            return self
        away = np.sqrt(np.mean((conditions - self.centre) ** 2, axis=0))
        varies = np.isinf(self.unit) & (away > _ROUNDING * np.abs(self.centre))
        return replace(self, unit=frozen(np.where(varies, SPREADS * away, self.unit))) if varies.any() else self

    @cached_property
    def _factor(self) -> Array:
        return np.asarray(self.relevance / self.unit, dtype=np.float64)

    @cached_property
    def _lacks_units(self) -> bool:
        return bool(np.isinf(self.unit).any())


def _per_metre(conditions: Array, ways: Array) -> tuple[Array, NDArray[np.intp]]:
    """How many units of each dimension (c,) make a metre, 0 where it is no length, and its axis.

    A condition is a place if it is the way from the start to the origin in all demonstrations, in whatever unit. In
    any other, a dimension that varies is a length if it is a coordinate of that way.

    Args:
        conditions: Shape (M, c).
        ways: From start to origin, shape (M, 3) [m].
    """
    if conditions.shape == ways.shape:
        factor = _proportion(conditions.ravel(), ways.ravel())
        if factor:
            return np.full(conditions.shape[1], factor), np.arange(conditions.shape[1])
    varies = np.ptp(conditions, axis=0) > _ROUNDING * np.abs(conditions).max(axis=0)
    factors = np.array([[_proportion(values, way) for way in ways.T] for values in conditions.T])
    per_metre = np.where(varies, factors.max(axis=1), 0.0)
    return per_metre, np.where(per_metre > 0.0, factors.argmax(axis=1), -1)


def _proportion(values: Array, of: Array) -> float:
    """The factor, without its sign, by which numbers (n,) are proportional to others (n,); 0 where they are not."""
    square = float(of @ of)
    factor = float(values @ of) / square if square > 0.0 else 0.0
    proportional = np.abs(values - factor * of).max() <= _PROPORTIONAL * np.abs(values).max()
    return abs(factor) if proportional else 0.0


_ROUNDING = 1e-12
_PROPORTIONAL = 1e-9
