"""Position and orientation of one frame in another."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class Pose:
    """Pose of a frame, expressed in the robot's base frame unless said otherwise.

    Attributes:
        position: Origin, shape (3,) [m].
        orientation: Unit quaternion, scalar first, shape (4,).
    """

    position: Array
    orientation: Array
