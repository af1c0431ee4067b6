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


@dataclass(frozen=True, eq=False)
class Intention:
    """A displacement and a rotation for every progress of a prediction.

    Attributes:
        positions: What the robot would do, at equal steps of progress, shape (n, 3) [m].
        orientations: The same, shape (n, 4).
        displacements: From it to where the operator wants the robot, shape (n, 3) [m].
        rotations: From it to how the operator wants it turned, rotation vectors in base axes, shape (n, 3) [rad].
    """

    positions: Array
    orientations: Array
    displacements: Array
    rotations: Array

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
    positions: Array, orientations: Array, safe: Corridor, known: Sequence[Corridor], exaggeration: float = 1.0
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
    )


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
