"""The seam between a movement model and whoever uses it."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from typing import Protocol, Self

from lfd.arrays import Array, checked
from lfd.bounds import FRACTION, check_number
from lfd.exceptions import OutOfRange
from lfd.models.distribution import MotionDistribution
from lfd.motion.demonstration import Demonstration, Situation
from lfd.motion.part import WHOLE
from lfd.motion.refinement import joined, refine
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory


@dataclass(frozen=True)
class Way:
    """Which of several ways a motion takes, and how sure that is.

    Attributes:
        index: Of the way, from 0 in the order in which they were taught.
        count: How many ways are known.
        probability: Of this one being the right one in the situation, 1 where there is only one.
    """

    index: int = 0
    count: int = 1
    probability: float = 1.0


ONLY_WAY = Way()


@dataclass(frozen=True, eq=False)
class Prediction:
    """A motion that the model expects to reach the object, and how sure it is (the predictive mean and covariance).

    Attributes:
        trajectory: In the base frame, n points.
        position_covariances: Of each point in the base frame, shape (n, 3, 3) [m^2].
        duration_std: Standard deviation of the duration [s].
        known: How much of the motion was shown or corrected there, from 1, all of it, to 0, nothing: ask to be shown.
        way: Which of several ways it takes, and how sure that is.

    Raises:
        WrongShape: There are not as many covariances as points.
        NotFinite: A number is NaN or infinite.
        OutOfRange: The duration's deviation is negative, or what is known no fraction.
    """

    trajectory: Trajectory
    position_covariances: Array
    duration_std: float
    known: float = 1.0
    way: Way = ONLY_WAY

    def __post_init__(self) -> None:
        shape = (self.trajectory.n_points, 3, 3)
        covariances = checked("position_covariances", self.position_covariances, shape)
        object.__setattr__(self, "position_covariances", covariances)
        if not self.duration_std >= 0.0:
            raise OutOfRange("duration_std", self.duration_std, "zero or more")
        check_number("known", self.known, FRACTION)


class MovementModel(Protocol):
    """A model of motions over a condition (contextual movement primitive).

    A value: an update returns a new model and leaves the old one as it was.
    """

    @classmethod
    def fit(cls, demonstrations: Sequence[Demonstration]) -> Self:
        """A model of demonstrations, at least one, all as old as each other.

        Raises:
            TooFewDemonstrations: There is none.
            PartialDemonstration: One speaks of a part of its motion only.
            WrongShape: Two conditions differ in dimension.
            OpeningMismatch: The gripper takes part in some of them only.
        """
        ...

    def updated(self, demonstration: Demonstration) -> Self:
        """The model that has also learnt `demonstration`, the motion that a refinement led to.

        How far it moves the prediction at its condition, its provenance's confidence says; of which part, its part.

        Raises:
            WrongShape: Its condition has another dimension than those before.
            OpeningMismatch: The gripper takes part in it, and not in those before, or the other way round.
        """
        ...

    def predict(self, situation: Situation, n: int = PREDICTION_POINTS) -> Prediction:
        """The motion for a situation.

        Args:
            situation: Condition, origin and start pose, all in the frame of the demonstrations.
            n: Number of points, at least 2, at equal times.

        Raises:
            WrongShape: The condition has another dimension than those of the demonstrations.
            TooFewPoints: n is less than 2.
        """
        ...

    def distribution(self, situation: Situation) -> MotionDistribution:
        """Everything the model expects for a situation: to sample, differentiate, lead through via-points, blend.

        Args:
            situation: See `predict`.

        Raises:
            WrongShape: The condition has another dimension than those of the demonstrations.
        """
        ...


def completed(model: MovementModel, demonstration: Demonstration) -> Demonstration:
    """The demonstration with the rest of its motion as the model predicts it: see `joined`.

    Args:
        model: That the demonstration corrects, before it has learnt it.
        demonstration: Of any part of a motion.

    Returns:
        A demonstration of the whole motion; the same one where it is that already.
    """
    if demonstration.part == WHOLE:
        return demonstration
    predicted = model.predict(demonstration.situation, demonstration.trajectory.n_points).trajectory
    whole = joined(predicted, demonstration.trajectory, demonstration.part)
    return replace(demonstration, trajectory=whole, part=WHOLE)


def in_part(model: MovementModel, demonstration: Demonstration) -> Demonstration:
    """The demonstration as far as it is believed: equation (18), from what the model predicts in its situation.

    For a model that has no other use for a confidence. Whole belief leaves the demonstration as it is.

    Args:
        model: That the demonstration corrects, before it has learnt it.
        demonstration: Of any confidence.

    Returns:
        A demonstration to be believed whole.
    """
    alpha = demonstration.provenance.confidence
    if alpha == 1.0:
        return demonstration
    given = demonstration.trajectory
    predicted = model.predict(demonstration.situation).trajectory
    return replace(
        demonstration,
        trajectory=refine(predicted, given, alpha, given.n_points),
        provenance=replace(demonstration.provenance, confidence=1.0),
    )
