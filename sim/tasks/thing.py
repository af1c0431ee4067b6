"""What a task is about: an object that stands somewhere, and the marker on its lid by which it is seen."""

import math
from dataclasses import dataclass
from functools import cached_property

import numpy as np

from sim.pose import Pose
from sim.region import Region
from sim.tasks.scene import Box, Vector

_LID_HEIGHT = 0.006  # [m]
_BLUE = (0.20, 0.45, 0.70, 1.0)

FAMILIES: dict[str, tuple[int, int]] = {
    **{f"DICT_{n}X{n}_{count}": (n, count) for n in (4, 5, 6, 7) for count in (50, 100, 250, 1000)},
    "DICT_ARUCO_ORIGINAL": (5, 1024),
    "DICT_APRILTAG_16h5": (4, 30),
    "DICT_APRILTAG_25h9": (5, 35),
    "DICT_APRILTAG_36h10": (6, 2320),
    "DICT_APRILTAG_36h11": (6, 587),
}
"""Markers that there are, as OpenCV calls their dictionaries: cells along an edge, without the frame, and how many."""


@dataclass(frozen=True)
class Tag:
    """A fiducial marker; its axes are ArUco's: x right, y up, z out of the print.

    Attributes:
        dictionary: One of `FAMILIES`.
        id: In the dictionary.
        size: Edge of the black square [m].
    """

    dictionary: str = "DICT_4X4_50"
    id: int = 7
    size: float = 0.06

    @property
    def cells(self) -> int:
        """Along an edge, with the black frame."""
        return FAMILIES[self.dictionary][0] + 2

    @property
    def lid(self) -> Vector:
        """Size of the lid that it is printed on, with a white rim of half a cell [m]."""
        edge = round(self.size * (self.cells + 1) / self.cells, 9)
        return (edge, edge, _LID_HEIGHT)


@dataclass(frozen=True)
class Thing:
    """An object that stands upright and can be moved; its frame is at the centre of body and lid.

    Attributes:
        name: Unique in its task.
        size: Full edge lengths of body and lid together; of a cylinder its diameter, twice, and its height [m].
        mass: [kg].
        region: Where its centre can be [m].
        round: It is a cylinder; else a box.
        tag: On its lid; None where it has neither.
        rgba: Colour of its body.
    """

    name: str
    size: Vector
    mass: float
    region: Region
    round: bool = False
    tag: Tag | None = None
    rgba: tuple[float, float, float, float] = _BLUE

    @cached_property
    def tag_pose(self) -> Pose:
        """Of the marker in the object's frame: in the middle of its upper side, turned to the right."""
        half = math.sqrt(0.5)
        return Pose(np.array([0.0, 0.0, self.size[2] / 2]), np.array([half, 0.0, 0.0, -half]))

    @property
    def tipping_angle(self) -> float:
        """How far it can be tilted and still fall back onto its foot [rad].

        Its weight pulls it back for as long as its centre has not passed over the nearest edge of its foot. Over a
        corner it could be tilted further, but nothing says that it leans over one.
        """
        width, depth, height = self.size
        return math.atan(min(width, depth) / height)

    @property
    def stands(self) -> Vector:
        """Where its centre is, of one that no motion is relative to: in the middle of its region [m]."""
        x, y, z = (np.array(self.region.lower) + np.array(self.region.upper)) / 2
        return float(x), float(y), float(z)

    @property
    def box(self) -> Box:
        """As it stands there, for whoever draws boxes."""
        width, depth, height = self.size
        return Box(self.name, self.stands, (width / 2, depth / 2, height / 2), self.rgba)
