"""Where a camera is fixed to the link that carries it (F. Park and B. Martin, Robot Sensor Calibration, 1994).

Wherever the link is, the board is at one place: link X board = constant. Of two poses that is A X = X B, whose
rotations are about axes that X leads into each other; with more of them the best fit in the sense of least squares.
"""

from __future__ import annotations

from typing import NamedTuple

import cv2
import numpy as np

from services.bus.arrays import Floats
from services.camera.exceptions import CalibrationImpossible

LEAST_POSES = 6
LEAST_TURN = np.radians(10.0)
"""Of the hand, about a second axis: turned about one only it tells nothing of where the camera is along that."""


class HandEye(NamedTuple):
    """What was found.

    Attributes:
        mounting: placement of the optical frame in the link's, shape (4, 4).
        spread: root mean square of how far the board, which stood still, seems to be from its mean place [m].
    """

    mounting: Floats
    spread: float


def hand_eye(links: Floats, boards: Floats) -> HandEye:
    """Where the camera is fixed.

    Args:
        links: placement of the camera's link in the frame in which the board stands still, shape (n, 4, 4).
        boards: placement of the board in the camera's optical frame, shape (n, 4, 4).

    Raises:
        CalibrationImpossible: the poses are too few or too much alike; says what to add.
    """
    missing = LEAST_POSES - len(links)
    if missing > 0:
        raise CalibrationImpossible(
            f"{len(links)} poses of the robot with the board in sight: take {missing} more, turned differently"
        )
    first, second = np.triu_indices(len(links), 1)
    moved = np.linalg.inv(links[second]) @ links[first]
    seen = boards[second] @ np.linalg.inv(boards[first])
    turns, turns_seen = _turns(moved), _turns(seen)
    axes = np.linalg.svd(turns, compute_uv=False) / np.sqrt(len(turns))
    if axes[1] < LEAST_TURN:
        how = "is not turned" if axes[0] < LEAST_TURN else "is turned about one axis only"
        raise CalibrationImpossible(
            f"the hand {how} in these {len(links)} poses: turn it by 20 degrees and more about two axes at least"
        )
    u, _, vt = np.linalg.svd(turns.T @ turns_seen)
    rotation = u @ np.diag([1.0, 1.0, np.linalg.det(u @ vt)]) @ vt
    system = moved[:, :3, :3] - np.eye(3)
    wanted = seen[:, :3, 3] @ rotation.T - moved[:, :3, 3]
    position = np.linalg.lstsq(system.reshape(-1, 3), wanted.ravel(), rcond=None)[0]
    mounting = np.eye(4)
    mounting[:3, :3], mounting[:3, 3] = rotation, position
    stood = (links @ mounting @ boards)[:, :3, 3]
    return HandEye(mounting, float(np.sqrt(np.mean(np.sum((stood - stood.mean(axis=0)) ** 2, axis=1)))))


def _turns(placements: Floats) -> Floats:
    """Rotation vectors, shape (n, 3) [rad]."""
    return np.array([cv2.Rodrigues(one[:3, :3])[0].ravel() for one in placements])
