"""Poses in the columns of a table."""

import numpy as np

from lfd.arrays import Array, frozen
from lfd.store.spreadsheet import Table

POSITION = ("x", "y", "z")
ORIENTATION = ("qw", "qx", "qy", "qz")
UNITS = {**dict.fromkeys(POSITION, "m"), **dict.fromkeys(ORIENTATION, "1")}

ROUNDED = 0.02  # [-] how far rounding to two decimals takes a quaternion's norm from one


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
