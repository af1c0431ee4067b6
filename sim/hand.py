"""A scripted operator's hand and eyes: sees late, moves smoothly, trembles, and pushes until the robot is right.

The hand is an impedance about the place where it wants the stylus to be (Hogan 1985). It has no access to anything
that a person in front of the screen would not see.
"""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from sim.correction import Correction
from sim.stylus import StylusState, Vector

Array = NDArray[np.float64]

REACTION = 0.2  # [s] from seeing to acting on what was not expected
STIFFNESS = 500.0  # [N/m]
DAMPING = 15.0  # [N s/m]
SPEED = 0.25  # [m/s] at most
_AGILITY = 8.0  # [rad/s] of the critically damped movement towards a goal
_ROBOT_DELAY = 0.3  # [s] that a person learns to expect between the stylus and the robot
_LEAD = 2.0 / _AGILITY + _ROBOT_DELAY  # [s] that a practised person acts ahead of a motion they know
_PERSISTENCE = 1.0  # [1/s] how fast a seen error is pushed away
_PUSH = 0.06  # [m] furthest that the hand aims beyond what it wants
_TREMOR = 0.0015  # [m] standard deviation on each axis
_TREMOR_TIME = 0.4  # [s] of its correlation
_GRIP_TOLERANCE = 0.01  # [m] between stylus and robot at which the clutch is closed
_LONGEST_STEP = 0.05  # [s] a hand that was not asked for longer did not move meanwhile


@dataclass(frozen=True, eq=False)
class Seen:
    """What the screen shows.

    Attributes:
        progress: Of the episode, from 0 to 1.
        robot: Position of the grasping frame, shape (3,) [m].
        offset: Of the robot from its prediction, shape (3,) [m].
        stylus: Displacement of the stylus, shape (3,) [m].
    """

    progress: float
    robot: Array
    offset: Array
    stylus: Array


class Hand:
    """Holds the stylus for one episode at a time.

    Between `grip` and `release` call `observe` at about 100 Hz, and `force` at the device's own rate.

    Args:
        seed: Of the tremor.
    """

    def __init__(self, seed: int) -> None:
        self._rng = np.random.default_rng(seed)
        self._tremor = np.zeros(3)
        self._correction: Correction | None = None
        self._memory: deque[tuple[float, Seen]] = deque()
        self._goal_offset = np.zeros(3)
        self._position = np.zeros(3)
        self._velocity = np.zeros(3)
        self._target: Vector | None = None
        self._clutched = False

    @property
    def clutched(self) -> bool:
        """The stylus is where the robot is: from here on the robot may follow it."""
        return self._clutched

    def grip(self, correction: Correction, stylus: StylusState) -> None:
        """Take the stylus where it is, with a correction in mind."""
        self._correction = correction
        self._memory.clear()
        self._goal_offset = np.zeros(3)
        self._position = np.array(stylus.position)
        self._velocity = np.zeros(3)
        self._target = stylus.position
        self._clutched = False

    def release(self) -> None:
        """Let go."""
        self._correction = None
        self._target = None
        self._clutched = False

    def observe(self, time: float, seen: Seen) -> Vector | None:
        """Look at the screen and decide where the stylus should be; None while the hand is off.

        Args:
            time: Of any clock that does not go back [s].
            seen: What it shows now.
        """
        if self._correction is None:
            return None
        dt = min(time - self._memory[-1][0], _LONGEST_STEP) if self._memory else 0.0
        self._memory.append((time, seen))
        while len(self._memory) > 1 and self._memory[1][0] <= time - REACTION:
            self._memory.popleft()
        if np.linalg.norm(seen.offset - seen.stylus) < _GRIP_TOLERANCE:
            self._clutched = True
        wanted, error = self._follow(self._correction) if self._clutched else self._take_over()
        self._push_away(error, dt)
        self._move(wanted + self._goal_offset + self._trembled(dt), dt)
        x, y, z = self._position.tolist()
        self._target = (x, y, z)
        return self._target

    def force(self, stylus: StylusState) -> Vector:
        """The force on the stylus, F = K_h (target - x) - D_h v, none while the hand is off [N]."""
        target = self._target
        if target is None:
            return (0.0, 0.0, 0.0)
        (tx, ty, tz), (x, y, z), (vx, vy, vz) = target, stylus.position, stylus.velocity
        return (
            STIFFNESS * (tx - x) - DAMPING * vx,
            STIFFNESS * (ty - y) - DAMPING * vy,
            STIFFNESS * (tz - z) - DAMPING * vz,
        )

    def _take_over(self) -> tuple[Array, Array]:
        """Before the clutch closes: bring the stylus to where the robot stands."""
        _, seen = self._memory[0]
        return seen.offset, seen.offset - seen.stylus

    def _follow(self, correction: Correction) -> tuple[Array, Array]:
        """Act ahead of what is known, the way; react to what is not, where the robot really went."""
        (then, seen), (now, newest) = self._memory[0], self._memory[-1]
        pace = (newest.progress - seen.progress) / (now - then) if now > then else 0.0
        wanted = correction.displacement(newest.progress + _LEAD * pace)
        # A robot that stands still is waiting: pushing harder would only make it jump later.
        error = correction.position(seen.progress) - seen.robot if pace > 0.0 else np.zeros(3)
        return wanted, error

    def _push_away(self, error: Array, dt: float) -> None:
        self._goal_offset = _shortened(self._goal_offset + _PERSISTENCE * dt * error, _PUSH)

    def _trembled(self, dt: float) -> Array:
        """An Ornstein-Uhlenbeck process: what is left of stillness."""
        kept = math.exp(-dt / _TREMOR_TIME)
        self._tremor = kept * self._tremor + math.sqrt(1.0 - kept * kept) * _TREMOR * self._rng.standard_normal(3)
        return self._tremor

    def _move(self, goal: Array, dt: float) -> None:
        """A critically damped movement to the goal, at most at `SPEED`; exact for a goal that rests."""
        away, decay = self._position - goal, math.exp(-_AGILITY * dt)
        slope = self._velocity + _AGILITY * away
        position = goal + (away + slope * dt) * decay
        self._velocity = _shortened((self._velocity - _AGILITY * slope * dt) * decay, SPEED)
        self._position = self._position + _shortened(position - self._position, SPEED * dt)


def _shortened(vector: Array, length: float) -> Array:
    norm = float(np.linalg.norm(vector))
    return vector if norm <= length else np.asarray(vector * (length / norm), dtype=np.float64)
