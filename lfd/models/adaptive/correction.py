"""What corrections change: a Gaussian process over the condition for each kind of output, on top of the demonstrations.

The change at s, given the changes y_j that the corrections made at s_j, is C(s, s_j) (C + R)^-1 y. C has three parts:

1. What the demonstrations left open: how their motions go on beyond the conditions that they show (Levy's Brownian
   motion, which is zero among them). A correction that this explains is no reason to doubt what was shown.
2. What is a detail of one place.
3. Where a correction is larger than that, the world has changed: a part as large as the surprise, and a few times as
   wide as the motion is long. No two motions of a person are the same, so where one correction speaks alone only
   what exceeds that scatter is taken elsewhere, of each coordinate at each phase (Wiener's filter): a detour is, by
   how far a hand was off its aim is not.

What several show together is a trend, from which they depart (`lfd.models.adaptive.drift`). A motion that passes
elsewhere what was led round needs less of a correction (`lfd.models.adaptive.detour`).

All of it fades to nothing far away, and no prediction departs further from the demonstrations than the largest
correction did: the weights never add up to more than what the nearest has in part 3, nor is a trend larger than that.
"""

from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array
from lfd.bounds import NOT_NEGATIVE, POSITIVE, at_least, check_number, check_options
from lfd.distances import squared_distances
from lfd.models.adaptive.age import aged
from lfd.models.adaptive.covariance import CovarianceOptions, Nearness, Solved, levy
from lfd.models.adaptive.detour import Detours
from lfd.models.adaptive.drift import Drift, DriftOptions, Told
from lfd.models.adaptive.effect import Effect, Place, likeliest
from lfd.models.adaptive.kinds import POSITION
from lfd.models.adaptive.regression import Expectation, Regression
from lfd.models.adaptive.scale import ConditionScale
from lfd.models.adaptive.ways import contradictions, probabilities, sort_into_ways
from lfd.models.adaptive.worlds import WorldOptions, Worlds, find_worlds
from lfd.motion.alignment import group_by_condition


@dataclass(frozen=True)
class CorrectionOptions:
    """Fixed once for all data; lengths are in units of `ConditionScale`, sizes in a kind's own unit.

    Attributes:
        covariance: Of what may have changed.
        noise: Variance of a correction relative to what it could have changed [-].
        same: Corrections at conditions nearer than this are of one condition.
        gate: By how much nearer the corrections of one way are where it is e times more probable than another.
        world: When corrections of one condition are averaged, and when the newest is followed.
        drift: When those of several conditions show a trend.
        half_life_s: Age at which a correction counts half as much as a new one [s]; None: it does not age.
        most: Corrections kept; beyond it the most outdated is set aside.

    Raises:
        OutOfRange: One is not what it can be.
    """

    covariance: CovarianceOptions = field(default_factory=CovarianceOptions)
    noise: float = 0.003
    same: float = 0.1
    gate: float = 0.05
    world: WorldOptions = field(default_factory=WorldOptions)
    drift: DriftOptions = field(default_factory=DriftOptions)
    half_life_s: float | None = None
    most: int = 200

    def __post_init__(self) -> None:
        check_options(
            self,
            covariance=CovarianceOptions,
            noise=POSITIVE,
            same=NOT_NEGATIVE,
            gate=POSITIVE,
            world=WorldOptions,
            drift=DriftOptions,
            most=at_least(1),
        )
        if self.half_life_s is not None:
            check_number("CorrectionOptions.half_life_s", self.half_life_s, POSITIVE)


@dataclass(frozen=True, eq=False)
class Correction:
    """One of them.

    Attributes:
        s: The condition, shape (c,).
        x: The vector that was right there, shape (D,).
        at_s: When that was so, in seconds since 1970-01-01 UTC, where it is known.
        led: Where the demonstrations alone led there, see `Detours`, shape (P, 3) [m]; where it is known.
    """

    s: Array
    x: Array
    at_s: float | None = None
    led: Array | None = None


