"""A camera's calibration, from a folder of pictures of the board."""

from __future__ import annotations

from collections.abc import Sequence

import cv2
import numpy as np

from lfd.motion.rotations import exp_map
from services.bus.arrays import Floats, quaternion, vector3
from services.camera.calibration.board import Board
from services.camera.calibration.hand_eye import hand_eye
from services.camera.calibration.intrinsics import intrinsics
from services.camera.calibration.views import View
from services.camera.exceptions import CalibrationImpossible
from services.process.calibration import Calibration, Fixed


def calibration(views: Sequence[View], board: Board, link: str) -> Calibration:
    """What the pictures say of the camera; where it is fixed, too, where their poses were noted.

    Args:
        views: at least one.
        board: in them.
        link: that carries the camera.

    Raises:
        CalibrationImpossible: the pictures are too few, too much alike or of several sizes; says what to add.
    """
    height, width = views[0].picture.shape
    odd = next((view for view in views if view.picture.shape != (height, width)), None)
    if odd is not None:
        raise CalibrationImpossible(f"{odd.file.name} is of another size than {views[0].file.name}: take one size")
    found = [(view, corners) for view in views if (corners := board.find(view.picture)) is not None]
    seen = intrinsics([corners for _, corners in found], width, height)
    optics, (k1, k2, p1, p2, k3) = seen.optics, seen.optics.distortion
    noted = [(view.link, placed) for (view, _), placed in zip(found, seen.boards, strict=True) if view.link is not None]
    return Calibration(
        width=width,
        height=height,
        focal=optics.focal,
        centre=optics.centre,
        distortion=(k1, k2, p1, p2, k3),
        pictures=len(found),
        error=seen.error,
        fixed=_fixed(link, np.array([one for one, _ in noted]), np.array([one for _, one in noted])) if noted else None,
    )


def _fixed(link: str, links: Floats, boards: Floats) -> Fixed:
    found = hand_eye(links, boards)
    turn = np.ravel(np.asarray(cv2.Rodrigues(found.mounting[:3, :3])[0], dtype=np.float64))
    position, orientation = vector3(found.mounting[:3, 3]), quaternion(exp_map(turn))
    return Fixed(link, position, orientation, poses=len(links), spread=found.spread)
