"""The points that a camera's depth picture shows."""

from __future__ import annotations

import numpy as np

from lfd.motion.rotations import rotate
from protocol.messages import MOST_POINTS, Pose
from services.bus.arrays import Colours, Floats

FARTHEST_M = 4.0
"""As far as depth cameras see; what lies farther away is no concern of the arm's."""


def cloud(image: Colours, depth: Floats, intrinsics: Floats, pose: Pose) -> tuple[Floats, Colours]:
    """Every few pixels' point in the base frame, as many of them as a message holds, and its colour.

    Args:
        image: shape (height, width, 3), RGB.
        depth: along the optical axis, shape (height, width) [m].
        intrinsics: of the pinhole, shape (3, 3) [pixel].
        pose: of the optical frame (x right, y down, z forward) in the base frame.

    Returns:
        Positions, shape (n, 3) [m], and colours, shape (n, 3), of what is nearer than `FARTHEST_M`.
    """
    step = stride(*depth.shape)
    rows, columns = (axis.ravel() for axis in np.mgrid[0 : depth.shape[0] : step, 0 : depth.shape[1] : step])
    far = depth[rows, columns]
    seen = far < FARTHEST_M
    rows, columns, far = rows[seen], columns[seen], far[seen]
    in_camera = far * np.linalg.solve(intrinsics, np.stack([columns, rows, np.ones(len(rows))]))
    return rotate(np.array(pose.orientation), in_camera.T) + pose.position, image[rows, columns]


def stride(height: int, width: int) -> int:
    """The least step from pixel to pixel along rows and columns with which no more than `MOST_POINTS` are taken."""
    step = 1
    while -(-height // step) * -(-width // step) > MOST_POINTS:
        step += 1
    return step
