"""A linear operator, for questions about the loop that a hand closes with the robot: delay, second order, one gain."""

from __future__ import annotations

from collections import deque

import numpy as np
from numpy.typing import NDArray

from sim.person.attention import REACTION

Array = NDArray[np.float64]

AGILITY = 8.0  # [rad/s] of the critically damped movement, that of `sim.person.hand`


class Operator:
    """Moves the stylus where it should be, and pushes away what is seen to be missing.

    With the goal g, what is known w and the error e that was seen one reaction time ago:

        dg/dt = persistence e,    d2x/dt2 = AGILITY^2 (w + g - x) - 2 AGILITY dx/dt

    Args:
        persistence: how fast a seen error is pushed away [1/s].
        period: between two calls of `move` [s].
    """

    def __init__(self, persistence: float, period: float) -> None:
        self._persistence = persistence
        self._period = period
        self._seen: deque[Array] = deque([np.zeros(3)] * round(REACTION / period))
        self._goal = np.zeros(3)
        self._position = np.zeros(3)
        self._velocity = np.zeros(3)

    def move(self, known: Array, error: Array) -> Array:
        """Go on by one period.

        Args:
            known: displacement that the operator knows to be needed, shape (3,) [m].
            error: from the robot to where it should be, as the screen shows it now, shape (3,) [m].

        Returns:
            The displacement of the stylus, shape (3,) [m].
        """
        self._seen.append(error)
        self._goal = self._goal + self._period * self._persistence * self._seen.popleft()
        pull = AGILITY**2 * (known + self._goal - self._position) - 2.0 * AGILITY * self._velocity
        self._velocity = self._velocity + self._period * pull
        self._position = self._position + self._period * self._velocity
        return self._position
