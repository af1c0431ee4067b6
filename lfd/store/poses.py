"""Poses in the columns of a table."""

import numpy as np

from lfd.arrays import Array, frozen
from lfd.store.spreadsheet import Table

POSITION = ("x", "y", "z")
ORIENTATION = ("qw", "qx", "qy", "qz")
OPENING = "opening"
UNITS = {**dict.fromkeys(POSITION, "m"), **dict.fromkeys(ORIENTATION, "1"), OPENING: "m"}

ROUNDED = 0.02  # [-] how far rounding to two decimals takes a quaternion's norm from one


WIDEST = 0.5
"""What is wider is taken for another unit than metres [m]."""


def opening_of(table: Table) -> Array | None:
    """How far the gripper is open, shape (rows,) [m]; None where the table does not say it.

    Raises:
        TableError: A cell is not a number, or no opening of a gripper.
    """
    if OPENING not in table.columns:
        return None
    opening = table.numbers([OPENING])[:, 0]
    wrong = np.flatnonzero((opening < 0.0) | (opening > WIDEST))
    if wrong.size:
        i = int(wrong[0])
        if opening[i] < 0.0:
            raise table.rows[i].error(f"{opening[i]:g} m is no opening of a gripper: 0 is closed", OPENING)
        milli = f": this looks like millimetres; write metres, {opening[i] / 1000.0:.6g} for {opening[i]:.6g}"
        guess = milli if float(opening.max()) <= 1000.0 * WIDEST else ""
        raise table.rows[i].error(f"{opening[i]:g} m is wider than a gripper opens, {WIDEST:g} m{guess}", OPENING)
    return frozen(opening)


def orientations_of(table: Table) -> Array:
    """The quaternions (w, x, y, z) of a table, made unit from what rounding left of that, shape (rows, 4).

    Raises:
        TableError: A cell is not a number, or a quaternion not of unit norm.
    """
    quaternions = table.numbers(ORIENTATION)
    norms = np.linalg.norm(quaternions, axis=1, keepdims=True)
    wrong = np.flatnonzero(np.abs(norms - 1.0) > ROUNDED)
    if wrong.size:
        i = int(wrong[0])
        raise table.rows[i].error(f"the quaternion qw,qx,qy,qz has norm {norms[i, 0]:g}, not 1")
    return frozen(quaternions / norms)
