"""The seam between control and a robot's geometry: what the arm asks of its kinematics."""

from collections.abc import Sequence
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import ServiceError
from services.robot.correction import Correction
from sim.pose import Pose

Array = NDArray[np.float64]


class InverseFailed(ServiceError):
    """The solver found no step from this configuration."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(f"inverse kinematics found no step ({reason}): move the robot away from its joint limits")


class Unreachable(ServiceError):
    """No joint configuration was found that puts the grasping frame there."""

    def __init__(self, position: Array) -> None:
        self.position = position
        place = ", ".join(f"{value:.3f}" for value in position)
        super().__init__(f"the robot cannot reach ({place}) m in that orientation: choose a pose closer to the robot")


class JointsInOtherOrder(ServiceError):
    """A robot's joints are not named from the base to the gripper."""

    def __init__(self, found: tuple[str, ...], named: tuple[str, ...]) -> None:
        self.found = found
        self.named = named
        super().__init__(f"the arm's joints are {', '.join(found)}, not {', '.join(named)}: name them in that order")


class Mechanism(Protocol):
    """Forward and inverse kinematics of the grasping frame.

    Attributes:
        lower: least joint positions, shape (m,).
        upper: greatest joint positions, shape (m,).
        velocity_limit: greatest joint speeds, shape (m,).
        acceleration_limit: greatest joint accelerations, shape (m,).
        jerk_limit: greatest joint jerks, shape (m,).
        turn_slack: by how much it may leave an orientation that it is asked for, with nothing wrong [rad].
    """

    lower: Array
    upper: Array
    velocity_limit: Array
    acceleration_limit: Array
    jerk_limit: Array
    turn_slack: float

    def forward(self, q: Array) -> Pose:
        """The pose of the grasping frame in the base frame at joint positions q, shape (m,)."""
        ...

    def admitted(self, wanted: Correction) -> Correction:
        """What the robot can follow of an operator's correction."""
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
            Unreachable: there are none.
        """
        ...

    def self_distance(self, q: Array) -> float:
        """The smallest distance between two parts of the robot at joint positions q, shape (m,) [m]."""
        ...

    def dexterity(self, q: Array) -> float:
        """How far the arm is from a posture in which it cannot move one way, at joint positions q, shape (m,).

        Returns:
            From 0, where it is stretched out or two of its axes line up, to 1.
        """
        ...
