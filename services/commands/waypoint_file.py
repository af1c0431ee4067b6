"""Waypoints that a person wrote down: a CSV file, one pose of the grasping frame a row, in the base frame."""

from __future__ import annotations

import csv
import math
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from lfd.arrays import UNIT_TOLERANCE
from lfd.motion.waypoints import LEAST_WAYPOINTS
from services.bus.arrays import Floats
from services.process.exceptions import WaypointFileError

COLUMNS = ("x", "y", "z", "qw", "qx", "qy", "qz")


@dataclass(frozen=True, eq=False)
class Waypoints:
    """Poses of the grasping frame in the base frame, at least three.

    Attributes:
        positions: shape (k, 3) [m].
        orientations: unit quaternions (w, x, y, z), shape (k, 4).
    """

    positions: Floats
    orientations: Floats


def read_waypoints(path: Path) -> Waypoints:
    """Read a file whose first line names the columns x, y, z [m], qw, qx, qy and qz, in any order, among others or not.

    Raises:
        WaypointFileError: it cannot be read, a column is missing, a cell is not a number, a quaternion is not of unit
            norm, or there are fewer than three rows; says which and where.
    """
    try:
        # Spreadsheets put a byte order mark before the first name.
        with path.open(newline="", encoding="utf-8-sig") as file:
            poses = _poses(path, csv.DictReader(file))
    except OSError as error:
        raise WaypointFileError(path, error.strerror or str(error)) from None
    except (UnicodeDecodeError, csv.Error) as error:
        raise WaypointFileError(path, f"not a CSV file: {error}") from None
    if len(poses) < LEAST_WAYPOINTS:
        raise WaypointFileError(path, f"{len(poses)} row(s) of poses; a motion needs at least {LEAST_WAYPOINTS}")
    table = np.array(poses)
    return Waypoints(table[:, :3], table[:, 3:])


def _poses(path: Path, rows: csv.DictReader[str]) -> list[list[float]]:
    rows.fieldnames = [name.strip() for name in rows.fieldnames or ()]
    missing = [name for name in COLUMNS if name not in rows.fieldnames]
    if missing:
        wanted = ",".join(COLUMNS)
        raise WaypointFileError(path, f"no column {', '.join(missing)}; the first line has to be {wanted}")
    return [_pose(path, rows.line_num, row) for row in rows]


def _pose(path: Path, line: int, row: dict[str, str | None]) -> list[float]:
    pose = [_number(path, line, name, row[name] or "") for name in COLUMNS]
    norm = math.hypot(*pose[3:])
    if abs(norm - 1.0) > UNIT_TOLERANCE:
        raise WaypointFileError(path, f"line {line}: the quaternion qw,qx,qy,qz has norm {norm:g}, not 1")
    return pose


def _number(path: Path, line: int, column: str, cell: str) -> float:
    try:
        number = float(cell)
    except ValueError:
        number = math.nan
    if not math.isfinite(number):
        raise WaypointFileError(path, f"line {line}, column {column}: {cell.strip()!r} is not a number")
    return number
