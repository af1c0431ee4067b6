"""What the operator asks of the gripper: closed or open by a press, or as far as a slider says.

It is asked while a motion runs that the operator may correct or leads alone, and stays asked whatever is lost: nobody
lets go of a thing because a page lost its focus. It is over where the robot does otherwise: where the motion has come
to it and gone on, or where it never counted, outside the part that is corrected. A new episode begins with nothing.
"""

from __future__ import annotations

import math

from protocol.messages import Mode, Phase, RobotState
from services.station.press import Press
from services.station.workflow.view import View

GRIP, OPENING = "grip", "opening"
"""Closing what is open and opening what is closed; and a share of wide open."""

_LED = (Mode.REFINE, Mode.TEACH)
_HALF = 0.5
_FOLLOWED_S = 0.5
"""Within that a robot that follows tells its gripper what was asked."""

_SAME = 0.02
"""Shares of wide open that differ by less are one."""


class Gripper:
    """Follows what is asked of it at one station.

    Attributes:
        asked: as a share of wide open; None where nothing was asked in this episode, or it takes no part.

    Args:
        holder: this station's name as holder of the authority.
    """

    def __init__(self, holder: str) -> None:
        self.asked: float | None = None
        self._holder = holder
        self._episode: tuple[int, int] | None = None
        self._pressed_s = 0.0

    def hear(self, presses: list[Press], view: View) -> None:
        """Take up what was pressed in one step."""
        robot = view.robot
        if robot is None:
            return
        before, self._episode = self._episode, (robot.publisher, robot.episode)
        wide = view.scene.wide_open if view.scene is not None else 0.0
        if before != self._episode or not robot.phase.running or not wide:
            self.asked = None
        elif self.asked is not None and view.now_s - self._pressed_s > _FOLLOWED_S:
            followed = abs(robot.opening_reference / wide - self.asked) < _SAME
            self.asked = self.asked if followed else None
        mine = view.authority is not None and view.authority.holder == self._holder
        if not (wide and mine and may_be_asked(robot)):
            return
        for press in presses:
            if press.action == GRIP:
                self.asked = 0.0 if self._stands(robot, wide) > _HALF else 1.0
            elif press.action == OPENING:
                self.asked = _share(press.argument, self.asked)
            if press.action in (GRIP, OPENING):
                self._pressed_s = view.now_s

    def _stands(self, robot: RobotState, wide: float) -> float:
        return self.asked if self.asked is not None else robot.opening_reference / wide


def may_be_asked(robot: RobotState) -> bool:
    """The robot executes a motion that its operator may correct, or leads alone; a pause of it counts as well."""
    return robot.phase is Phase.EXECUTE and robot.mode in _LED


def _share(said: str, otherwise: float | None) -> float | None:
    """The share of wide open that a slider said; what it was where that is none."""
    try:
        share = float(said)
    except ValueError:
        return otherwise
    return min(max(share, 0.0), 1.0) if math.isfinite(share) else otherwise
