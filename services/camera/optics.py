"""How a camera sees: the pinhole, and the lens before it."""

from __future__ import annotations

import math
from dataclasses import dataclass
from functools import cached_property

import cv2
import numpy as np

from services.bus.arrays import Colours, Floats


@dataclass(frozen=True)
class Optics:
    """Of pictures of one size; the pixels' centres are at whole numbers.

    Attributes:
        width: [pixel].
        height: [pixel].
        focal: along rows and along columns [pixel].
        centre: where the optical axis meets the picture: column and row [pixel].
        distortion: of the lens: k1, k2, p1, p2, k3 (D. Brown, Decentering Distortion of Lenses, 1966); empty for none.
    """

    width: int
    height: int
    focal: tuple[float, float]
    centre: tuple[float, float]
    distortion: tuple[float, ...] = ()

    @cached_property
    def matrix(self) -> Floats:
        """Of the pinhole, shape (3, 3) [pixel]."""
        (fx, fy), (cx, cy) = self.focal, self.centre
        return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])

    def of_size(self, width: int, height: int) -> Optics:
        """Of the same pictures, made larger or smaller."""
        x, y = width / self.width, height / self.height
        (fx, fy), (cx, cy) = self.focal, self.centre
        centre = (x * (cx + 0.5) - 0.5, y * (cy + 0.5) - 0.5)
        return Optics(width, height, (x * fx, y * fy), centre, self.distortion)

    def straightened(self, image: Colours) -> Colours:
        """A picture of this size as it is without the lens' distortion."""
        return image if self._ways is None else np.asarray(cv2.remap(image, *self._ways, cv2.INTER_LINEAR), np.uint8)

    def straightened_depth(self, depth: Floats) -> Floats:
        """The same of a depth picture, without a value between two surfaces."""
        if self._ways is None:
            return depth
        return np.asarray(cv2.remap(depth.astype(np.float32), *self._ways, cv2.INTER_NEAREST), np.float64)

    @cached_property
    def _ways(self) -> tuple[Floats, Floats] | None:
        if not any(self.distortion):
            return None
        lens, size = np.array(self.distortion), (self.width, self.height)
        rows, columns = cv2.initUndistortRectifyMap(self.matrix, lens, np.eye(3), self.matrix, size, cv2.CV_32FC1)
        return np.asarray(rows), np.asarray(columns)


def pinhole(fovy: float, width: int, height: int) -> Optics:
    """Of a camera with square pixels that looks through the middle of its picture.

    Args:
        fovy: vertical field of view [deg].
        width: [pixel].
        height: [pixel].
    """
    focal = height / 2 / math.tan(math.radians(fovy) / 2)
    return Optics(width, height, (focal, focal), ((width - 1) / 2, (height - 1) / 2))
