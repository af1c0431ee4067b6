"""How a part of the hand moves: smoothly, no faster than a person, trembling; an arm by metres, a wrist by radians."""

import math
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_AGILITY = 8.0  # [rad/s] of the critically damped movement towards a goal
_PERSISTENCE = 1.0  # [1/s] how fast a seen error is pushed away
_TREMOR_TIME = 0.4  # [s] of the tremor's correlation

DELAY = 2.0 / _AGILITY
"""By which a limb is behind a goal that moves evenly [s]."""


@dataclass(frozen=True)
class Ability:
    """What a limb can do; its unit u is the metre or the radian.

    Attributes:
        speed: At most [u/s].
        push: Furthest that it aims beyond what it wants [u].
        tremor: Standard deviation on each axis [u].
    """

    speed: float
    push: float
    tremor: float


class Limb:
    """Three coordinates that follow what is wanted, each sight anew.

    Args:
        ability: Of the limb.
        rng: Of its tremor.
    """

    def __init__(self, ability: Ability, rng: np.random.Generator) -> None:
        self._ability = ability
        self._rng = rng
        self._tremor = np.zeros(3)
        self.rest(np.zeros(3))

    def rest(self, position: Array) -> None:
        """Stand still at a position, shape (3,) [u], with no error in mind."""
        self.position = position
        self._velocity = np.zeros(3)
        self._goal_offset = np.zeros(3)

    def move(self, wanted: Array, error: Array, dt: float) -> None:
        """Go on towards what is wanted, and beyond it for as long as an error is seen.

        Args:
            wanted: Where the limb should be, shape (3,) [u].
            error: Of the robot that it moves, shape (3,) [u].
            dt: Since the sight before [s].
        """
        self._goal_offset = _shortened(self._goal_offset + _PERSISTENCE * dt * error, self._ability.push)
        self._follow(wanted + self._goal_offset + self._trembled(dt), dt)

    def _trembled(self, dt: float) -> Array:
        """An Ornstein-Uhlenbeck process: what is left of stillness."""
        kept = math.exp(-dt / _TREMOR_TIME)
        fresh = math.sqrt(1.0 - kept * kept) * self._ability.tremor
        self._tremor = kept * self._tremor + fresh * self._rng.standard_normal(3)
        return self._tremor

    def _follow(self, goal: Array, dt: float) -> None:
        """A critically damped movement to the goal, at most at its speed; exact for a goal that rests."""
        away, decay, speed = self.position - goal, math.exp(-_AGILITY * dt), self._ability.speed
        slope = self._velocity + _AGILITY * away
        position = goal + (away + slope * dt) * decay
        self._velocity = _shortened((self._velocity - _AGILITY * slope * dt) * decay, speed)
        self.position = self.position + _shortened(position - self.position, speed * dt)


def _shortened(vector: Array, length: float) -> Array:
    norm = math.sqrt(vector @ vector)
    return vector if norm <= length else np.asarray(vector * (length / norm), dtype=np.float64)
