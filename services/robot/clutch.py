"""What the master asks of the robot, so that nothing jumps when a hand takes it up.

A hand that was on the master before the motion began, or while the robot was brought back to where it had left off,
asked for nothing: its displacement counts once it was neutral, or agreed with the correction that is applied. A hand
that lets go and takes the master up again goes on from the applied correction, whatever the master makes of that; a
difference between them fades at the pace of an unhurried hand.
"""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from services.robot.correction import UNCORRECTED, Correction

Array = NDArray[np.float64]

NEUTRAL = 0.01  # [m] within which the master is neutral, or agrees
NEUTRAL_TURN = 0.1  # [rad] the same of its rotation
FADE = 0.05  # [m/s] at which a difference fades
FADE_TURN = 0.2  # [rad/s] the same of a rotation


class Clutch:
    """Between one master and one robot.

    Args:
        period: of the control [s].
    """

    def __init__(self, period: float) -> None:
        self._period = period
        self._counts = False
        self._taken_up = False
        self._difference: Correction = UNCORRECTED

    def rest(self) -> None:
        """The robot is brought to where the motion begins or goes on: what the hand does meanwhile asks for nothing."""
        self._counts = self._taken_up = False

    def let_go(self) -> None:
        """The hand is off the master, or another master has come in its place."""
        self._taken_up = False

    def correction(self, asked: Correction, followed: Correction, applied: Correction) -> Correction:
        """The correction that counts as asked for in this period.

        Args:
            asked: by the master.
            followed: what the robot can follow of it.
            applied: by the robot now.
        """
        away = Correction(applied.offset - followed.offset, applied.turn - followed.turn)
        if not self._counts:
            self._counts = _small(away) or _small(followed)
            if not self._counts:
                return applied
        if self._taken_up:
            self._difference = _faded(self._difference, self._period)
        else:
            self._difference, self._taken_up = away, True
        return Correction(asked.offset + self._difference.offset, asked.turn + self._difference.turn)


def _small(correction: Correction) -> bool:
    """A hand that rests, and the tremor of one."""
    return bool(np.linalg.norm(correction.offset) <= NEUTRAL and np.linalg.norm(correction.turn) <= NEUTRAL_TURN)


def _faded(difference: Correction, period: float) -> Correction:
    return Correction(_shorter(difference.offset, FADE * period), _shorter(difference.turn, FADE_TURN * period))


def _shorter(vector: Array, step: float) -> Array:
    length = float(np.linalg.norm(vector))
    return vector * (1.0 - step / length) if length > step else np.zeros(3)
