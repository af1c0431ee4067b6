"""Depth pictures as messages have them, and back."""

from __future__ import annotations

import struct

import cv2
import numpy as np

from protocol.messages import DepthPicture
from services.bus.arrays import Floats

FARTHEST_M = 60.0
"""What is further away is not told."""

MOST_PIXELS = 1920 * 1080
"""Of a depth picture; more is none."""

_FAST = (cv2.IMWRITE_PNG_COMPRESSION, 1)
_HEAD = struct.Struct(">8s8xIIBB")
"""What a PNG file begins with: its signature, its width and height, the bits of a channel and what the channels are."""


def depth_to_wire(depth: Floats) -> bytes:
    """Distances, shape (height, width) [m], as a `DepthPicture` has them."""
    known = np.isfinite(depth) & (depth > 0.0) & (depth < FARTHEST_M)
    millimetres = np.where(known, 1000.0 * np.where(known, depth, 0.0), 0.0).round().astype(np.uint16)
    return cv2.imencode(".png", millimetres, _FAST)[1].tobytes()


def depth_from_wire(picture: DepthPicture) -> Floats | None:
    """Distances, shape (height, width), infinite where they are not known [m]; None where it is no depth picture.

    What a file says of its size is looked at before anything is made of it.
    """
    if len(picture.data) < _HEAD.size:
        return None
    signature, *said = _HEAD.unpack_from(picture.data)
    if signature != b"\x89PNG\r\n\x1a\n" or said != [picture.width, picture.height, 16, 0]:
        return None
    if not 0 < picture.width * picture.height <= MOST_PIXELS:
        return None
    try:
        read = cv2.imdecode(np.frombuffer(picture.data, np.uint8), cv2.IMREAD_UNCHANGED)
    except cv2.error:
        return None
    if read is None or read.dtype != np.uint16 or read.shape != (picture.height, picture.width):
        return None
    depth = np.asarray(read, dtype=np.float64) / 1000.0
    return np.where(depth > 0.0, depth, np.inf)
