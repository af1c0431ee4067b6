"""A person steers through a corridor: the motion that every scripted demonstration begins with."""

import numpy as np

from lfd.motion.resampling import resample
from lfd.motion.trajectory import Trajectory
from sim.person.scatter import CAREFUL
from sim.person.steering import steer
from sim.tasks.scene import Corridor, Freedom

DURATION_S = 10.0
"""Of a demonstration: the thesis' time of an autonomous execution; what is grasped on the way takes more."""

POINTS = 75


def steered(
    corridor: Corridor,
    rng: np.random.Generator | None,
    freedom: Freedom | None = None,
    n: int = POINTS,
    scatter: float = CAREFUL,
) -> Trajectory:
    """A person's motion through a corridor.

    Args:
        corridor: to steer through.
        rng: of the person's unsteadiness; None for a steady hand.
        freedom: of the person; all of it by default.
        n: points of the motion.
        scatter: of the person, see `sim.person.scatter.deviation` [m].
    """
    way = steer(corridor, rng, freedom=freedom, scatter=scatter)
    return resample(Trajectory(way.positions, way.orientations, way.longer * DURATION_S, way.opening), n)
