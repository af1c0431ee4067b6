"""Pictures as files, where no library for them is installed."""

import struct
import zlib

import numpy as np

from sim.world.drawing import Image

_SIGNATURE = b"\x89PNG\r\n\x1a\n"


def png(image: Image) -> bytes:
    """Return a picture as a PNG file's content.

    Args:
        image: In RGB, shape (height, width, 3).
    """
    height, width, _ = image.shape
    rows = np.concatenate([np.zeros((height, 1), np.uint8), image.reshape(height, -1)], axis=1)  # 0: no filter
    header = struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0)
    parts = (b"IHDR", header), (b"IDAT", zlib.compress(rows.tobytes(), 9)), (b"IEND", b"")
    return _SIGNATURE + b"".join(_chunk(*part) for part in parts)


def _chunk(kind: bytes, content: bytes) -> bytes:
    return struct.pack(">I", len(content)) + kind + content + struct.pack(">I", zlib.crc32(kind + content))
