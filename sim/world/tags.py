"""What fiducial markers look like."""

import numpy as np
from numpy.typing import NDArray

from sim.tasks.thing import FAMILIES, Tag

_CELL_PIXELS = 16  # half a cell of the marker's texture

_USUAL = Tag()
_USUAL_BITS = ((1, 1, 0, 0), (0, 1, 0, 0), (1, 1, 1, 1), (0, 0, 1, 0))  # 1 is white


def bits(tag: Tag) -> NDArray[np.uint8]:
    """Return a marker's cells without the black frame, 1 where they are white, shape (n, n).

    Where OpenCV is not installed nothing is drawn either: all markers but the usual one are white there.
    """
    if (tag.dictionary, tag.id) == (_USUAL.dictionary, _USUAL.id):
        return np.array(_USUAL_BITS, dtype=np.uint8)
    n = FAMILIES[tag.dictionary][0]
    try:
        import cv2  # noqa: PLC0415 (a robot's computer has none, and needs none)
    except ImportError:
        return np.ones((n, n), dtype=np.uint8)
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, tag.dictionary))
    marker = np.asarray(cv2.aruco.generateImageMarker(dictionary, tag.id, tag.cells), dtype=np.uint8)
    return marker[1:-1, 1:-1] // 255


def picture(tag: Tag) -> NDArray[np.uint8]:
    """Draw the lid from above: the marker's bits in a black frame, in a white rim, shape (h, w, 3)."""
    cells = np.pad(bits(tag), 1)
    half_cells = np.kron(cells, np.ones((2, 2), dtype=np.uint8))
    framed = np.pad(half_cells, 1, constant_values=1)
    drawn = 255 * np.kron(framed, np.ones((_CELL_PIXELS, _CELL_PIXELS), dtype=np.uint8))
    # The texture's rows run along the lid's y axis, so that it has to be turned to match `Thing.tag_pose`.
    return np.repeat(np.rot90(drawn, -1)[:, :, None], 3, axis=2)
