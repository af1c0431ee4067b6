"""The board: a chessboard whose light squares carry ArUco markers, so that a part of it is enough."""

from __future__ import annotations

import struct
import zlib
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np
from numpy.typing import NDArray

from services.bus.arrays import Floats

Grey = NDArray[np.uint8]

MARKER_SHARE = 0.75
"""Of a square's edge."""

_DICTIONARY = cv2.aruco.DICT_5X5_100  # no objects' markers are of it
_PIXELS = 120  # a printed square's edge
_RIM = 0.5  # of white around the squares, in their edges: markers are found against it
_FEWEST_CORNERS = 6


@dataclass(frozen=True, eq=False)
class Corners:
    """What a picture shows of the board.

    Attributes:
        places: of the corners on the board, shape (n, 3) [m].
        pixels: of the same in the picture, the pixels' centres at whole numbers, shape (n, 2) [pixel].
    """

    places: Floats
    pixels: Floats


@dataclass(frozen=True)
class Board:
    """Its frame is at a corner of the squares: x along the columns, y along the rows, z into the board.

    Attributes:
        columns: of squares.
        rows: of squares.
        square: edge of one [m].
    """

    columns: int = 7
    rows: int = 5
    square: float = 0.04

    @property
    def size(self) -> tuple[float, float]:
        """Of the printed picture with its white rim [m]."""
        return (self.columns + 2 * _RIM) * self.square, (self.rows + 2 * _RIM) * self.square

    @property
    def rim(self) -> float:
        """Of white around the squares [m]."""
        return _RIM * self.square

    @cached_property
    def _known(self) -> cv2.aruco.CharucoBoard:
        dictionary = cv2.aruco.getPredefinedDictionary(_DICTIONARY)
        return cv2.aruco.CharucoBoard((self.columns, self.rows), self.square, MARKER_SHARE * self.square, dictionary)

    @cached_property
    def _detector(self) -> cv2.aruco.CharucoDetector:
        return cv2.aruco.CharucoDetector(self._known)

    def picture(self) -> Grey:
        """To be printed, its rim included."""
        width, height = round(self.columns * _PIXELS), round(self.rows * _PIXELS)
        rim = round(_RIM * _PIXELS)
        squares = self._known.generateImage((width, height))
        return np.asarray(np.pad(squares, rim, constant_values=255), dtype=np.uint8)

    def png(self) -> bytes:
        """The picture as a file that says how large it is: printed at 100 % it has its size."""
        file: bytes = cv2.imencode(".png", self.picture())[1].tobytes()
        per_metre = round(_PIXELS / self.square)
        said = b"pHYs" + struct.pack(">IIB", per_metre, per_metre, 1)
        chunk = struct.pack(">I", 9) + said + struct.pack(">I", zlib.crc32(said))
        head = len(b"\x89PNG\r\n\x1a\n") + 4 + 4 + 13 + 4  # what a reader has to know before all else
        return file[:head] + chunk + file[head:]

    def find(self, picture: Grey) -> Corners | None:
        """What a picture shows of the board; None where that is too little to be of use.

        Args:
            picture: grey, shape (height, width).
        """
        pixels, numbers, _, _ = self._detector.detectBoard(picture)
        if numbers is None or len(numbers) < _FEWEST_CORNERS:
            return None
        places = np.asarray(self._known.getChessboardCorners(), dtype=np.float64)[np.ravel(numbers)]
        if len(set(places[:, 0])) == 1 or len(set(places[:, 1])) == 1:  # on one line
            return None
        return Corners(places, np.asarray(pixels, dtype=np.float64).reshape(-1, 2))
