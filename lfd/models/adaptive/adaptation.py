"""The default model: one correction is enough.

A prediction is what the demonstrations say (`lfd.models.adaptive.regression`) plus what the corrections changed
(`lfd.models.adaptive.correction`), both in the space of start-anchored weights of all outputs (`lfd.models.encoding`).
Averaging, as in equations (19) and (20), leaves most of the error after one correction.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from functools import cached_property
from typing import Self

import numpy as np

from lfd.arrays import Array, frozen
from lfd.bounds import NOT_NEGATIVE, at_least, check_options
from lfd.exceptions import NothingToTakeBack
from lfd.models.adaptive.condensation import condensed
from lfd.models.adaptive.correction import Correction, CorrectionOptions, Corrections
from lfd.models.adaptive.effect import Effect
from lfd.models.adaptive.kinds import PHASES, Kinds
from lfd.models.adaptive.regression import Expectation, Regression, RegressionOptions
from lfd.models.adaptive.relevance import RelevanceOptions, relevant
from lfd.models.adaptive.scale import ConditionScale
from lfd.models.adaptive.spread import Spread, SpreadPrior, spread_of
from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis
from lfd.models.distribution import MotionDistribution
from lfd.models.encoding import POSITION, Encoding, reference_rotation, shown_in
from lfd.models.model import Prediction, completed, in_part
from lfd.models.strokes import bounds_of
from lfd.motion.demonstration import Demonstration, Situation, check_demonstrations, check_dimension
from lfd.motion.trajectory import PREDICTION_POINTS, equal_phases

_FINE_BASIS = GaussianBasis(count=40, width=0.0256)  # finer than the thesis', to follow a correction closely


@dataclass(frozen=True)
class AdaptiveOptions:
    """Parameters of the model.

    Attributes:
        basis: Of all outputs.
        samples: Number of points to which a demonstration is resampled.
        regression: See there.
        correction: See there.
        relevance: Of how the dimensions of the condition are judged.
        prior: Of the spread of motions about their predictions.
        repeatability: Variance of a motion about a correction at its condition, relative to the spread [-].
        most: Demonstrations kept; beyond it those of near conditions are averaged.

    Raises:
        OutOfRange: One is not what it can be.
    """

    basis: GaussianBasis = _FINE_BASIS
    samples: int = 75
    regression: RegressionOptions = field(default_factory=RegressionOptions)
    correction: CorrectionOptions = field(default_factory=CorrectionOptions)
    relevance: RelevanceOptions = field(default_factory=RelevanceOptions)
    prior: SpreadPrior = field(default_factory=SpreadPrior)
    repeatability: float = 0.05
    most: int = 1000

    def __post_init__(self) -> None:
        check_options(
            self,
            basis=GaussianBasis,
            samples=at_least(2),
            regression=RegressionOptions,
            correction=CorrectionOptions,
            relevance=RelevanceOptions,
            prior=SpreadPrior,
            repeatability=NOT_NEGATIVE,
            most=at_least(1),
        )


@dataclass(frozen=True, eq=False)
class AdaptiveProMP:
    """Demonstrations and corrections, see the module.

    Attributes:
        encoding: Between demonstrations and vectors.
        corrections: Of the demonstrations' regression, which they hold.
        spread: Of motions about their predictions.
        options: Parameters.
    """

    encoding: Encoding
    corrections: Corrections
    spread: Spread
    options: AdaptiveOptions

    @classmethod
    def fit(cls, demonstrations: Sequence[Demonstration], options: AdaptiveOptions | None = None) -> Self:
        """The model of demonstrations, none newer than another.

        They keep their own tempo: aligning those of one condition in time predicts no better.

        Raises:
            TooFewDemonstrations: There is none.
            PartialDemonstration: One speaks of a part of its motion only.
            WrongShape: Two conditions differ in dimension.
            OpeningMismatch: The gripper takes part in some of them only.
        """
        check_demonstrations(demonstrations)
        options = options or AdaptiveOptions()
        extent = _extent(demonstrations)
        rotation, shown = reference_rotation(demonstrations), shown_in(demonstrations)
        plain = Encoding(options.basis, options.samples, rotation, anchor=None, shown=shown)
        starts = np.array([plain.start(d.situation) for d in demonstrations])
        encoding = replace(plain, anchor=Anchor.of(starts, extent))
        scale = ConditionScale.of(demonstrations, extent)
        conditions = frozen([d.condition for d in demonstrations])
        vectors = frozen([encoding.encode(d) for d in demonstrations])
        return cls.of_vectors(encoding, scale, conditions, vectors, extent=extent, options=options)

    @classmethod
    def of_vectors(
        cls,
        encoding: Encoding,
        scale: ConditionScale,
        conditions: Array,
        vectors: Array,
        *,
        extent: float,
        options: AdaptiveOptions,
    ) -> Self:
        """The model of demonstrations that are encoded already.

        Args:
            encoding: That made the vectors.
            scale: Of the conditions.
            conditions: Shape (M, c).
            vectors: Shape (M, D).
            extent: How far the motions lead from their start [m], positive.
            options: Parameters.
        """
        conditions, vectors = condensed(conditions, vectors, options.most, scale)
        regression = Regression(scale, conditions, vectors, Kinds.of(encoding), options.regression)
        regression = relevant(regression, options.relevance)
        errors, variances = regression.left_out
        spread = spread_of(encoding, errors, variances, extent, options.prior)
        return cls(encoding, Corrections(regression, extent, options.correction), spread, options)

    def updated(self, demonstration: Demonstration) -> Self:
        """The model that has also learnt a motion newer than all others, as far as it is believed (equation (18)).

        The prediction completes one that speaks of a part of the motion only.

        Raises:
            WrongShape: Its condition has another dimension than those before.
            OpeningMismatch: The gripper takes part in it, and not in those before, or the other way round.
        """
        self._check(demonstration.condition)
        believed = in_part(self, completed(self, demonstration))
        return self.corrected(believed.situation, self.encoding.encode(believed), believed.provenance.at_s)

    def corrected(self, situation: Situation, x: Array, at_s: float | None = None) -> Self:
        """The model that has also learnt that the vector x (D,) is right in a situation.

        Args:
            situation: Where it is.
            x: See `Encoding.encode`.
            at_s: When that was so, in seconds since 1970-01-01 UTC, where it is known.
        """
        led = frozen(self._led(self._regression.at(situation.condition), situation))
        correction = Correction(situation.condition, frozen(x), at_s, led)
        return replace(self, corrections=self.corrections.added(correction))

    def undone(self) -> Self:
        """The model as it was before its newest correction.

        Raises:
            NothingToTakeBack: There is none.
        """
        if not len(self.corrections):
            raise NothingToTakeBack
        return replace(self, corrections=self.corrections.taken_back())

    def predict(self, situation: Situation, n: int = PREDICTION_POINTS) -> Prediction:
        """See `MovementModel.predict`; the prediction begins exactly at the start pose."""
        self._check(situation.condition)
        expected = self._regression.at(situation.condition)
        effect = self._effect(expected, situation)
        trajectory = self._decoder.decode(expected.mean + effect.change, situation, n)
        taught, changed = self._variances(expected, effect)
        covariances = taught * self.spread.positions(n)
        duration_variance = taught * self.spread.covariance[-1, -1]
        for scatter, differences in self._differences(effect, changed):
            covariances = covariances + scatter * _mean_square(self.encoding.positions(differences, n))
            of_duration = differences[:, -1]
            duration_variance += scatter * float(of_duration @ of_duration) / len(of_duration)
        return Prediction(
            trajectory,
            covariances,
            trajectory.duration * math.sqrt(duration_variance),
            self._known(expected, effect),
            effect.way,
        )

    def distribution(self, situation: Situation) -> MotionDistribution:
        """See `MovementModel.distribution`."""
        self._check(situation.condition)
        expected = self._regression.at(situation.condition)
        effect = self._effect(expected, situation)
        taught, changed = self._variances(expected, effect)
        covariance = taught * self.spread.covariance
        for scatter, differences in self._differences(effect, changed):
            covariance = covariance + scatter / len(differences) * (differences.T @ differences)
        mean = frozen(expected.mean + effect.change)
        return MotionDistribution(self._decoder, situation, mean, frozen(covariance))

    @cached_property
    def _decoder(self) -> Encoding:
        """The encoding, with the openings that the corrections showed."""
        held = self.corrections.held
        if self.encoding.shown is None or not held:
            return self.encoding
        return self.encoding.including(bounds_of(self.encoding.strokes(np.array([one.x for one in held]))))

    @property
    def _regression(self) -> Regression:
        return self.corrections.regression

    def _effect(self, expected: Expectation, situation: Situation) -> Effect:
        return self.corrections.effect(expected, self._led(expected, situation) if len(self.corrections) else None)

    def _led(self, expected: Expectation, situation: Situation) -> Array:
        """Where the demonstrations alone lead at equal phases, base frame, shape (P, 3) [m]."""
        outputs = self.encoding.outputs(expected.mean, situation, equal_phases(PHASES))
        return np.asarray(outputs[:, :POSITION] + situation.origin, dtype=np.float64)

    def _check(self, s: Array) -> None:
        check_dimension(s, self._regression.conditions.shape[1])

    def _variances(self, expected: Expectation, effect: Effect) -> tuple[float, float]:
        """Of what was taught, in units of the spread, and of what has changed, in units of the changes seen so far.

        What has been corrected is as uncertain as corrections scatter, less the more of them agree.
        """
        left = effect.open_share
        taught = left * self._regression.uncertainty(expected)
        if left == 1.0:
            return taught, 0.0
        repeated = self.options.repeatability * 0.5 * (1.0 + 1.0 / effect.evidence)
        scattered = self.corrections.noise / effect.evidence / self.spread.mean_square
        square = self.corrections.mean_square
        changed = left * effect.surprise / square if square > 0.0 else 0.0
        return taught + (1.0 - left) * (repeated + scattered), changed

    def _differences(self, effect: Effect, changed: float) -> list[tuple[float, Array]]:
        """Factors, and vectors (m, D) whose mean square times them is a covariance: of changes, and of other ways."""
        parts = [(changed, self.corrections.changes)] if changed > 0.0 else []
        return parts + [(probability, difference[None]) for probability, difference in effect.others]

    def _known(self, expected: Expectation, effect: Effect) -> float:
        """How much of a motion is known: 1 where it was shown or corrected, falling to 0 beyond that.

        Of two ways that are as probable as each other, nothing is known.
        """
        if self._regression.scale.unseen(expected.s) and effect.open_share == 1.0:
            return 0.0
        # A number that never varied among the demonstrations has a unit since it was corrected only.
        beyond = max(math.sqrt(expected.outside @ expected.outside), effect.beyond)
        shown = math.exp(-beyond / self.options.correction.covariance.near)
        decided = max(2.0 * effect.way.probability - 1.0, 0.0) if effect.way.count > 1 else 1.0
        return max(shown, 1.0 - effect.open_share) * decided


def _extent(demonstrations: Sequence[Demonstration]) -> float:
    """How far motions lead from their start, root mean square over the demonstrations [m]; 1 where none moves."""
    paths = [d.trajectory.positions for d in demonstrations]
    return float(np.sqrt(np.mean([np.max(np.sum((path - path[0]) ** 2, axis=1)) for path in paths]))) or 1.0


def _mean_square(paths: Array) -> Array:
    """Of paths (J, n, 3) at each time, shape (n, 3, 3)."""
    by_time = paths.transpose(1, 2, 0)
    return np.asarray(by_time @ by_time.transpose(0, 2, 1) / len(paths), dtype=np.float64)
