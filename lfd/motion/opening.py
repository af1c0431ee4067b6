"""What two motions have in common where the gripper takes part in them, and what they say of its opening."""

import numpy as np
from numpy.typing import NDArray

from lfd.arrays import Array
from lfd.exceptions import OpeningMismatch
from lfd.motion.trajectory import Trajectory

SAME_OPENING = 0.002
"""Openings that differ by less are one [m]."""


def openings(a: Trajectory, b: Trajectory) -> tuple[Array, Array] | None:
    """The openings of two motions, (n,) and (m,) [m]; None where the gripper takes part in neither.

    Raises:
        OpeningMismatch: It takes part in one of the two only.
    """
    if a.opening is not None and b.opening is not None:
        return a.opening, b.opening
    if a.opening is not b.opening:
        raise OpeningMismatch
    return None


def compared(a: Trajectory, b: Trajectory) -> tuple[Array, Array]:
    """By what two motions are matched, shapes (n, d) and (m, d) [m]: positions, and openings where both have them.

    So the moment of closing is matched to the moment of closing, also where the arm stands meanwhile.

    Raises:
        OpeningMismatch: The gripper takes part in one of the two only.
    """
    both = openings(a, b)
    if both is None:
        return a.positions, b.positions
    return np.column_stack([a.positions, both[0]]), np.column_stack([b.positions, both[1]])


def joined_openings(old: Array, new: Array, within: NDArray[np.bool_]) -> Array:
    """The new openings (n,) where `within` holds, and beyond either end of it the old ones as soon as they meet.

    An opening is not led over as a position is: what lies between open and closed grasps nothing. At an end of the part
    the new one is kept until the old one comes to it or passes it; so a part in which the gripper closed earlier does
    not open it again behind that part, only because the old motion closed it later.

    Args:
        old: Of the motion outside the part [m].
        new: Of the motion inside [m].
        within: One run of points, of any length.
    """
    inside = np.flatnonzero(within)
    if not len(inside):
        return old
    first, last = int(inside[0]), int(inside[-1])
    joined: Array = np.where(within, new, old)
    after = _met(old[last + 1 :], new[last])
    joined[last + 1 : last + 1 + after] = new[last]
    before = _met(old[:first][::-1], new[first])
    joined[first - before : first] = new[first]
    return joined


def _met(others: Array, kept: float) -> int:
    """How many of the openings (k,) come before one that is the same as the one kept, or beyond it: k where none is."""
    if not len(others):
        return 0
    apart = others - kept
    met = np.flatnonzero((np.abs(apart) < SAME_OPENING) | (np.sign(apart) != np.sign(apart[0])))
    return int(met[0]) if len(met) else len(others)
