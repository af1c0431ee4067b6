"""How far a motion leads away from another one."""

from typing import NamedTuple

import numpy as np

from lfd.distances import squared_distances
from lfd.motion.part import WHOLE, Part
from lfd.motion.trajectory import Trajectory


class Departure(NamedTuple):
    """Distances of a motion's points from the way of another one, whatever their tempo.

    Attributes:
        mean: Over the points [m].
        most: Of the farthest [m].
    """

    mean: float
    most: float

    @classmethod
    def of(cls, motion: Trajectory, other: Trajectory, part: Part = WHOLE) -> "Departure":
        """How far a motion leads away from another one: each point from the nearest of the other's.

        Args:
            motion: That leads away.
            other: Of as many points as tell its way.
            part: Phases of `motion` that count.
        """
        first, last = part
        counted = motion.positions[(motion.phases >= first) & (motion.phases <= last)]
        if not len(counted):  # a part between two points
            counted = motion.positions[[np.argmin(np.abs(motion.phases - (first + last) / 2.0))]]
        distances = np.sqrt(np.min(squared_distances(counted, other.positions), axis=1))
        return cls(float(np.mean(distances)), float(np.max(distances)))