@dataclass(frozen=True, eq=False)
class Corrections:
    """The corrections of a regression, oldest first.

    Attributes:
        regression: What is corrected.
        extent: Of the motions [m], the unit of their positions.
        options: Parameters.
        held: The corrections.
        aside: Those that there was no room for, and where they stood, oldest first: taking back makes room again.
    """

    regression: Regression
    extent: float
    options: CorrectionOptions
    held: tuple[Correction, ...] = ()
    aside: tuple[tuple[int, Correction], ...] = ()

    def __len__(self) -> int:
        return len(self.held)

    def added(self, correction: Correction) -> Self:
        """With a newer one."""
        longer = replace(self, held=(*self.held, correction))
        if len(longer) <= self.options.most:
            return longer
        index = int(np.argmax(longer._outdated))
        kept = longer.held[:index] + longer.held[index + 1 :]
        return replace(longer, held=kept, aside=(*self.aside, (index, longer.held[index]))[-self.options.most :])

    def taken_back(self) -> Self:
        """Without the newest, as they were before it; at least one is there."""
        if len(self) < self.options.most or not self.aside:
            return replace(self, held=self.held[:-1])
        index, correction = self.aside[-1]
        # It stood among those that are held now, the newest of them included, before there was no room for it.
        return replace(self, held=(*self.held[:index], correction, *self.held[index:])[:-1], aside=self.aside[:-1])

    def effect(self, expected: Expectation, led: Array | None = None) -> Effect:
        """What the corrections change at a place.

        Args:
            expected: The place.
            led: Where the demonstrations alone lead there, see `Detours.paths`, shape (P, 3) [m]; where it is known.
        """
        if not self.held:
            return Effect(np.zeros(self.regression.vectors.shape[1]))
        z, outside = expected.z, expected.outside
        if self._scale is not self.regression.scale:
            z = outside = self._scale.standard(expected.s)
        distances = np.sqrt(squared_distances(z[None], self._z))
        needed = None if led is None else self._detours.needed(led, shown=len(self._solved) > 1)
        nearness = Nearness.of(distances, levy(outside[None], self._outside), self.options.covariance, len(self._units))
        place = Place(z, outside, nearness, needed)
        if len(self._solved) == 1:
            return self._of_way(0, place)
        likely = probabilities(distances[0], self._ways, self.options.gate)
        return likeliest(likely, lambda way: self._of_way(way, place))

    @property
    def noise(self) -> float:
        """Variance of a correction about the mean of its world [m^2]."""
        return float(self._worlds.noise[POSITION])

    @cached_property
    def changes(self) -> Array:
        """y_j = x_j - m(s_j), where m is the regression's mean, shape (J, D)."""
        vectors = np.array([correction.x for correction in self.held])
        return np.asarray(vectors - self._expected[0], dtype=np.float64)

    @cached_property
    def _details(self) -> Array:
        """What of the changes is a detail of its place, shape (J, D); the rest is what Wiener's filter keeps."""
        return self.regression.kinds.details(self.changes, (self.options.covariance.value_std * self._units) ** 2)

    @cached_property
    def mean_square(self) -> float:
        """Of the corrections' positions [m^2]."""
        return float(self._products[POSITION].trace() / len(self))

    def _of_way(self, way: int, place: Place) -> Effect:
        applied = self._solved[way].at(place.nearness, place.beyond)
        kinds, changes, details = self.regression.kinds, self.changes, self._details
        if place.needed is not None:
            changes, details = (place.needed.of(x, kinds.weights) for x in (changes, details))
        if self._drift is None:
            change = kinds.each_from_its_own(applied.weights @ changes - applied.carried @ details)
        else:
            drift, applied = self._drift.beside(applied, place.z, place.outside)
            departing = applied.weights @ changes - applied.carried @ details
            change = kinds.each_from_its_own(drift @ self.changes + departing)
            change = kinds.bounded(change, applied.near**2 * self._drift.largest)
        return Effect.of_positions(change, applied, place.beyond)

    @cached_property
    def _drift(self) -> Drift | None:
        """Of ways that contradict each other there is none."""
        if len(self) < self.options.drift.conditions or len(self._solved) > 1:
            return None
        told = Told(
            self._z,
            self._outside,
            self._groups,
            self._products,
            self.regression.kinds.largest(self.changes),
            self._solved[0],
            self._aged,
        )
        return Drift.of(told, self.options.covariance.near, self.options.drift)

    @cached_property
    def _detours(self) -> Detours:
        scatter = self.options.covariance.value_std * self.extent
        return Detours.of([c.led for c in self.held], self.regression.kinds.paths(self.changes), scatter)

    @cached_property
    def _solved(self) -> tuple[Solved, ...]:
        """For each way."""
        worlds, covariance = self._worlds, self.options.covariance
        nearness = Nearness.of(self._distances, levy(self._outside, self._outside), covariance, len(self._units))
        repeated = worlds.noise[:, None] * (worlds.shared > 1.0)
        return tuple(
            Solved.of(
                nearness,
                self._products.diagonal(axis1=1, axis2=2),
                np.asarray(worlds.current & (self._ways == way), dtype=np.float64),
                doubt=(self.options.noise + self._aged, repeated),
                units=self._units,
                options=covariance,
            )
            for way in range(int(self._ways.max()) + 1)
        )

    @cached_property
    def _conditions(self) -> Array:
        return np.array([correction.s for correction in self.held])

    @cached_property
    def _scale(self) -> ConditionScale:
        return self.regression.scale.completed(self._conditions)

    @cached_property
    def _z(self) -> Array:
        return self._scale.standard(self._conditions)

    @cached_property
    def _outside(self) -> Array:
        """How far each lies beyond what the demonstrations show, shape (J, c)."""
        return self._expected[1] if self._scale is self.regression.scale else self._z

    @cached_property
    def _expected(self) -> tuple[Array, Array]:
        """See `Regression.at_each`."""
        return self.regression.at_each(self._conditions)

    @cached_property
    def _distances(self) -> Array:
        return np.sqrt(squared_distances(self._z, self._z))

    @cached_property
    def _units(self) -> Array:
        """Of positions [m], of orientations [rad], of the logarithm of the duration, and of openings, shape (K,)."""
        return np.array([self.extent, *[1.0] * (self.regression.kinds.count - 1)])

    @cached_property
    def _products(self) -> Array:
        """Inner products of the changes in each kind, shape (K, J, J)."""
        return self.regression.kinds.products(self.changes)

    @cached_property
    def _near(self) -> NDArray[np.bool_]:
        """Which are of one condition, shape (J, J)."""
        return np.asarray(self._distances <= self.options.same, dtype=np.bool_)

    @cached_property
    def _groups(self) -> list[list[int]]:
        """Indices of those of each condition: mostly there is one at each."""
        alone = self._near.sum() == len(self)
        return [[j] for j in range(len(self))] if alone else group_by_condition(self._z, self.options.same)

    @cached_property
    def _worlds(self) -> Worlds:
        return find_worlds(self._products, self._groups, self._units, self.options.world)

    @cached_property
    def _ways(self) -> NDArray[np.intp]:
        """Of each correction."""
        current, slope = self._worlds.current[POSITION], self.options.covariance.open_slope * self.extent
        against = contradictions(self._products[POSITION], self._distances, slope, self.noise)
        return sort_into_ways(against, self._distances, current)

    @cached_property
    def _aged(self) -> Array:
        return aged([correction.at_s for correction in self.held], self.options.half_life_s)

    @property
    def _outdated(self) -> Array:
        """How many newer ones there are at the condition of each, shape (J,)."""
        return np.asarray(np.triu(self._near, k=1).sum(axis=1) + ~self._worlds.current[POSITION] * len(self))
