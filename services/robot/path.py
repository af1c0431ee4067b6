"""The prediction as the control periods pass it: its pose and its gripper's opening at any time."""

from __future__ import annotations

import math

import numpy as np
from numpy.typing import NDArray

from lfd.motion.resampling import Interpolation, at_phases
from lfd.motion.rotations import slerp
from lfd.motion.trajectory import Trajectory
from sim.pose import Pose

Array = NDArray[np.float64]

AT_REST, AT_REST_TURN = 0.05, 0.2
"""[m/s, rad/s] up to which a motion counts as one that begins or ends at rest: an arm loses that within millimetres."""

_NODES = 4
_SLACK = 1e-9
"""Of a control period: where a duration is a multiple of it but for rounding, it is one."""


class Path:
    """The poses of a prediction; between those at whole control periods, which are kept, they are interpolated.

    Args:
        prediction: in the base frame.
        period: of the control [s].
    """

    def __init__(self, prediction: Trajectory, period: float) -> None:
        self.end = math.ceil(prediction.duration / period - _SLACK)
        """The last control period."""
        self._period = period
        self._times = np.minimum(np.arange(self.end + 1) * period, prediction.duration)
        path = at_phases(prediction, self._times / prediction.duration, Interpolation.CUBIC)
        self._positions, self._orientations, self._opening = path.positions, path.orientations, path.opening
        self.begins_fast = self._is_fast(0)
        """It is no motion from rest: who follows it has to gain its speed first."""
        self.ends_fast = self._is_fast(max(0, self.end - 2))
        """It does not come to rest by itself; the last period may be a shorter one, the one before it counts."""

    def _is_fast(self, tick: int) -> bool:
        before, after = self.pose(float(tick)), self.pose(float(min(tick + 1, self.end)))
        far = float(np.linalg.norm(after.position - before.position))
        wide = 2.0 * math.acos(min(1.0, abs(float(before.orientation @ after.orientation))))
        return far > AT_REST * self._period or wide > AT_REST_TURN * self._period

    def time(self, at: float) -> float:
        """Of the prediction [s].

        Args:
            at: the time in control periods, from 0 to `end`.
        """
        return min(at * self._period, float(self._times[-1]))

    def is_over(self, at: float) -> bool:
        """Whether the last way-point is reached then; the last period may be a shorter one."""
        return self.time(at) >= float(self._times[-1]) - _SLACK * self._period

    def pose(self, at: float) -> Pose:
        """The pose at a time in control periods, from 0 to `end`."""
        tick = int(at)
        if tick == at:
            return Pose(self._positions[tick], self._orientations[tick])
        time = self.time(at)
        before, after = self._times[tick : tick + 2]
        share = np.asarray((time - before) / (after - before))
        orientation = slerp(self._orientations[tick], self._orientations[tick + 1], share)
        return Pose(self._position(tick, time), orientation)

    def opening(self, at: float) -> float | None:
        """The gripper's opening at a time in control periods [m]: of the last whole one; None for no part in it."""
        return None if self._opening is None else float(self._opening[int(at)])

    def _position(self, tick: int, time: float) -> Array:
        """On the cubic through the nearest kept points (Lagrange): exact for cubics."""
        first = max(0, min(tick - 1, len(self._times) - _NODES))
        nodes = self._times[first : first + _NODES]
        weights = [
            math.prod((time - other) / (node - other) for other in nodes if other != node) for node in nodes.tolist()
        ]
        return np.asarray(weights @ self._positions[first : first + _NODES], dtype=np.float64)
