"""How a camera sees, from pictures of the board (Z. Zhang, A Flexible New Technique for Camera Calibration, 2000)."""

from __future__ import annotations

from collections.abc import Sequence
from typing import NamedTuple

import cv2
import numpy as np

from services.bus.arrays import Floats
from services.camera.calibration.board import Corners
from services.camera.exceptions import CalibrationImpossible
from services.camera.optics import Optics

LEAST_PICTURES = 8
LEAST_TILT = np.radians(20.0)
"""Between the boards of two pictures: of one that is always seen alike nobody can tell how near it is."""


class Intrinsics(NamedTuple):
    """What was found.

    Attributes:
        optics: of the camera.
        error: root mean square of what is left between where corners are and where they should be [pixel].
        boards: placement of the board in the camera's optical frame in each picture, shape (n, 4, 4).
    """

    optics: Optics
    error: float
    boards: Floats


def intrinsics(found: Sequence[Corners], width: int, height: int) -> Intrinsics:
    """How the camera sees.

    Args:
        found: in each picture.
        width: of the pictures [pixel].
        height: of the pictures [pixel].

    Raises:
        CalibrationImpossible: the pictures are too few or too much alike; says what to add.
    """
    missing = LEAST_PICTURES - len(found)
    if missing > 0:
        raise CalibrationImpossible(
            f"{len(found)} pictures show the board: take {missing} more, of all of it, tilted to each side"
        )
    places = [one.places.astype(np.float32) for one in found]
    pixels = [one.pixels.astype(np.float32) for one in found]
    start = np.array([[width, 0.0, (width - 1) / 2], [0.0, width, (height - 1) / 2], [0.0, 0.0, 1.0]])
    flags = cv2.CALIB_FIX_K3 | cv2.CALIB_USE_INTRINSIC_GUESS
    error, matrix, lens, turns, ways = cv2.calibrateCamera(
        places, pixels, (width, height), start, np.zeros(5), flags=flags
    )
    boards = np.tile(np.eye(4), (len(found), 1, 1))
    boards[:, :3, :3] = [cv2.Rodrigues(turn)[0] for turn in turns]
    boards[:, :3, 3] = np.reshape(ways, (-1, 3))
    out_of_board = boards[:, :3, 2]
    if np.min(out_of_board @ out_of_board.T) > np.cos(LEAST_TILT):
        raise CalibrationImpossible(
            f"the board is seen from the same side in all {len(found)} pictures: tilt it by 20 degrees and more"
        )
    (fx, _, cx), (_, fy, cy), _ = matrix.tolist()
    optics = Optics(width, height, (fx, fy), (cx, cy), tuple(np.ravel(lens)[:5].tolist()))
    return Intrinsics(optics, float(error), boards)
