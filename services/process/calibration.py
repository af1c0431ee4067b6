"""What was measured of a robot's cameras: a TOML file a camera, in the user's data folder."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

import msgspec

from services.process.files import data_folder, make_folder, write_whole
from services.process.section import Positive, Section
from services.process.written import read

WHAT = "calibration"

Pair = tuple[float, float]
Pixels = Annotated[int, msgspec.Meta(ge=16, le=8192)]


class Fixed(Section, frozen=True):
    """Where a camera's optical frame (x right, y down, z forward) is fixed.

    Attributes:
        link: of the robot; empty for the base frame.
        position: in the link's frame [m].
        orientation: the same, unit quaternion, scalar first.
        poses: it was measured by.
        spread: of where the board, which stood still, seemed to be: root mean square [m].
    """

    link: str
    position: tuple[float, float, float]
    orientation: tuple[float, float, float, float]
    poses: int
    spread: float


class Calibration(Section, frozen=True):
    """Of one camera.

    Attributes:
        width: of the pictures that it was measured with [pixel].
        height: the same [pixel].
        focal: along rows and along columns [pixel].
        centre: column and row where the optical axis meets the picture, the pixels' centres at whole numbers [pixel].
        distortion: of the lens: k1, k2, p1, p2, k3.
        pictures: it was measured by.
        error: root mean square of what is left [pixel].
        fixed: where the camera is fixed; None where that was not measured.
    """

    width: Pixels
    height: Pixels
    focal: tuple[Positive, Positive]
    centre: Pair
    distortion: tuple[float, float, float, float, float]
    pictures: int
    error: float
    fixed: Fixed | None = None


def calibration_path(robot: str, camera: str) -> Path:
    """Where it belongs.

    Args:
        robot: the robot's name.
        camera: the camera's.

    Raises:
        FolderUnusable: the user's data folder cannot be made or written.
    """
    return data_folder() / robot / "cameras" / f"{camera}.toml"


def load_calibration(robot: str, camera: str) -> Calibration | None:
    """What was measured of a camera; None where nothing was.

    Raises:
        ConfigurationError: the file cannot be used; says why.
        FolderUnusable: see `calibration_path`.
    """
    path = calibration_path(robot, camera)
    return read(path, Calibration, WHAT) if path.exists() else None


def save_calibration(path: Path, found: Calibration) -> None:
    """Write it as `load_calibration` reads it.

    Raises:
        OSError: it cannot be written.
    """
    make_folder(path.parent)
    values = msgspec.to_builtins(found)
    fixed = values.pop("fixed")
    lines = [f"{key} = {msgspec.json.encode(value).decode()}" for key, value in values.items()]
    if fixed is not None:
        lines += ["", "[fixed]", *(f"{key} = {msgspec.json.encode(value).decode()}" for key, value in fixed.items())]
    write_whole(path, ("\n".join(lines) + "\n").encode())
