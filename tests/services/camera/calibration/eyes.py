"""A camera that is known, and what it sees of a board that stands still while a hand carries the camera about."""

import cv2
import numpy as np

from services.camera.calibration.board import Board, Corners
from services.camera.optics import Optics

BOARD = Board()
OPTICS = Optics(640, 480, (590.0, 596.0), (322.0, 236.5), (-0.12, 0.03, 0.0005, -0.0004, 0.0))


def placed(turn, position):
    """A placement (4, 4), by a rotation vector and a position."""
    placement = np.eye(4)
    placement[:3, :3] = cv2.Rodrigues(np.asarray(turn, dtype=np.float64))[0]
    placement[:3, 3] = position
    return placement


MOUNTING = placed((0.3, -1.2, 0.7), (0.04, -0.03, 0.09))
"""Of the camera on the link."""


def poses(rng, count, tilt=0.5):
    """Placements of the board in the camera, in sight of it and tilted to each side by up to so much [rad]."""
    middle = np.append(np.array([BOARD.columns, BOARD.rows]) * BOARD.square / 2, 0.0)
    made = []
    for _ in range(count):
        board = placed(rng.uniform(-tilt, tilt, 3), np.zeros(3))
        towards = np.array([*rng.uniform(-0.06, 0.06, 2), rng.uniform(0.4, 0.6)])
        board[:3, 3] = towards - board[:3, :3] @ middle
        made.append(board)
    return np.array(made)


def links(boards, mounting=MOUNTING, stands=None):
    """Where the link has to be for the camera to see the board so."""
    stands = placed((0.1, 0.2, -0.3), (0.8, 0.1, 0.4)) if stands is None else stands
    return np.array([stands @ np.linalg.inv(mounting @ board) for board in boards])


def corners(board, optics=OPTICS):
    """All of the board's, without noise."""
    x, y = np.meshgrid(np.arange(1, BOARD.columns), np.arange(1, BOARD.rows))
    places = np.stack([x.ravel(), y.ravel(), np.zeros(x.size)], axis=1) * BOARD.square
    pixels, _ = cv2.projectPoints(places, board[:3, :3], board[:3, 3], optics.matrix, np.array(optics.distortion))
    return Corners(places, pixels.reshape(-1, 2))


def angle(one, other):
    """Between two rotations [rad]."""
    return float(np.linalg.norm(cv2.Rodrigues(one[:3, :3].T @ other[:3, :3])[0]))
