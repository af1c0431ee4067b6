"""A person's fingers on what is pushed: keys, the sticks of a gamepad, the cap of a 3-D mouse.

Whoever has practised knows how fast the robot goes while they push, and so what they have asked for in the half second
that they cannot have seen yet: without that nobody could hit anything with a key. They press a key for a tenth of a
second at least, push a stick harder the more is left, and no cap is pushed one way without a little of another.
"""

import math
from collections import deque
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

_REMEMBERED = 1.0  # [s]
_LAG = 0.08  # [s] of a finger on its way to a deflection
_UNSTEADY = 0.05  # share of a deflection by which it is missed, standard deviation


@dataclass(frozen=True, eq=False)
class Handling:
    """How a person handles a device that is pushed, six ways: along x, y, z and about them; units are m and rad.

    Attributes:
        rate: At which what they lead moves while it is pushed all the way, shape (6,) [1/s].
        decay: At which it returns to nothing while it is not pushed, shape (6,) [1/s].
        content: What is left that they do nothing about any more, shape (6,).
        full: What is left that they push all the way for, shape (6,).
        graded: It can be pushed half the way; else a key is down or up.
        idle: Share of the way of a push that leads nowhere.
        crosstalk: Standard deviation of the share of a push that goes along each other way.
        dwell: Shortest time that a key is down or up [s].
    """

    rate: Array
    decay: Array
    content: Array
    full: Array
    graded: bool
    idle: float = 0.0
    crosstalk: float = 0.0
    dwell: float = 0.1


class Fingers:
    """Pushes towards what is left to be done.

    Args:
        handling: Of the device.
        rng: Of the unsteadiness, and of how this person's pushes go astray.
    """

    def __init__(self, handling: Handling, rng: np.random.Generator) -> None:
        self._handling = handling
        self._rng = rng
        stray = handling.crosstalk * rng.standard_normal((6, 6))
        self._astray = np.eye(6) + stray - np.diag(np.diag(stray))
        self._pushed: deque[tuple[float, float, Array]] = deque()
        self._changed = np.full(6, -math.inf)
        self._meant = np.zeros(6)
        self._time: float | None = None

    def rest(self) -> Array:
        """Let go of everything; the deflections then, shape (6,)."""
        self._meant = np.zeros(6)
        self._pushed.clear()
        self._time = None
        return np.zeros(6)

    def act(self, time: float, left: Array) -> Array:
        """Push; deflections from -1 to 1, shape (6,).

        Args:
            time: Of any clock that does not go back [s].
            left: By how much what is led should go on, shape (6,) [m, rad].
        """
        dt = time - self._time if self._time is not None else 0.0
        self._time = time
        self._meant = self._graded(left, dt) if self._handling.graded else self._pressed(left, time)
        pushed = np.clip(self._astray @ self._meant, -1.0, 1.0)
        self._pushed.append((time, dt, self._speed()))
        while self._pushed[0][0] < time - _REMEMBERED:
            self._pushed.popleft()
        return np.asarray(pushed, dtype=np.float64)

    def expected(self, value: Array, since: float, *, decays: bool) -> Array:
        """Where what is led should be now, by all that was pushed since it was at a value.

        Args:
            value: That it had, shape (6,) [m, rad].
            since: When [s].
            decays: It returns to nothing while it is not pushed.
        """
        expected = value.copy()
        for time, dt, speed in self._pushed:
            if time > since:
                expected += speed * dt
                if decays:
                    back = self._handling.decay * dt
                    expected -= np.where(speed == 0.0, np.minimum(np.maximum(expected, -back), back), 0.0)
        return expected

    def _speed(self) -> Array:
        """Of what they lead, as they know it, shape (6,) [m/s, rad/s]."""
        handling, meant = self._handling, self._meant
        felt = np.maximum(0.0, np.abs(meant) - handling.idle) / (1.0 - handling.idle)
        return handling.rate * np.sign(meant) * felt

    def _pressed(self, left: Array, time: float) -> Array:
        """Keys: down where much is left, up again where hardly anything is."""
        content, held = self._handling.content, self._meant
        keeps = (np.sign(left) == held) & (np.abs(left) > content / 3.0)
        wanted = np.where(np.abs(left) > content, np.sign(left), np.where(keeps, held, 0.0))
        changes = (wanted != held) & (time - self._changed >= self._handling.dwell)
        self._changed = np.where(changes, time, self._changed)
        return np.where(changes, wanted, held)

    def _graded(self, left: Array, dt: float) -> Array:
        """Sticks: harder the more is left, beyond the part of the way that leads nowhere."""
        handling = self._handling
        share = np.clip(left / handling.full, -1.0, 1.0)
        share *= 1.0 + _UNSTEADY * self._rng.standard_normal(6)
        goal = np.sign(share) * (handling.idle + (1.0 - handling.idle) * np.abs(share))
        goal = np.where(np.abs(left) > handling.content, np.clip(goal, -1.0, 1.0), 0.0)
        meant = self._meant + (goal - self._meant) * (1.0 - math.exp(-dt / _LAG))
        return np.where((goal == 0.0) & (np.abs(meant) < 0.02), 0.0, meant)
