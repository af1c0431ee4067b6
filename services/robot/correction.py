"""What the operator changes: the displacement of eq. 15-17, its counterpart for the orientation, and the gripper."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.motion.rotations import exp_map, multiply
from sim.pose import Pose

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Correction:
    """A translation and a rotation, both in base axes; a pose corrected by it is (p + offset, exp(turn) R).

    Attributes:
        offset: added to the position, shape (3,) [m].
        turn: rotation vector, shape (3,) [rad]; the rotation stands on the left of the pose's own, and leaves the
            position of the frame where it is.
        opening: of the gripper, in place of the motion's own [m]; None leaves it to the motion.
    """

    offset: Array
    turn: Array
    opening: float | None = None

    def of(self, pose: Pose) -> Pose:
        """The corrected pose; without a turn the orientation stays what it was, to the last bit."""
        turned = multiply(exp_map(self.turn), pose.orientation) if self.turn.any() else pose.orientation
        return Pose(pose.position + self.offset, turned)

    def towards(self, other: Correction, share: float) -> Correction:
        """The correction that is moved by a share, from 0 to 1, of the way to another one; the opening is its at once.

        A gripper has a speed of its own, and when it begins is what is corrected.
        """
        offset = self.offset + share * (other.offset - self.offset)
        return Correction(offset, self.turn + share * (other.turn - self.turn), other.opening)


UNCORRECTED = Correction(np.zeros(3), np.zeros(3))
"""The prediction alone."""
UNCORRECTED.offset.setflags(write=False)
UNCORRECTED.turn.setflags(write=False)
