"""Demonstrations without a simulator: a person steers through a scene's corridor, and the arm is taken to follow."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from services.offline.steering import steered
from services.robot.verdict import ellipsoid_value
from sim.pose import Pose
from sim.tasks.reaching import ReachingScene

Array = NDArray[np.float64]

POINTS = 200


def demonstrate(
    scene: ReachingScene,
    object_position: Array,
    rng: np.random.Generator | None,
    *,
    variant: str | None = None,
    start: Array | None = None,
) -> Demonstration:
    """A person's motion to an object.

    Args:
        scene: whose corridor is steered through.
        object_position: shape (3,) [m].
        rng: of the person's unsteadiness; None for a steady hand.
        variant: of the scene; its first by default.
        start: of the motion, shape (3,) [m]; the scene's by default.
    """
    begin = None if start is None else Pose(start, scene.start.orientation)
    corridor = scene.corridor(variant or scene.variants[0], object_position, begin)
    return Demonstration.reaching(steered(corridor, rng, n=POINTS), object_position)


def steady_motions(scene: ReachingScene, object_positions: Array) -> list[Demonstration]:
    """What a person with a steady hand would do for objects at those positions, shape (k, 3) [m]."""
    return [demonstrate(scene, position, None) for position in object_positions]


def object_grid(scene: ReachingScene, n: int) -> Array:
    """Object positions all over a scene's region, n along each side, shape (n n, 3) [m]."""
    (x0, y0, z), (x1, y1, _) = scene.region.lower, scene.region.upper
    x, y = np.meshgrid(np.linspace(x0, x1, n), np.linspace(y0, y1, n), indexing="ij")
    return np.column_stack([x.ravel(), y.ravel(), np.full(x.size, z)])


def reaches(trajectory: Trajectory, object_position: Array, scene: ReachingScene) -> bool:
    """Whether an object, shape (3,) [m], is in the ellipsoid of Fig. E.2 at a trajectory's end."""
    end = Pose(trajectory.positions[-1], trajectory.orientations[-1])
    return ellipsoid_value(end, object_position, scene.reached_radii) <= 1.0
