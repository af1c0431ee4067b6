"""Recorded motions in files: a table, one sample a row."""

from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import ArrayLike

from lfd.arrays import Array, frozen
from lfd.exceptions import TableError
from lfd.motion.demonstration import Demonstration
from lfd.motion.provenance import UNKNOWN, Provenance
from lfd.motion.recording import demonstration_from_arrays
from lfd.store.poses import OPENING, ORIENTATION, POSITION, UNITS, opening_of, orientations_of
from lfd.store.spreadsheet import Row, Table, read_table

LARGEST_M = 10.0  # [m] from the origin that a motion is thought to lead
LARGEST_S = 600.0  # [s] that it is thought to take
LARGEST_BYTES = 1 << 26

_OPTIONAL = ("y", "z", *ORIENTATION, OPENING)


@dataclass(frozen=True, eq=False)
class Recording:
    """The samples of one motion as they stand in a file.

    Attributes:
        times: Strictly increasing, shape (T,) [s].
        positions: Shape (T, D), D from 1 to 3: as many axes as the file names [m].
        orientations: Unit quaternions (w, x, y, z), shape (T, 4); None where the file names none.
        others: Further columns that were asked for, in the units of the file, shape (T, C).
        opening: Of the gripper, shape (T,) [m]; None where the file does not say it.
    """

    times: Array
    positions: Array
    orientations: Array | None
    others: Array
    opening: Array | None = None


def read_recording(
    path: Path, others: Sequence[str] = (), *, largest_m: float = LARGEST_M, largest_s: float = LARGEST_S
) -> Recording:
    """Read a file whose first line names the columns t [s], x [m] and, where there are any, y, z, qw, qx, qy and qz.

    It may name opening, too, the gripper's [m]. Whatever separates the cells, marks the decimals and encodes the
    letters; see `read_table`.

    Args:
        path: The file.
        others: Further columns, as where an object was seen.
        largest_m: What is farther from the origin is taken for another unit than metres [m].
        largest_s: What takes longer is taken for another unit than seconds [s].

    Raises:
        TableError: It cannot be read, a column is missing, a cell is not a number, two lines have one time or are out
            of order, a quaternion is not of unit norm, a position, time or opening is beyond what can be meant, or
            there are fewer than two samples; says which, where, and what would be right.
    """
    path = Path(path)
    names = [name.casefold() for name in others]
    table = read_table(path, {"t": "s"} | UNITS | dict.fromkeys(names, ""), _OPTIONAL, LARGEST_BYTES)
    _check_axes(path, table)
    if len(table.rows) < 2:
        raise TableError(path, f"{len(table.rows)} sample(s): a motion needs at least 2")
    axes = [name for name in POSITION if name in table.columns]
    times, positions = table.numbers(["t"])[:, 0], table.numbers(axes)
    _check_times(table.rows, times, largest_s)
    _check_positions(table.rows, positions, axes, largest_m)
    turns = orientations_of(table) if "qw" in table.columns else None
    return Recording(frozen(times), frozen(positions), turns, frozen(table.numbers(names)), opening_of(table))


def read_demonstration(
    path: Path,
    condition: ArrayLike | None = None,
    *,
    condition_columns: Sequence[str] = (),
    origin: ArrayLike | None = None,
    provenance: Provenance = UNKNOWN,
) -> Demonstration:
    """A demonstration from a file; see `read_recording` and `demonstration_from_arrays`, which say what is raised.

    Args:
        path: The file.
        condition: External state that the motion was right for (task parameter, context), shape (C,), or one number.
        condition_columns: Of the file, that hold it instead; in its first line, as it was before the motion.
        origin: Point that the motion is learnt relative to, shape (D,) [m]; zero where there is none.
        provenance: Whose it is.
    """
    recording = read_recording(path, condition_columns)
    return demonstration_from_arrays(
        recording.times,
        recording.positions,
        recording.others[0] if condition is None else condition,
        recording.orientations,
        origin,
        opening=recording.opening,
        provenance=provenance,
    )


def _check_axes(path: Path, table: Table) -> None:
    """A plane has no z without a y; an orientation has four numbers or none."""
    if "z" in table.columns and "y" not in table.columns:
        raise TableError(path, "column z without y: name both, or call it y")
    given = [name for name in ORIENTATION if name in table.columns]
    if given and len(given) < len(ORIENTATION):
        missing = [name for name in ORIENTATION if name not in given]
        raise TableError(path, f"no column {', '.join(missing)} beside {', '.join(given)}: give all four, or none")


def _check_times(rows: list[Row], times: Array, largest: float) -> None:
    back = np.flatnonzero(np.diff(times) <= 0.0)
    if back.size:
        i = int(back[0])
        same = times[i] == times[i + 1]
        todo = "leave one of them out, or write more decimals" if same else "order the lines by their times"
        before = f"{times[i]:.10g} s of line {rows[i].line}"
        raise rows[i + 1].error(f"{times[i + 1]:.10g} s {'repeats' if same else 'follows'} {before}: {todo}", "t")
    takes = times[-1] - times[0]
    if takes > largest:
        guess = ": this looks like milliseconds; write seconds" if takes <= 1000.0 * largest else ""
        raise rows[-1].error(f"the motion takes {takes:g} s, at most {largest:g} s are expected{guess}", "t")


def _check_positions(rows: list[Row], positions: Array, axes: list[str], largest: float) -> None:
    beyond = np.argwhere(np.abs(positions) > largest)
    if beyond.size:
        i, axis = beyond[0]
        value = positions[i, axis]
        guess = ""
        if float(np.max(np.abs(positions))) <= 1000.0 * largest:
            guess = f": this looks like millimetres; write metres, {value / 1000.0:.6g} for {value:.6g}"
        raise rows[i].error(f"{value:.6g} m is farther from the origin than {largest:g} m{guess}", axes[axis])
