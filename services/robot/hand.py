"""The operator's hand on the master: what it asks for in each control period."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from protocol.messages import MasterState
from services.robot.arm import Arm
from services.robot.backends.backend import CONTROL_PERIOD
from services.robot.clutch import Clutch
from services.robot.correction import UNCORRECTED, Correction
from services.robot.episode import Course
from services.robot.teleoperation import Coupling


class Hand:
    """One hand after another, each on its master.

    Args:
        gain: of the master's displacement on the reference; its rotation counts as it is.
        arm: that follows.
    """

    def __init__(self, gain: float, arm: Arm) -> None:
        self.gain = gain
        self._arm = arm
        self._clutch = Clutch(CONTROL_PERIOD)
        self._coupling = Coupling()
        self._master: int | None = None

    def let_go(self) -> None:
        """It was off the master, if only for a moment."""
        self._clutch.let_go()
        self._coupling.decouple()

    def is_another(self, master: MasterState) -> bool:
        """It is off the master, or another master has come in its place."""
        before, self._master = self._master, master.publisher
        return not master.engaged or master.publisher != before

    def asks(self, master: MasterState, course: Course, *, leads: bool, holding: bool) -> Correction:
        """A correction, or by how much to move where the hand leads alone; and what it asks of the gripper.

        Args:
            master: its newest state.
            course: of the episode that runs.
            leads: the hand leads alone.
            holding: the episode may not go on.
        """
        if not course.corrects:
            self._clutch.rest()
        if holding:
            # What the hand did meanwhile is not caught up with at once.
            self.let_go()
        opening = None if master.opening is None else master.opening * self._arm.fingers.wide_open
        if holding or not course.corrects:
            return replace(course.correction, opening=opening)
        asked = Correction(self.gain * np.array(master.displacement), np.array(master.rotation))
        if leads:
            return replace(self._coupling.step(asked) if master.engaged else UNCORRECTED, opening=opening)
        return replace(self._clutch.correction(asked, self._arm.followed(asked), course.correction), opening=opening)
