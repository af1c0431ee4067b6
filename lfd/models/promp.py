"""The thesis' model: probabilistic movement primitives, conditioned on where the object is."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from lfd.arrays import Array
from lfd.bounds import NOT_NEGATIVE, POSITIVE, SHARE, at_least, check_options
from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis
from lfd.models.distribution import MotionDistribution
from lfd.models.encoding import Encoding, reference_rotation, shown_in
from lfd.models.gaussian import JointGaussian, condition, welford
from lfd.models.model import Prediction, completed, in_part
from lfd.motion.alignment import Selection, align
from lfd.motion.demonstration import Demonstration, Situation, check_demonstrations, check_dimension
from lfd.motion.trajectory import PREDICTION_POINTS

CONDITION_SCALE = 10.0  # the thesis' factor on the condition

_BASIS = GaussianBasis(count=10, width=0.1)


@dataclass(frozen=True)
class PrompOptions:
    """The thesis' parameters.

    Attributes:
        basis: N = 10 functions of width 0.1.
        samples: n, the number of points to which a demonstration is resampled.
        conditioning_noise: Diagonal of Sigma_n in equation (10), for the condition times 10. The text says 0.03, its
            implementation used 0.1.
        observation_std: sigma of equation (13) [m].
        selection: Of the demonstrations of a condition. The thesis' is `Selection.SIMILAR_PAIR`.
        kept: What an older motion still counts after an update; 1 is Welford's method, as in the thesis.
        anchored: Begin predictions at the start pose, see `Encoding`. The thesis does not.

    Raises:
        OutOfRange: There are fewer than 2 samples, the conditioning noise is not positive, the observation's deviation
            negative, `kept` not above 0 and at most 1, or an option of another type.
    """

    basis: GaussianBasis = _BASIS
    samples: int = 10
    conditioning_noise: float = 0.03
    observation_std: float = 0.01
    selection: Selection = Selection.ALL
    kept: float = 1.0
    anchored: bool = False

    def __post_init__(self) -> None:
        check_options(
            self,
            basis=GaussianBasis,
            samples=at_least(2),
            conditioning_noise=POSITIVE,
            observation_std=NOT_NEGATIVE,
            selection=Selection,
            kept=SHARE,
            anchored=bool,
        )


@dataclass(frozen=True, eq=False)
class ConditionedProMP:
    """Equations (1) to (13), (19) and (20).

    The thesis fits one model per output. Here one Gaussian is joint over all outputs: the mean is the same, as each
    row of the gain of equation (8) depends on its own output only, and the covariance between x, y and z comes with
    it. Orientation and duration: see `Encoding`.

    Attributes:
        encoding: Between demonstrations and weights.
        joint: Over x = [w, 10 s].
        options: Parameters.
    """

    encoding: Encoding
    joint: JointGaussian
    options: PrompOptions

    @classmethod
    def fit(cls, demonstrations: Sequence[Demonstration], options: PrompOptions | None = None) -> Self:
        """The model of demonstrations, those of one condition aligned in time: equations (1) to (7).

        Args:
            demonstrations: At least one, of conditions (contexts) of one dimension.
            options: The thesis', where none are given.

        Raises:
            TooFewDemonstrations: There is none.
            PartialDemonstration: One speaks of a part of its motion only.
            WrongShape: Two conditions differ in dimension.
            OpeningMismatch: The gripper takes part in some of them only.
        """
        check_demonstrations(demonstrations)
        options = options or PrompOptions()
        anchor = Anchor.straight() if options.anchored else None
        rotation, shown = reference_rotation(demonstrations), shown_in(demonstrations)
        encoding = Encoding(options.basis, options.samples, rotation, anchor, shown)
        aligned = align(demonstrations, selection=options.selection)
        samples = np.array([_sample(encoding, d) for d in aligned])
        return cls(encoding, JointGaussian.fit(samples), options)

    def updated(self, demonstration: Demonstration) -> Self:
        """The model after one step of Welford's method: the new motion counts as much as each earlier one.

        One of a part of the motion is completed by the prediction first, and one that is believed in part moved towards
        it, by equation (18).

        Args:
            demonstration: The newer motion (a correction, incremental learning).

        Raises:
            WrongShape: Its condition has another dimension than those before.
            OpeningMismatch: The gripper takes part in it, and not in those before, or the other way round.
        """
        self._check(demonstration.condition)
        sample = _sample(self.encoding, in_part(self, completed(self, demonstration)))
        joint = welford(self.joint, sample, self.options.kept)
        return replace(self, encoding=self.encoding.including(shown_in([demonstration])), joint=joint)

    def predict(self, situation: Situation, n: int = PREDICTION_POINTS) -> Prediction:
        """Equations (12) and (13), see `MovementModel.predict`.

        Args:
            situation: Condition and origin; the start pose, too, if anchored.
            n: Number of points, at least 2.

        Raises:
            WrongShape: The condition has another dimension than those of the demonstrations.
            TooFewPoints: n is less than 2.
        """
        motion = self.distribution(situation)
        return Prediction(motion.trajectory(n), motion.position_covariances(n), motion.duration_std)

    def distribution(self, situation: Situation) -> MotionDistribution:
        """Equations (8) to (11): the Gaussian of the weights given the situation's condition.

        Raises:
            WrongShape: The condition has another dimension than those of the demonstrations.
        """
        self._check(situation.condition)
        s = CONDITION_SCALE * situation.condition
        given = condition(self.joint, s, self.options.conditioning_noise)
        return MotionDistribution(
            self.encoding, situation, given.mean, given.covariance, noise_std=self.options.observation_std
        )

    def _check(self, s: Array) -> None:
        check_dimension(s, len(self.joint.mean) - self.encoding.dimension)


def _sample(encoding: Encoding, demonstration: Demonstration) -> Array:
    return np.append(encoding.encode(demonstration), CONDITION_SCALE * demonstration.condition)
