"""The success criteria of the thesis' 2D example: both via-points passed, and no collision."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from services.robot.backends.backend import Observation, Touch
from services.robot.verdict import Verdict
from sim.pose import Pose

Array = NDArray[np.float64]


@dataclass(frozen=True)
class ViaPointCriteria:
    """By what an episode is judged that is to pass through via-points.

    The thesis shows the mean squared error (equation (25)) and calls a via-point reached by eye; the tolerance makes a
    verdict of it.

    Attributes:
        via_x: of the via-points, rising [m].
        tolerance: how far beside a via-point, in y, counts as passed through [m].
    """

    via_x: tuple[float, ...]
    tolerance: float

    def begin(self, seen: Observation) -> "ViaPointJudge":
        """See `Criteria.begin`; the condition is the y of the via-points."""
        return ViaPointJudge(self, seen.condition)


class ViaPointJudge:
    """See `Judge`.

    Args:
        criteria: by what.
        via_y: of the via-points, shape (n,) [m].
    """

    def __init__(self, criteria: ViaPointCriteria, via_y: Array) -> None:
        self._x = np.array(criteria.via_x)
        self._y = via_y
        self._tolerance = criteria.tolerance
        self._passed_at = np.full(len(via_y), np.nan)
        self._before: Array | None = None
        self._collision: Touch | None = None

    def judge(
        self,
        grasping: Pose,
        object_pose: Pose | None,
        touch: Touch | None,
        *,
        grasped: bool = False,
        time: float = 0.0,
    ) -> Verdict:
        """See `Judge.judge`; a via-point that lies ahead counts as missed by as much as it would be now."""
        del object_pose, grasped, time
        self._collision = self._collision or touch
        self._follow(grasping.position)
        ahead = np.isnan(self._passed_at)
        missed = np.where(ahead, grasping.position[1], self._passed_at) - self._y
        most = float(np.max(np.abs(missed)))
        value = (most / self._tolerance) ** 2
        return Verdict(
            reached=value <= 1.0 and not ahead.any(),
            kicked_over=False,
            collision=self._collision,
            ellipsoid_value=value,
            displacement=np.zeros(3),
            missed=most,
        )

    def _follow(self, now: Array) -> None:
        """Note the y at each via-point's x that lies between the last period and this one."""
        if self._before is not None:
            crossed = (self._before[0] < self._x) & (self._x <= now[0])
            if crossed.any():
                y = np.interp(self._x[crossed], [self._before[0], now[0]], [self._before[1], now[1]])
                self._passed_at[crossed] = y
        self._before = now
