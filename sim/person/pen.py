"""A person's hand that drags: a mouse or a pen on a pad, its depth on a wheel.

It drags across and upwards, rolls the wheel by whole notches, and holds Shift to turn instead. Where the desk ends the
pen is lifted and brought back.
"""

import math
from collections import deque
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_REMEMBERED = 2.0  # [s]
_LAG = 0.1  # [s] of a hand on its way to a speed
_EAGERNESS = 3.0  # [1/s] share of what is left that is dragged in a second
_FASTEST = 0.25  # [m/s]
_FASTEST_TURN = 0.8  # [rad/s]
_NOTCHES = 0.12  # [s] between two of the wheel
_TAKEN_BACK = 0.6  # [s] before which nobody takes a notch back: they have not seen yet what it did
_CONTENT_TURN = 0.12  # [rad] that is left as it is
_TURNS_WITHIN = 0.03  # [m] nobody turns before they are there
_LIFTED = 0.35  # [s] for bringing a pen back
_WAYS = np.array([False, True, True, False, True, True])  # that are dragged; the others are on the wheel


@dataclass(frozen=True)
class Pad:
    """What a person drags on.

    Attributes:
        notch: Of the wheel [m].
        turn_notch: Of the wheel with Shift [rad].
        room: Dragged so far from where the pen came down it has to be lifted [m].
        turn_room: The same of a turn [rad].
    """

    notch: float
    turn_notch: float
    room: float
    turn_room: float


class Dragged(NamedTuple):
    """What the pad has counted.

    Attributes:
        far: Without end, along x, y, z and about them, shape (6,) [m, rad].
        down: The pen is on it.
    """

    far: Array
    down: bool


class Pen:
    """Drags towards what is left to be done.

    Args:
        pad: That it drags on.
    """

    def __init__(self, pad: Pad) -> None:
        self._pad = pad
        self._notches = np.array([pad.notch, 0.0, 0.0, pad.turn_notch, 0.0, 0.0])
        self._far = np.zeros(6)
        self._speed = np.zeros(6)
        self._down_at = np.zeros(6)
        self._dragged: deque[tuple[float, Array]] = deque()
        self._rolled = self._lifted = -math.inf
        self._rolled_by = np.zeros(6)
        self._down = False
        self._time: float | None = None

    def rest(self) -> Dragged:
        """Lift it."""
        self._down = False
        self._speed = np.zeros(6)
        self._dragged.clear()
        self._time = None
        return Dragged(self._far, self._down)

    def act(self, time: float, left: Array) -> Dragged:
        """Drag.

        Args:
            time: Of any clock that does not go back [s].
            left: By how much what is led should go on, shape (6,) [m, rad].
        """
        dt = time - self._time if self._time is not None else 0.0
        self._time = time
        if not self._down:
            self._put_down(time)
        elif self._at_the_end():
            self._down, self._lifted, self._speed = False, time, np.zeros(6)
        else:
            self._drag(left, time, dt)
        self._dragged.append((time, self._far))
        while self._dragged[0][0] < time - _REMEMBERED:
            self._dragged.popleft()
        return Dragged(self._far, self._down)

    def expected(self, value: Array, since: float, *, decays: bool) -> Array:
        """Where what is led should be now; see `Fingers.expected`. What is held by a pen does not decay."""
        del decays
        before = next((far for time, far in reversed(self._dragged) if time <= since), None)
        if before is None:
            before = self._dragged[0][1] if self._dragged else self._far
        return np.asarray(value + self._far - before, dtype=np.float64)

    def _put_down(self, time: float) -> None:
        if time - self._lifted >= _LIFTED:
            self._down, self._down_at = True, self._far

    def _at_the_end(self) -> bool:
        away = np.where(_WAYS, np.abs(self._far - self._down_at), 0.0)
        return bool(np.max(away[:3]) > self._pad.room or np.max(away[3:]) > self._pad.turn_room)

    def _drag(self, left: Array, time: float, dt: float) -> None:
        """With or without Shift, never both at once."""
        turns = np.linalg.norm(left[:3]) < _TURNS_WITHIN and np.max(np.abs(left[3:])) > _CONTENT_TURN
        meant = np.concatenate([np.zeros(3), left[3:]] if turns else [left[:3], np.zeros(3)])
        goal = _EAGERNESS * np.where(_WAYS, meant, 0.0)
        goal = np.concatenate([_shortened(goal[:3], _FASTEST), _shortened(goal[3:], _FASTEST_TURN)])
        self._speed = self._speed + (goal - self._speed) * (1.0 - math.exp(-dt / _LAG))
        self._far = self._far + dt * self._speed
        by = np.where(~_WAYS & (np.abs(meant) > 0.6 * self._notches), np.sign(meant) * self._notches, 0.0)
        waits = _TAKEN_BACK if np.any(by * self._rolled_by < 0.0) else _NOTCHES
        if by.any() and time - self._rolled >= waits:
            self._rolled, self._rolled_by = time, by
            self._far = self._far + by


def _shortened(vector: Array, length: float) -> Array:
    norm = math.sqrt(vector @ vector)
    return vector if norm <= length else np.asarray(vector * (length / norm), dtype=np.float64)
