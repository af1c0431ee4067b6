"""Rigid placements as 4 x 4 matrices: `a_from_b @ b_from_c` is c in a."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

Matrix = NDArray[np.float64]
"""Homogeneous, shape (4, 4); or a rotation, shape (3, 3)."""
Vector = NDArray[np.float64]


def placement(position: ArrayLike, orientation: ArrayLike) -> Matrix:
    """The placement of a frame with this origin (3,) [m] and unit quaternion (4,), scalar first."""
    return assembled(rotation_from_quaternion(orientation), position)


def assembled(rotation: Matrix, position: ArrayLike) -> Matrix:
    """The placement with this rotation (3, 3) and origin (3,) [m]."""
    result = np.eye(4)
    result[:3, :3] = rotation
    result[:3, 3] = np.asarray(position, dtype=np.float64).ravel()
    return result


def inverse(matrix: Matrix) -> Matrix:
    """The placement the other way round."""
    transposed = matrix[:3, :3].T
    return assembled(transposed, -transposed @ matrix[:3, 3])


def rotation_from_quaternion(orientation: ArrayLike) -> Matrix:
    """The rotation matrix of a quaternion (4,), scalar first; it is normalised."""
    q = np.asarray(orientation, dtype=np.float64)
    w, x, y, z = q / np.linalg.norm(q)
    return np.array(
        [
            [1 - 2 * (y * y + z * z), 2 * (x * y - w * z), 2 * (x * z + w * y)],
            [2 * (x * y + w * z), 1 - 2 * (x * x + z * z), 2 * (y * z - w * x)],
            [2 * (x * z - w * y), 2 * (y * z + w * x), 1 - 2 * (x * x + y * y)],
        ]
    )


def quaternion_from_rotation(rotation: Matrix) -> Vector:
    """The unit quaternion (4,), scalar first and not negative, of a rotation matrix.

    The rotation is the eigenvector of a symmetric matrix to its largest eigenvalue (Bar-Itzhack 2000): no branches,
    no loss of digits near half a turn.
    """
    (a, b, c), (d, e, f), (g, h, i) = rotation
    symmetric = np.array(
        [
            [a + e + i, h - f, c - g, d - b],
            [h - f, a - e - i, b + d, c + g],
            [c - g, b + d, e - a - i, f + h],
            [d - b, c + g, f + h, i - a - e],
        ]
    )
    q: Vector = np.linalg.eigh(symmetric)[1][:, -1]
    return -q if q[0] < 0 else q


def angle_between(first: Matrix, second: Matrix) -> float:
    """The angle of the rotation that leads from one placement or rotation to the other [rad]."""
    cosine = (np.trace(first[:3, :3].T @ second[:3, :3]) - 1.0) / 2.0
    return float(np.arccos(np.clip(cosine, -1.0, 1.0)))
