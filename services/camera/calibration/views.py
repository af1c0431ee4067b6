"""Pictures of the board, and where the camera's link was in each: a folder of files, made here or by whatever else."""

from __future__ import annotations

import csv
from collections.abc import Iterator
from pathlib import Path
from typing import NamedTuple

import cv2
import numpy as np

from lfd.motion.rotations import matrix_from_quaternion
from services.bus.arrays import Floats
from services.camera.calibration.board import Grey
from services.process.exceptions import ConfigurationError

POSES = "poses.csv"
COLUMNS = ("picture", "x", "y", "z", "qw", "qx", "qy", "qz")
"""Of the list of poses: a picture's file, position [m] and unit quaternion of the camera's link, in the frame in which
the board stands still: the base's, or the hand's where that holds it."""

ENDINGS = (".png", ".jpg", ".jpeg")
WHAT = "list of poses"


class View(NamedTuple):
    """One picture of the board.

    Attributes:
        file: of the picture.
        picture: grey, shape (height, width).
        link: placement of the camera's link, shape (4, 4); None where it was not noted.
    """

    file: Path
    picture: Grey
    link: Floats | None


def read_views(folder: Path) -> list[View]:
    """All pictures of a folder, in the order of their names.

    Raises:
        ConfigurationError: there are none, one cannot be read, or the list of poses is none.
    """
    files = sorted(path for path in folder.glob("*") if path.suffix.lower() in ENDINGS)
    if not files:
        raise ConfigurationError(folder, f"there is no picture in it: its files end in {', '.join(ENDINGS)}", "folder")
    links = dict(_links(folder / POSES)) if (folder / POSES).exists() else {}
    return [View(file, _read(file), links.get(file.name)) for file in files]


def write_view(folder: Path, number: int, data: bytes, pose: tuple[float, ...]) -> None:
    """Add a picture and its pose.

    Args:
        folder: that is there.
        number: of the picture.
        data: a JPEG file.
        pose: of the camera's link, as in `COLUMNS`.

    Raises:
        OSError: they cannot be written.
    """
    file = folder / f"{number:03}.jpg"
    file.write_bytes(data)
    poses = folder / POSES
    lines = [] if poses.exists() else [",".join(COLUMNS)]
    lines.append(",".join([file.name, *(f"{value:.9g}" for value in pose)]))
    with poses.open("a", encoding="utf-8") as written:
        written.write("\n".join(lines) + "\n")


def _read(file: Path) -> Grey:
    picture = cv2.imread(str(file), cv2.IMREAD_GRAYSCALE)
    if picture is None:
        raise ConfigurationError(file, "it cannot be read: take it out of the folder", "picture")
    return np.asarray(picture, dtype=np.uint8)


def _links(path: Path) -> Iterator[tuple[str, Floats]]:
    with path.open(encoding="utf-8", newline="") as file:
        rows = csv.DictReader(file)
        if missing := [name for name in COLUMNS if name not in (rows.fieldnames or ())]:
            raise ConfigurationError(path, f"the columns {', '.join(missing)} are missing", WHAT)
        for number, row in enumerate(rows, 2):
            try:
                values = np.array([float(row[name]) for name in COLUMNS[1:]])
            except (TypeError, ValueError):
                raise ConfigurationError(
                    path, f"line {number}: seven numbers belong behind the picture", WHAT
                ) from None
            norm = np.linalg.norm(values[3:])
            if not (np.all(np.isfinite(values)) and 0.9 < norm < 1.1):
                raise ConfigurationError(path, f"line {number}: qw, qx, qy, qz are no unit quaternion", WHAT)
            link = np.eye(4)
            link[:3, :3], link[:3, 3] = matrix_from_quaternion(values[3:] / norm), values[:3]
            yield str(row["picture"]), link
