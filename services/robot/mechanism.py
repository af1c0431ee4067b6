"""The seam between control and a robot's geometry: what the arm asks of its kinematics."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from services.exceptions import ServiceError
from sim.pose import Pose

Array = NDArray[np.float64]


class InverseFailed(ServiceError):
    """The solver found no step from this configuration."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(f"inverse kinematics found no step ({reason}): move the robot away from its joint limits")


class Mechanism(Protocol):
    """Forward and inverse kinematics of the grasping frame.

    Attributes:
        lower: least joint positions, shape (m,).
        upper: greatest joint positions, shape (m,).
        velocity_limit: greatest joint speeds, shape (m,).
        admissible: base axes along which an operator can displace the grasping frame, 1 or 0 each, shape (3,).
    """

    lower: Array
    upper: Array
    velocity_limit: Array
    admissible: Array

    def forward(self, q: Array) -> Pose:
        """The pose of the grasping frame in the base frame at joint positions q, shape (m,)."""
        ...

    def solve_step(self, q: Array, position: Array, orientation: Array, dt: float) -> tuple[Array, Array]:
        """Move one tick towards a pose.

        Args:
            q: joint positions, shape (m,).
            position: of the grasping frame, shape (3,) [m].
            orientation: of the grasping frame, scalar first, shape (4,).
            dt: duration of the tick [s]; speeds stay within the joints' limits over it.

        Returns:
            Next joint positions and the velocities that lead there, each of shape (m,).

        Raises:
            InverseFailed: there is no step.
        """
        ...

    def solve(self, position: Array, orientation: Array, seeds: Sequence[Array], rng: np.random.Generator) -> Array:
        """Joint positions for a pose, shape (m,).

        Args:
            position: of the grasping frame, shape (3,) [m].
            orientation: of the grasping frame, scalar first, shape (4,).
            seeds: configurations to start a search from, each of shape (m,).
            rng: of further starts.

        Raises:
            ServiceError: there are none.
        """
        ...

    def self_distance(self, q: Array) -> float:
        """The smallest distance between two parts of the robot at joint positions q, shape (m,) [m]."""
        ...
