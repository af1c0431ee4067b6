"""Where the robot's reference went in an episode, point by point as it is seen."""

from __future__ import annotations

import math
from collections import deque

import numpy as np

from protocol.messages import Phase, RobotState, Vector3
from services.bus.arrays import Floats

SPACING = 0.005
"""Points closer than this are one [m]: a line through them looks the same."""

POINTS_KEPT = 1000


class Trace:
    """The way of the episode that runs, or that ran last; where it went back, it is as long as it is then."""

    def __init__(self) -> None:
        self._episode: tuple[int, int] | None = None
        self._points: deque[Vector3] = deque(maxlen=POINTS_KEPT)
        self._passed: deque[float] = deque(maxlen=POINTS_KEPT)  # at which progress each point was

    def see(self, robot: RobotState) -> bool:
        """Follow the reference; another episode begins another trace. Whether the way is another one now."""
        episode = (robot.publisher, robot.episode)
        begins = episode != self._episode
        if begins:
            self._episode = episode
            self._points.clear()
            self._passed.clear()
        if robot.phase is not Phase.EXECUTE:
            return begins
        position = robot.reference.position
        length = len(self._points)
        while self._passed and self._passed[-1] > robot.progress:
            self._passed.pop()
            self._points.pop()
        goes_on = not self._points or math.dist(self._points[-1], position) >= SPACING
        if goes_on:
            self._points.append(position)
            self._passed.append(robot.progress)
        return begins or goes_on or len(self._points) != length

    @property
    def points(self) -> Floats:
        """Shape (k, 3) [m]."""
        return np.array(self._points, dtype=np.float64).reshape(-1, 3)
