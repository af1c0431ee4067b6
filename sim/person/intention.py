"""What an operator means to change in a motion: planned once, from what stands in the way."""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.interpolation import covered_shares, numbers_at, through
from sim.person.imagination import departure
from sim.pose import Pose
from sim.rotations import rotated, rotation_to
from sim.tasks.scene import Corridor

Array = NDArray[np.float64]


_IN_TIME = 0.06  # of a motion's progress by which the gripper may move earlier or later than it is meant to
_THERE = 0.05  # of the way between two way-points, before the second, at which the robot is seen to be there


@dataclass(frozen=True, eq=False)
class Intention:
    """A displacement and a rotation for every progress of a prediction, and what the gripper is to do.

    Attributes:
        positions: What the robot would do, at equal steps of progress, shape (n, 3) [m].
        orientations: The same, shape (n, 4).
        displacements: From it to where the operator wants the robot, shape (n, 3) [m].
        rotations: From it to how the operator wants it turned, rotation vectors in base axes, shape (n, 3) [rad].
        openings: That they want of the gripper, shape (n,) [m], not a number where they leave it to the robot; None
            where they leave all of it.
    """

    positions: Array
    orientations: Array
    displacements: Array
    rotations: Array
    openings: Array | None = None

    def opening(self, progress: float) -> float | None:
        """The opening wanted at a progress from 0 to 1 [m]; None where it is left to the robot."""
        if self.openings is None:
            return None
        wanted = float(self.openings[int(min(max(progress, 0.0), 1.0) * (len(self.openings) - 1))])
        return None if np.isnan(wanted) else wanted

    def displacement(self, progress: float) -> Array:
        """The displacement wanted at a progress from 0 to 1, shape (3,) [m]."""
        return _at(self.displacements, progress)

    def rotation(self, progress: float) -> Array:
        """The rotation wanted at a progress from 0 to 1, shape (3,) [rad]."""
        return _at(self.rotations, progress)

    def predicted(self, progress: float) -> Pose:
        """Where the robot would be at a progress from 0 to 1."""
        orientation = _at(self.orientations, progress)
        return Pose(_at(self.positions, progress), orientation / np.linalg.norm(orientation))

    def pose(self, progress: float) -> Pose:
        """Where the operator wants the robot at a progress from 0 to 1."""
        predicted = self.predicted(progress)
        orientation = rotated(predicted.orientation, self.rotation(progress))
        return Pose(predicted.position + self.displacement(progress), orientation)


def plan(
    positions: Array,
    orientations: Array,
    safe: Corridor,
    known: Sequence[Corridor],
    exaggeration: float = 1.0,
    *,
    opening: Array | None = None,
) -> Intention:
    """Plan the correction that leads a prediction along a safe way.

    The operator recognises which of the ways that they know the robot means to take, and thereby which way-point it
    will be at when; there they want it as the safe way's point of the same number is, in place and orientation. So a
    prediction that takes the safe way already is left alone whatever its timing.

    Args:
        positions: Of the predicted grasping frame at equal steps of progress, shape (n, 3) [m].
        orientations: The same, shape (n, 4); neighbours in one hemisphere.
        safe: Way-points from the start to the object; they turn by a few degrees only, so that their quaternions are
            interpolated like positions.
        known: Ways that the robot may have learnt.
        exaggeration: Of the correction; 1 is natural.
        opening: Of the predicted gripper, shape (n,) [m]; None where it takes no part.
    """
    recognised = min(known, key=lambda way: departure(way, positions))
    numbers = numbers_at(recognised.positions, covered_shares(positions))
    turned = through(safe.orientations, numbers)
    turned /= np.linalg.norm(turned, axis=1, keepdims=True)
    return Intention(
        positions,
        orientations,
        exaggeration * (through(safe.positions, numbers) - positions),
        exaggeration * rotation_to(orientations, turned),
        None if opening is None or safe.openings is None else _grasping(opening, safe.openings, numbers),
    )


def _grasping(predicted: Array, meant: Array, numbers: Array) -> Array | None:
    """What the gripper is asked for, from when on it would not do by itself what it is meant to; None for nothing.

    Args:
        predicted: Its opening, shape (n,) [m].
        meant: When it leaves each way-point, shape (k,) [m].
        numbers: Of the way-points where the robot will be, shape (n,).
    """
    wanted = meant[np.minimum((numbers + _THERE).astype(int), len(meant) - 1)]
    closes = 0.5 * float(meant.max())
    due, comes = (np.flatnonzero(np.diff(one > closes)) for one in (wanted, predicted))
    if len(due) == len(comes) and np.all(np.abs(due - comes) <= _IN_TIME * len(predicted)):
        return None
    wrong = np.flatnonzero((wanted > closes) != (predicted > closes))
    return np.where(np.arange(len(wanted)) < wrong[0], np.nan, wanted) if len(wrong) else None


def plan_at_equal_progress(
    positions: Array, orientations: Array, safe: Corridor, exaggeration: float = 1.0
) -> Intention:
    """Plan the correction of a motion whose tempo is not a person's to change: each moment has its place on the way.

    Args:
        positions: Of the predicted grasping frame at equal steps of progress, shape (n, 3) [m].
        orientations: The same, shape (n, 4); they are left as they are.
        safe: Way-points at equal steps of progress.
        exaggeration: Of the displacement; 1 is natural.
    """
    wanted = through(safe.positions, np.linspace(0.0, len(safe.positions) - 1.0, len(positions)))
    return Intention(positions, orientations, exaggeration * (wanted - positions), np.zeros_like(positions))


def _at(points: Array, progress: float) -> Array:
    place = min(max(progress, 0.0), 1.0) * (len(points) - 1)
    before = min(int(place), len(points) - 2)
    share = place - before
    return np.asarray((1.0 - share) * points[before] + share * points[before + 1], dtype=np.float64)
