"""Free motion under the operator's hand: no prediction leads, the gripper goes where the master goes.

While master m and robot are coupled, with the gain g and the poses at the coupling marked 0,

    p = p_0 + g (d - d_0),    R = (exp(r) exp(r_0)^-1) R_0

for the displacement d and the rotation vector r of the master, all in base axes. Decoupled, the robot stands, and the
hand goes to where it is comfortable; coupled again, both begin anew from where they are, so that nothing jumps. Taken
period by period, as is done here, that is the same: each moves by what the hand did since the period before.
"""

from __future__ import annotations

import math
from collections.abc import Callable

import numpy as np

from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from services.robot.correction import UNCORRECTED, Correction
from services.robot.execution import angle_between
from services.robot.safety import clamp_length
from sim.pose import Pose

LONGEST_S = 600.0
"""A motion by hand ends by itself after so long [s]: nobody teaches one that takes ten minutes."""

LEASH = 0.03
"""The reference is never further from where the arm is [m]: a hand that pulls where the arm cannot follow, out of reach
or against a wall, slips, and the arm follows again as soon as the hand turns back."""

LEASH_TURN = 0.15
"""A hand turns the reference no further from how the arm is oriented [rad]. Where the orientation gives way by itself,
at a joint's limit, the reference stays what the hand made it, and the arm turns back to it as soon as it can."""

SAMPLE_S = 0.04
"""Between two points of the account of a motion by hand [s]; more where there would be too many of them."""

MOST_POINTS = 4000
LEAST_POINTS = 75


class Coupling:
    """Between the operator's hand and the robot: what the hand does counts while it is coupled."""

    def __init__(self) -> None:
        self._before: Correction | None = None

    def decouple(self) -> None:
        """The hand is off the master, the robot holds, or another master has come in its place."""
        self._before = None

    def step(self, hand: Correction) -> Correction:
        """By how much the robot moves in this period; not at all where the hand has just been coupled.

        Args:
            hand: displacement and rotation of the master, the gain in them.
        """
        before, self._before = self._before, hand
        if before is None:
            return UNCORRECTED
        turned = multiply(exp_map(hand.turn), conjugate(exp_map(before.turn)))
        return Correction(hand.offset - before.offset, log_map(turned))


class Teleoperation:
    """One motion by hand, from where the arm is. See `Course`.

    Args:
        measured: says where the grasping frame is.
        period: of the control [s].
    """

    correction = UNCORRECTED
    corrects = True
    ramping = False

    def __init__(self, measured: Callable[[], Pose], period: float) -> None:
        self.reference = measured()
        self._measured = measured
        self._period = period
        self._ticks = 0
        self._longest = round(LONGEST_S / period)
        self.opening: float | None = None
        """Of the gripper, as the hand asked for it last [m]; None leaves it as it is."""

    @property
    def finished(self) -> bool:
        """It took as long as any may."""
        return self._ticks >= self._longest

    @property
    def time(self) -> float:
        """Since it began, holds left out [s]."""
        return self._ticks * self._period

    @property
    def progress(self) -> float:
        """Share of the longest time that it may take."""
        return self._ticks / self._longest

    @property
    def nominal(self) -> Pose:
        """Nothing leads but the hand."""
        return self.reference

    @property
    def points(self) -> int:
        """Of the account of it."""
        return min(MOST_POINTS, max(LEAST_POINTS, math.ceil(self.time / SAMPLE_S) + 1))

    def is_input(self, wanted: Correction) -> bool:
        """The hand moves, or asks something of the gripper."""
        return bool(wanted.offset.any() or wanted.turn.any()) or wanted.opening is not None

    def advance(self, wanted: Correction, leeway: float = 1.0, share: float = 1.0) -> Pose:
        """Go on by one control period.

        Args:
            wanted: by how much the hand moves the reference, see `Coupling.step`.
            leeway: see `Watchdog.leeway`; a hand that is not heard moves nothing anyway.
            share: of what the hand does that is done: less where the arm is near to where it must not be.

        Returns:
            The reference at the end of the period.
        """
        del leeway
        if not self.finished:
            self._ticks += 1
            self.opening = self.opening if wanted.opening is None else wanted.opening
            moved = wanted if share == 1.0 else Correction(share * wanted.offset, share * wanted.turn, wanted.opening)
            self.reference = _leashed(self.reference, moved.of(self.reference), self._measured())
        return self.reference

    def rejoin(self, measured: Pose, *, at_once: bool) -> None:
        """Go on after a hold: from where the arm is, unless it was short and the arm did not leave."""
        if not (at_once and np.linalg.norm(measured.position - self.reference.position) <= LEASH):
            self.reference = measured


def _leashed(before: Pose, reference: Pose, measured: Pose) -> Pose:
    """The reference after a hand moved it: drawn to within the leash of where the arm is, and turned no further."""
    offset, far = clamp_length(reference.position - measured.position, LEASH)
    position = measured.position + offset if far else reference.position
    gap = angle_between(measured.orientation, reference.orientation)
    slips = gap > LEASH_TURN and gap > angle_between(measured.orientation, before.orientation)
    return Pose(position, before.orientation if slips else reference.orientation)
