"""A scene in which an arm reaches for an object."""

from __future__ import annotations

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sim.robots.catalogue import DEFAULT
from sim.robots.robot import Base, Manipulator, Robot, Stance
from sim.tasks.scene import Array, Scene, Vector


@dataclass(frozen=True, eq=False, kw_only=True)
class ReachingScene(Scene):
    """An arm reaches for an object; a place is where the object's centre stands, shape (3,) [m].

    Attributes:
        manipulator: That reaches.
        reached_radii: Of the ellipsoid around the grasping frame, along its axes, that the object's
            centre must lie in (thesis, Fig. E.2), shape (3,) [m].
        kicked_thresholds: Displacement along each axis of the base frame beyond which the object
            counts as kicked over (thesis, Appendix E), shape (3,) [m].
    """

    has_object = True

    manipulator: Manipulator = DEFAULT
    reached_radii: Array
    kicked_thresholds: Array

    @cached_property
    def stance(self) -> Stance:
        """How the manipulator stands in it."""
        return self.manipulator.stance(self.name)

    @cached_property
    def robot(self) -> Robot:
        """See `Scene.robot`."""
        return self.manipulator.standing(self.stance.base or Base())

    @property
    def posture(self) -> Array:
        """See `Scene.posture`."""
        return np.array(self.stance.posture)

    @property
    def tolerances(self) -> Vector:
        """See `Scene.tolerances`."""
        return _vector(self.reached_radii)

    @property
    def kick_limits(self) -> Vector:
        """See `Scene.kick_limits`."""
        return _vector(self.kicked_thresholds)

    def missed_by(self, end: Array, target: Array, times: float) -> float:
        """See `Scene.missed_by`; along the line to the object."""
        return float(np.linalg.norm(target - end)) * (1.0 - 1.0 / times)


def _vector(values: Array) -> Vector:
    x, y, z = values.tolist()
    return x, y, z
