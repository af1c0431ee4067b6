"""Where motions start: joint positions for a pose of the grasping frame, found once and kept."""

from functools import lru_cache

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import ServiceError
from services.robot.mechanism import Mechanism, Unreachable
from sim.pose import Pose

Array = NDArray[np.float64]

SEED = 0
"""Of the random starts of the search: a start has the same joint positions in every process."""

KEPT = 256


class StartImpossible(ServiceError):
    """No motion can start there."""

    def __init__(self, position: Array, reason: str) -> None:
        self.position = position
        self.reason = reason
        place = ", ".join(f"{value:.3f}" for value in position)
        super().__init__(f"no motion can start at ({place}) m: {reason}")


class Starts:
    """Finds joint positions for start poses, near the posture that the scene was laid out for.

    Args:
        kinematics: of the robot.
        home: the scene's own start.
        posture: joint positions near it, shape (m,).
        self_distance: that the robot keeps from itself at least [m].
    """

    def __init__(self, kinematics: Mechanism, home: Pose, posture: Array, self_distance: float) -> None:
        self.home = home
        self._kinematics = kinematics
        self._posture = posture
        self._self_distance = self_distance
        self._joints = lru_cache(maxsize=KEPT)(self._search)

    def joints(self, pose: Pose) -> Array:
        """Joint positions at a start, shape (m,), read-only.

        Raises:
            StartImpossible: the robot does not reach it, or comes too close to itself there.
        """
        return self._joints(tuple(pose.position.tolist()), tuple(pose.orientation.tolist()))

    def _search(self, position: tuple[float, ...], orientation: tuple[float, ...]) -> Array:
        place, rng = np.array(position), np.random.default_rng(SEED)
        try:
            q = self._kinematics.solve(place, np.array(orientation), [self._posture], rng)
        except Unreachable as error:
            raise StartImpossible(place, "the robot does not reach it in that orientation") from error
        distance = self._kinematics.self_distance(q)
        if distance < self._self_distance:
            reason = "the robot would touch itself" if distance <= 0.0 else "the robot would come too close to itself"
            raise StartImpossible(place, reason)
        q.flags.writeable = False
        return q
