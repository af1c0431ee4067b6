"""Rotation vectors in base axes that lead from one orientation to another; quaternions are scalar first.

MuJoCo has the same for one quaternion at a time. A person's plan turns whole motions, and the processes that stand in
for a person load no physics.
"""

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


def rotated(orientations: Array, vectors: Array) -> Array:
    """Orientations rotated in base axes: exp(r) q.

    Args:
        orientations: Unit quaternions, shape (..., 4).
        vectors: Rotation vectors r, shape (..., 3) [rad].
    """
    half = 0.5 * np.linalg.norm(vectors, axis=-1, keepdims=True)
    return _product(np.concatenate([np.cos(half), 0.5 * np.sinc(half / np.pi) * vectors], axis=-1), orientations)


def rotation_to(before: Array, after: Array) -> Array:
    """The rotation vectors r, of at most pi, for which exp(r) before = after, shape (..., 3) [rad].

    Args:
        before: Unit quaternions, shape (..., 4).
        after: Unit quaternions, shape (..., 4); as for `before` their signs do not matter.
    """
    between = _product(after, before * np.array([1.0, -1.0, -1.0, -1.0]))
    between = np.where(between[..., :1] < 0.0, -between, between)
    sine = np.linalg.norm(between[..., 1:], axis=-1, keepdims=True)
    half = np.arctan2(sine, between[..., :1])
    return np.asarray(2.0 / np.sinc(half / np.pi) * between[..., 1:], dtype=np.float64)


def turned(orientation: Array, vector: Array) -> Array:
    """Return a vector as it is when what it belongs to is turned, shape (3,).

    Args:
        orientation: Unit quaternion, shape (4,).
        vector: Shape (3,).
    """
    conjugate = orientation * np.array([1.0, -1.0, -1.0, -1.0])
    return np.asarray(_product(_product(orientation, np.array([0.0, *vector])), conjugate)[1:])


def _product(p: Array, q: Array) -> Array:
    pw, px, py, pz = (p[..., i] for i in range(4))
    qw, qx, qy, qz = (q[..., i] for i in range(4))
    product = (
        pw * qw - px * qx - py * qy - pz * qz,
        pw * qx + px * qw + py * qz - pz * qy,
        pw * qy - px * qz + py * qw + pz * qx,
        pw * qz + px * qy - py * qx + pz * qw,
    )
    return np.stack(product, axis=-1)
