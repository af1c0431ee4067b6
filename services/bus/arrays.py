"""Arrays and motions between NumPy and the wire."""

from __future__ import annotations

import zlib

import numpy as np
from numpy.typing import ArrayLike, NDArray

from protocol.messages import MOST_POINTS, POINT_BYTES, Array, Motion, Quaternion, Vector3
from services.process.exceptions import ServiceError

Floats = NDArray[np.float64]
Colours = NDArray[np.uint8]

_FAST = 1  # half of a cloud's bytes in half a millisecond; a tenth fewer would take four times as long

GREATEST = 1e9
"""As of every other number of a message."""

FARTHEST = 1e6
"""Beyond it nothing is a place, and single precision ends somewhere [m]."""


class NotFinite(ServiceError):
    """An array from the wire holds NaN, infinity, or what is too large to be measured."""

    def __init__(self, count: int) -> None:
        self.count = count
        super().__init__(f"{count} numbers of an array are not finite or beyond {GREATEST:g}")


def to_wire(array: ArrayLike) -> Array:
    """The array as 64-bit floats, any shape."""
    values = np.ascontiguousarray(array, dtype="<f8")
    return Array(dtype="<f8", shape=values.shape, data=values.tobytes())


def from_wire(array: Array) -> Floats:
    """The array, read-only, as 64-bit floats.

    Raises:
        NotFinite: it holds NaN, infinity, or a number beyond `GREATEST`.
    """
    values = np.frombuffer(array.data, dtype=array.dtype).reshape(array.shape).astype(np.float64, copy=False)
    values.flags.writeable = False
    wrong = int(np.size(values) - np.count_nonzero(np.abs(values) <= GREATEST))
    if wrong:
        raise NotFinite(wrong)
    return values


def drawable(array: Array) -> Floats | None:
    """The array's numbers; None where they are nothing that can be drawn: not finite, or far beyond any robot."""
    try:
        values = from_wire(array)
    except NotFinite:
        return None
    return values if np.all(np.abs(values) <= FARTHEST) else None


def motion_to_wire(
    positions: ArrayLike, orientations: ArrayLike, duration: float, opening: ArrayLike | None = None
) -> Motion:
    """Positions (n, 3) [m], orientations (n, 4), duration [s] and opening (n,) [m], if any, as a message."""
    grasp = None if opening is None else to_wire(opening)
    return Motion(positions=to_wire(positions), orientations=to_wire(orientations), duration=duration, opening=grasp)


def motion_from_wire(motion: Motion) -> tuple[Floats, Floats, float, Floats | None]:
    """Positions (n, 3) [m], orientations (n, 4), duration [s] and opening (n,) [m], if any, of a message.

    In the order in which a `Trajectory` takes them; raises as `from_wire`.
    """
    opening = None if motion.opening is None else from_wire(motion.opening)
    return from_wire(motion.positions), from_wire(motion.orientations), motion.duration, opening


def points_to_wire(positions: Floats, colours: Colours) -> bytes:
    """Positions (n, 3) [m] within 32 m of the origin and colours (n, 3), RGB, as a `PointCloud` has them."""
    return zlib.compress((1000.0 * positions).round().astype("<i2").tobytes() + colours.tobytes(), _FAST)


def points_unpacked(data: bytes) -> bytes:
    """The bytes of a `PointCloud`'s points, no more than a message's; empty where it holds none."""
    try:
        return zlib.decompressobj().decompress(data, MOST_POINTS * POINT_BYTES)
    except zlib.error:
        return b""


def points_from_wire(data: bytes) -> tuple[Floats, Colours]:
    """Positions (n, 3) [m] and colours (n, 3), RGB, of a `PointCloud`'s bytes."""
    raw = points_unpacked(data)
    n = len(raw) // POINT_BYTES
    positions = np.frombuffer(raw, dtype="<i2", count=3 * n).reshape(n, 3) / 1000.0
    return positions, np.frombuffer(raw, dtype=np.uint8, count=3 * n, offset=6 * n).reshape(n, 3)


def vector3(values: ArrayLike) -> Vector3:
    """Three numbers as a message's vector."""
    x, y, z = np.asarray(values, dtype=np.float64).tolist()
    return (x, y, z)


def quaternion(values: ArrayLike) -> Quaternion:
    """Four numbers, scalar first, as a message's quaternion."""
    w, x, y, z = np.asarray(values, dtype=np.float64).tolist()
    return (w, x, y, z)
