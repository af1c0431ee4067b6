"""The way of the joints to where motions start: looked through before, at limited speed, under somebody's eyes."""

from collections.abc import Callable

import numpy as np
from numpy.typing import NDArray

from services.process.exceptions import ServiceError
from services.robot.backends.backend import CONTROL_PERIOD

Array = NDArray[np.float64]

SHARE = 0.3
"""Of the joints' greatest speeds that the way is gone with."""

SHORTEST_S = 0.5
SETTLE_S = 0.3
"""The arm comes to rest at the way's end before things are put back [s]."""

LOOKED_THROUGH = 60
"""Places on the way at which it is looked whether the arm would touch something."""

PEAK = 1.875  # of a minimum-jerk motion's speed, over its mean


class WayBlocked(ServiceError):
    """The arm would touch something on its way to the start."""

    def __init__(self, what: str) -> None:
        self.what = what
        super().__init__(f"the way there is blocked: {what}; lead the arm clear of it by hand")


class Homing:
    """Leads joints straight to a goal with minimum jerk.

    Args:
        speed: greatest speeds of the joints, shape (m,) [rad/s].
        touches: what the arm would touch at joint positions, shape (m,), in words; empty for nothing.
    """

    def __init__(self, speed: Array, touches: Callable[[Array], str]) -> None:
        self._speed = SHARE * speed
        self._touches = touches
        self._then: Callable[[], None] | None = None
        self._from = self._goal = speed
        self._time = self._duration = 0.0

    @property
    def under_way(self) -> bool:
        """The arm is being led."""
        return self._then is not None

    def begin(self, q: Array, goal: Array, then: Callable[[], None]) -> None:
        """Begin to lead the arm.

        Args:
            q: where it is, shape (m,).
            goal: where to, shape (m,).
            then: what is done once it is there.

        Raises:
            WayBlocked: it would touch something that it does not touch where it is; nothing has begun.
        """
        self._look_through(q, goal)
        self._from, self._goal, self._then = q.copy(), goal.copy(), then
        self._time = 0.0
        self._duration = max(SHORTEST_S, PEAK * float(np.max(np.abs(goal - q) / self._speed)))

    def stop(self) -> None:
        """Lead it no further; what was to be done then is not."""
        self._then = None

    def advance(self) -> Array:
        """Joint positions at the end of the next control period, shape (m,); at the end what was to be done is done."""
        self._time += CONTROL_PERIOD
        share = min(1.0, self._time / self._duration)
        if self._time >= self._duration + SETTLE_S and self._then is not None:
            then, self._then = self._then, None
            then()
        way = share**3 * (10.0 - 15.0 * share + 6.0 * share**2)
        reached: Array = self._from + way * (self._goal - self._from)
        return reached

    def _look_through(self, q: Array, goal: Array) -> None:
        """What the arm touches where it is it may leave, and not come back to."""
        left = self._touches(q)
        for share in np.linspace(0.0, 1.0, LOOKED_THROUGH)[1:]:
            touched = self._touches(q + share * (goal - q))
            if touched and touched != left:
                raise WayBlocked(touched)
            left = left if touched else ""
