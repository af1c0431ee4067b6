"""How long the inverse kinematics takes, step by step."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from services.process.clock import Clock
from services.robot.mechanism import Mechanism

Array = NDArray[np.float64]

STEPS_KEPT = 4096


class TimedKinematics:
    """Kinematics that remembers how long each step of the inverse took. See `Mechanism`.

    Args:
        clock: to measure with.
        kinematics: that is timed.
    """

    def __init__(self, clock: Clock, kinematics: Mechanism) -> None:
        self.lower, self.upper = kinematics.lower, kinematics.upper
        self.velocity_limit, self.admitted = kinematics.velocity_limit, kinematics.admitted
        self.acceleration_limit, self.jerk_limit = kinematics.acceleration_limit, kinematics.jerk_limit
        self.turn_slack = kinematics.turn_slack
        self.forward, self.solve, self.self_distance = kinematics.forward, kinematics.solve, kinematics.self_distance
        self.dexterity = kinematics.dexterity
        self._clock = clock
        self._solve_step = kinematics.solve_step
        self.steps_ns: deque[int] = deque(maxlen=STEPS_KEPT)

    def solve_step(self, q: Array, position: Array, orientation: Array, dt: float) -> tuple[Array, Array]:
        """As of the kinematics that is timed."""
        started = self._clock.now_ns()
        try:
            return self._solve_step(q, position, orientation, dt)
        finally:
            self.steps_ns.append(self._clock.now_ns() - started)
