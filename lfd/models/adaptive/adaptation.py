"""The default model: one correction is enough.

A prediction is what the demonstrations say (`lfd.models.adaptive.regression`) plus what the corrections changed
(`lfd.models.adaptive.correction`), both in the space of start-anchored weights of all outputs (`lfd.models.encoding`).
Averaging, as in equations (19) and (20), leaves most of the error after one correction.
"""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from typing import Self

import numpy as np

from lfd.arrays import Array, frozen
from lfd.exceptions import NothingToTakeBack
from lfd.models.adaptive.condensation import condensed
from lfd.models.adaptive.correction import CorrectionOptions, Corrections, Effect
from lfd.models.adaptive.regression import Expectation, Regression, RegressionOptions
from lfd.models.adaptive.spread import Spread, SpreadPrior, spread_of
from lfd.models.basis import GaussianBasis
from lfd.models.distribution import POSITION, MotionDistribution
from lfd.models.encoding import OUTPUTS, Encoding, reference_rotation
from lfd.models.model import Prediction
from lfd.motion.alignment import align
from lfd.motion.demonstration import Demonstration, Situation, check_demonstrations, check_dimension
from lfd.motion.trajectory import PREDICTION_POINTS

_FINE_BASIS = GaussianBasis(count=40, width=0.0256)  # finer than the thesis', to follow a correction closely
_MEASURED = 25  # phases at which positions are compared


@dataclass(frozen=True)
class AdaptiveOptions:
    """Parameters of the model.

    Attributes:
        basis: Of all outputs.
        samples: Number of points to which a demonstration is resampled.
        regression: See there.
        correction: See there.
        prior: Of the spread of motions about their predictions.
        repeatability: Variance of a motion about a correction at its condition, relative to the spread [-].
        most: Demonstrations kept; beyond it those of near conditions are averaged.
    """

    basis: GaussianBasis = _FINE_BASIS
    samples: int = 75
    regression: RegressionOptions = field(default_factory=RegressionOptions)
    correction: CorrectionOptions = field(default_factory=CorrectionOptions)
    prior: SpreadPrior = field(default_factory=SpreadPrior)
    repeatability: float = 0.05
    most: int = 1000


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
        """The model of demonstrations, those of one condition aligned in time and none newer than another.

        Raises:
            TooFewDemonstrations: There is none.
            WrongShape: Two conditions differ in dimension.
        """
        check_demonstrations(demonstrations)
        options = options or AdaptiveOptions()
        encoding = Encoding(options.basis, options.samples, reference_rotation(demonstrations), anchored=True)
        extent = _extent(demonstrations)
        aligned = align(demonstrations, options.regression.same * extent)
        conditions = frozen([d.condition for d in demonstrations])
        return cls.of_vectors(encoding, conditions, frozen([encoding.encode(d) for d in aligned]), extent, options)

    @classmethod
    def of_vectors(
        cls, encoding: Encoding, conditions: Array, vectors: Array, extent: float, options: AdaptiveOptions
    ) -> Self:
        """The model of demonstrations that are encoded already.

        Args:
            encoding: That made the vectors.
            conditions: Shape (M, c).
            vectors: Shape (M, D).
            extent: How far the motions lead from their start [m], positive.
            options: Parameters.
        """
        conditions, vectors = condensed(conditions, vectors, options.most)
        regression = Regression(conditions, vectors, _measure(encoding), extent, options.regression)
        errors, variances = regression.left_out
        spread = spread_of(encoding, errors, variances, extent, options.prior)
        return cls(encoding, Corrections.none(regression, options.correction), spread, options)

    def updated(self, demonstration: Demonstration) -> Self:
        """The model that has also learnt a motion newer than all others.

        Raises:
            WrongShape: Its condition has another dimension than those before.
        """
        self._check(demonstration.condition)
        return self.corrected(demonstration.condition, self.encoding.encode(demonstration))

    def corrected(self, s: Array, x: Array) -> Self:
        """The model that has also learnt that the vector x (D,) is right at the condition s (c,)."""
        return replace(self, corrections=self.corrections.added(self._regression.at(s), x).tested())

    def undone(self) -> Self:
        """The model without its newest correction.

        Raises:
            NothingToTakeBack: There is none.
        """
        if not len(self.corrections):
            raise NothingToTakeBack
        return replace(self, corrections=self.corrections.without(-1).tested())

    def predict(self, situation: Situation, n: int = PREDICTION_POINTS) -> Prediction:
        """See `MovementModel.predict`; the prediction begins exactly at the start pose."""
        self._check(situation.condition)
        expected = self._regression.at(situation.condition)
        effect = self.corrections.effect(expected)
        trajectory = self.encoding.decode(expected.mean + effect.change, situation, n)
        taught, changed = self._variances(expected, effect)
        covariances = taught * self.spread.positions(n)
        duration_variance = taught * self.spread.covariance[-1, -1]
        if changed > 0.0:
            changes = self.corrections.changes
            covariances = covariances + changed * _mean_square(self.encoding.positions(changes, n))
            duration_variance += changed * float(np.mean(changes[:, -1] ** 2))
        return Prediction(trajectory, covariances, trajectory.duration * float(np.sqrt(duration_variance)))

    def distribution(self, situation: Situation) -> MotionDistribution:
        """See `MovementModel.distribution`."""
        self._check(situation.condition)
        expected = self._regression.at(situation.condition)
        effect = self.corrections.effect(expected)
        taught, changed = self._variances(expected, effect)
        covariance = taught * self.spread.covariance
        if changed > 0.0:
            changes = self.corrections.changes
            covariance = covariance + changed * (changes.T @ changes) / len(changes)
        mean = frozen(expected.mean + effect.change)
        return MotionDistribution(self.encoding, situation, mean, frozen(covariance))

    @property
    def _regression(self) -> Regression:
        return self.corrections.regression

    def _check(self, s: Array) -> None:
        check_dimension(s, self._regression.conditions.shape[1])

    def _variances(self, expected: Expectation, effect: Effect) -> tuple[float, float]:
        """Of what was taught, in units of the spread, and of what has changed, in units of the changes seen so far."""
        left = effect.open_share
        taught = left * self._regression.uncertainty(expected) + (1.0 - left) * self.options.repeatability
        return taught, left * self.corrections.surprising_share


def _extent(demonstrations: Sequence[Demonstration]) -> float:
    """How far motions lead from their start, root mean square over the demonstrations [m]; 1 where none moves."""
    paths = [d.trajectory.positions for d in demonstrations]
    return float(np.sqrt(np.mean([np.max(np.sum((path - path[0]) ** 2, axis=1)) for path in paths]))) or 1.0


def _mean_square(paths: Array) -> Array:
    """Of paths (J, n, 3) at each time, shape (n, 3, 3)."""
    by_time = paths.transpose(1, 2, 0)
    return np.asarray(by_time @ by_time.transpose(0, 2, 1) / len(paths), dtype=np.float64)


def _measure(encoding: Encoding) -> Array:
    """The linear map from a vector to positions, such that its squares sum to their mean square over time [m^2]."""
    rows = encoding.rows(np.linspace(0.0, 1.0, _MEASURED)) / np.sqrt(_MEASURED)
    positions = np.kron(rows, np.eye(POSITION, OUTPUTS))
    return frozen(np.vstack([positions.T, np.zeros((1, len(positions)))]))
