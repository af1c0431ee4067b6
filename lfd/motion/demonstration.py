"""What a motion is predicted from, and a motion that was right there."""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from numbers import Real
from typing import Self

import numpy as np
from numpy.typing import ArrayLike

from lfd.arrays import Array, checked, checked_quaternions
from lfd.exceptions import PartialDemonstration, TooFewDemonstrations, WrongShape
from lfd.motion.opening import openings
from lfd.motion.part import WHOLE, Part, check_part
from lfd.motion.provenance import UNKNOWN, Provenance
from lfd.motion.trajectory import Trajectory


@dataclass(frozen=True, eq=False)
class Situation:
    """What is known before a motion: the query of a prediction (context and initial state).

    Attributes:
        condition: The external state s on which the motion depends (task parameter, context), of any dimension and in
            any units, shape (c,); a single number is one of one dimension.
        origin: The point that the motion is learnt relative to (equation (23)): the object; zero where there is none.
            In the base frame, shape (3,) [m].
        start_position: Of the end effector at t = 0 in the base frame, shape (3,) [m].
        start_orientation: The same, unit quaternion (w, x, y, z).

    Raises:
        WrongShape: An array has the wrong shape, or the condition is empty.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: The orientation is not a unit quaternion.
    """

    condition: Array
    origin: Array
    start_position: Array
    start_orientation: Array

    def __post_init__(self) -> None:
        object.__setattr__(self, "condition", checked_condition(self.condition))
        object.__setattr__(self, "origin", checked("origin", self.origin, (3,)))
        object.__setattr__(self, "start_position", checked("start_position", self.start_position, (3,)))
        orientation = checked_quaternions("start_orientation", self.start_orientation, (4,))
        object.__setattr__(self, "start_orientation", orientation)

    @classmethod
    def reaching(cls, object_position: Array, start_position: Array, start_orientation: Array) -> Self:
        """The situation before reaching for an object: s is the object relative to the end effector at t = 0.

        Args:
            object_position: In the base frame, shape (3,) [m].
            start_position: Of the end effector in the base frame, shape (3,) [m].
            start_orientation: The same, unit quaternion (w, x, y, z).

        Raises:
            WrongShape: An array has the wrong shape.
            NotFinite: A number is NaN or infinite.
            NotUnitQuaternion: The orientation is not a unit quaternion.
        """
        target = checked("object_position", object_position, (3,))
        start = checked("start_position", start_position, (3,))
        return cls(target - start, target, start, start_orientation)


@dataclass(frozen=True, eq=False)
class Demonstration:
    """One motion and the external state (context) that it was right for, in the robot's base frame.

    A newer one that a model is updated with is called a correction: it overrules older ones near its condition.

    The thesis multiplies the condition by 10. That is no property of the condition: it only divides the conditioning
    noise of equation (10) by 100, so it stands with that noise (`lfd.models.promp`) and not here.

    Attributes:
        trajectory: The motion of the end effector in the base frame.
        origin: See `Situation`, shape (3,) [m].
        condition: See `Situation`, shape (c,).
        provenance: Whose it is, since when, and how far it is believed.
        part: First and last phase of the trajectory, from 0 to 1, between which it says what is right: a correction
            of a part leaves the rest as predicted (`lfd.motion.refinement.joined`).

    Raises:
        WrongShape: An array has the wrong shape, or the condition is empty.
        NotFinite: A number is NaN or infinite.
        OutOfRange: A phase of the part is not from 0 to 1.
        EmptyPart: The part does not end after it begins.
    """

    trajectory: Trajectory
    origin: Array
    condition: Array
    provenance: Provenance = UNKNOWN
    part: Part = WHOLE

    def __post_init__(self) -> None:
        check_part(self.part)
        object.__setattr__(self, "origin", checked("origin", self.origin, (3,)))
        object.__setattr__(self, "condition", checked_condition(self.condition))

    @classmethod
    def reaching(cls, trajectory: Trajectory, object_position: Array, provenance: Provenance = UNKNOWN) -> Self:
        """A motion that reached an object: its condition is the object relative to the motion's first point.

        Args:
            trajectory: The motion of the end effector in the base frame.
            object_position: In the base frame, shape (3,) [m]; the motion's origin, too.
            provenance: Whose it is, since when, and how far it is believed.

        Raises:
            WrongShape: The position has the wrong shape.
            NotFinite: A number of it is NaN or infinite.
        """
        target = checked("object_position", object_position, (3,))
        return cls(trajectory, target, target - trajectory.positions[0], provenance)

    @property
    def situation(self) -> Situation:
        """What was known before the motion."""
        start = self.trajectory
        return Situation(self.condition, self.origin, start.positions[0], start.orientations[0])


def checked_condition(values: ArrayLike, name: str = "condition") -> Array:
    """A read-only copy of a condition, shape (c,) with c at least 1; a single number is a condition of one dimension.

    Args:
        values: The numbers.
        name: What it is called in an error.

    Raises:
        NotNumbers: It holds something else than numbers.
        WrongShape: It is no vector, or empty.
        NotFinite: A number is NaN or infinite.
    """
    single = isinstance(values, Real) or (isinstance(values, np.ndarray) and values.ndim == 0)
    condition = checked(name, np.reshape(values, 1) if single else values, (None,))
    if not len(condition):
        raise WrongShape(name, "(c,) with c at least 1", condition.shape)
    return condition


def check_demonstrations(demonstrations: Sequence[Demonstration]) -> None:
    """Let pass demonstrations that a model can be fitted to.

    Raises:
        TooFewDemonstrations: There is none.
        PartialDemonstration: One speaks of a part of its motion only.
        WrongShape: Two conditions differ in dimension.
        OpeningMismatch: The gripper takes part in some of them only.
    """
    if not demonstrations:
        raise TooFewDemonstrations
    for demonstration in demonstrations:
        if demonstration.part != WHOLE:
            raise PartialDemonstration(*demonstration.part)
        check_dimension(demonstration.condition, len(demonstrations[0].condition))
        openings(demonstrations[0].trajectory, demonstration.trajectory)


def check_dimension(condition: Array, dimension: int) -> None:
    """Let pass a condition (c,) of a dimension.

    Raises:
        WrongShape: It is of another one.
    """
    if len(condition) != dimension:
        raise WrongShape("condition", f"({dimension},)", condition.shape)


def relative_to_origin(trajectory: Trajectory, origin: Array) -> Trajectory:
    """The trajectory relative to a point, base axes: equation (23), whose rotation is the identity.

    Args:
        trajectory: In the base frame.
        origin: In the base frame, shape (3,) [m].
    """
    return replace(trajectory, positions=trajectory.positions - origin)


def to_base(trajectory: Trajectory, origin: Array) -> Trajectory:
    """The inverse of `relative_to_origin`: a trajectory relative to an origin (3,) [m], in the base frame again."""
    return replace(trajectory, positions=trajectory.positions + origin)
