"""What all tabs are told at one time: looked up and put into words once, however many look on."""

from __future__ import annotations

from functools import cached_property
from typing import NamedTuple

from services.station.live_view.drawing import Point, moment
from services.station.page.layout import shared
from services.station.page.values import Values
from services.station.page.view import Board, Shown
from sim.robots.gripper import Gripper


class Moving(NamedTuple):
    """What moves in the live view.

    Attributes:
        joints: their names.
        gripper: whose fingers are among them; None where there is none.
    """

    joints: tuple[str, ...]
    gripper: Gripper | None


class Glance:
    """The newest view at one time.

    Args:
        shown: the view.
        moving: what moves in the live view.
        now_ns: when it was looked up.
    """

    def __init__(self, shown: Shown, moving: Moving, now_ns: int) -> None:
        self.shown = shown
        self._moving = moving
        self._looked_ns = now_ns

    def elapsed_s(self, now_ns: int) -> float:
        """Since the view was put up [s]."""
        return self.shown.elapsed_s + (now_ns - self._looked_ns) / 1e9

    @cached_property
    def values(self) -> Values:
        """What every tab shows alike."""
        return shared(self.shown)

    @cached_property
    def moment(self) -> Point:
        """What moves."""
        view = self.shown.view
        return moment(view.robot, view.object_pose, view.force, *self._moving)


class Glances:
    """Looks at the board once in each period.

    Args:
        board: that the view hangs on.
        moving: what moves in the live view.
        period_ns: within which all tabs are told the same.
    """

    def __init__(self, board: Board, moving: Moving, period_ns: int) -> None:
        self._board = board
        self._moving = moving
        self._period_ns = period_ns
        self._newest: tuple[int, Glance] | None = None

    def at(self, now_ns: int) -> Glance:
        """The newest view at this time."""
        period = now_ns // self._period_ns
        if self._newest is None or self._newest[0] != period:
            self._newest = period, Glance(self._board.newest(), self._moving, now_ns)
        return self._newest[1]
