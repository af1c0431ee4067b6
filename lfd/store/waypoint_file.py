"""Waypoints that a person wrote down: a table, one pose of the grasping frame a row, in the base frame."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lfd.arrays import Array, checked, frozen
from lfd.exceptions import TableError
from lfd.motion.waypoints import LEAST_WAYPOINTS
from lfd.store.poses import OPENING, POSITION, UNITS, opening_of, orientations_of
from lfd.store.spreadsheet import Row, read_table

MOST_WAYPOINTS = 1000
STILL = 1e-3  # [m] within which waypoints make no motion
NEAR = 0.3  # [m] of the object that a motion to it ends

_UNITS = {"millimetres": 1000.0, "centimetres": 100.0, "inches": 1.0 / 0.0254}
"""That people measure in, by how many make a metre."""


@dataclass(frozen=True, eq=False)
class Waypoints:
    """Poses of the grasping frame in the base frame, at least three.

    Attributes:
        positions: Shape (k, 3) [m].
        orientations: Unit quaternions (w, x, y, z), shape (k, 4).
        opening: Of the gripper from each of them on, shape (k,) [m]; None where the file does not say it.
    """

    positions: Array
    orientations: Array
    opening: Array | None = None


@dataclass(frozen=True, eq=False)
class Surroundings:
    """What the numbers are compared with.

    Attributes:
        lower: Least corner of where the grasping frame can be, base frame, shape (3,) [m].
        upper: The greatest.
        target: That the waypoints lead to, base frame, shape (3,) [m].
    """

    lower: Array
    upper: Array
    target: Array

    def __post_init__(self) -> None:
        for name in ("lower", "upper", "target"):
            object.__setattr__(self, name, checked(name, getattr(self, name), (3,)))


def read_waypoints(path: Path, surroundings: Surroundings) -> Waypoints:
    """Read a file whose first line names the columns x, y, z [m], qw, qx, qy and qz, and may name opening [m].

    See `read_table`.

    Args:
        path: The file.
        surroundings: That its positions have to fit.

    Raises:
        TableError: It cannot be read, a column is missing, a cell is not a number, a quaternion is not of unit norm, a
            position is out of reach, there are too few or too many rows, all are the same, or the last one is far from
            the target; says which and where.
    """
    table = read_table(path, UNITS, [OPENING])
    rows = table.rows
    if not LEAST_WAYPOINTS <= len(rows) <= MOST_WAYPOINTS:
        count = f"at least {LEAST_WAYPOINTS}" if len(rows) < LEAST_WAYPOINTS else f"at most {MOST_WAYPOINTS}"
        raise TableError(path, f"{len(rows)} row(s) of poses; a motion needs {count}")
    positions, orientations = table.numbers(POSITION), orientations_of(table)
    _check_reach(rows, positions, surroundings)
    if float(np.max(np.ptp(positions, axis=0))) < STILL:
        raise TableError(path, f"all {len(rows)} waypoints are the same point: that is no motion")
    _check_end(rows[-1], positions, surroundings.target)
    return Waypoints(frozen(positions), orientations, opening_of(table))


def _check_reach(rows: list[Row], positions: Array, surroundings: Surroundings) -> None:
    low, high = surroundings.lower, surroundings.upper
    beyond = np.argwhere((positions < low) | (positions > high))
    if not beyond.size:
        return
    i, axis = beyond[0]
    raise rows[i].error(
        f"{positions[i, axis]:g} m is out of the robot's reach, {low[axis]:g} to {high[axis]:g} m"
        f"{_looks_like(positions, surroundings)}",
        POSITION[axis],
    )


def _looks_like(positions: Array, surroundings: Surroundings) -> str:
    """The unit in which the waypoints would lead to the target, if any."""

    def missed_by(count: float) -> float:
        return float(np.linalg.norm(positions[-1] / count - surroundings.target))

    unit, count = min(_UNITS.items(), key=lambda one: missed_by(one[1]))
    meant = positions / count
    if missed_by(count) > NEAR or np.any(meant < surroundings.lower) or np.any(meant > surroundings.upper):
        return ""
    return f"; this looks like {unit}: write metres, {meant[0, 0]:.4g} for {positions[0, 0]:g}"


def _check_end(last: Row, positions: Array, target: Array) -> None:
    away = np.linalg.norm(positions - target, axis=1)
    if away[-1] > NEAR:
        order = "; the first one is nearer: is the order reversed?" if away[0] <= NEAR else ""
        raise last.error(
            f"the last waypoint is {away[-1]:.2f} m away from the object, at most {NEAR:g} m is a motion to it{order}"
        )
