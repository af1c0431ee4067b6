"""A trajectory: poses at a uniform timing, and how far the gripper is open at each."""

import math
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from lfd.arrays import Array, checked, checked_quaternions, frozen
from lfd.bounds import NOT_NEGATIVE
from lfd.exceptions import InvalidDuration, NotFinite, OutOfRange, TooFewPoints, WrongShape
from lfd.motion.rotations import sign_continuous

PREDICTION_POINTS = 75  # the thesis' number of way-points in a prediction


@dataclass(frozen=True, eq=False)
class Trajectory:
    """Poses of the end effector at n equally spaced times from 0 to `duration`, in one frame, the base frame mostly.

    The arrays are copied and read-only; orientations are normalised and made sign-continuous.

    Attributes:
        positions: Shape (n, 3) [m].
        orientations: Unit quaternions (w, x, y, z), shape (n, 4).
        duration: Time from the first to the last point [s].
        opening: Distance between the gripper's fingers, from 0 where it is closed, shape (n,) [m]; None where the
            gripper takes no part in the motion.

    Raises:
        WrongShape: An array has the wrong shape, or two differ in length.
        TooFewPoints: There are fewer than two points.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: An orientation is not a unit quaternion.
        InvalidDuration: The duration is not positive.
        OutOfRange: An opening is negative.
    """

    positions: Array
    orientations: Array
    duration: float
    opening: Array | None = None

    def __post_init__(self) -> None:
        positions = checked("positions", self.positions, (None, 3))
        if len(positions) < 2:
            raise TooFewPoints("positions", len(positions))
        orientations = checked_quaternions("orientations", self.orientations, (None, 4))
        if len(orientations) != len(positions):
            raise WrongShape("orientations", f"({len(positions)}, 4)", orientations.shape)
        if not math.isfinite(self.duration):
            raise NotFinite("duration", ())
        if self.duration <= 0.0:
            raise InvalidDuration(self.duration)
        if self.opening is not None:
            opening = checked("opening", self.opening, (len(positions),))
            if opening.min() < 0.0:
                raise OutOfRange(f"opening[{int(opening.argmin())}]", float(opening.min()), str(NOT_NEGATIVE))
            object.__setattr__(self, "opening", opening)
        object.__setattr__(self, "positions", positions)
        object.__setattr__(self, "orientations", frozen(sign_continuous(orientations)))
        object.__setattr__(self, "duration", float(self.duration))

    @property
    def n_points(self) -> int:
        """Number of points n."""
        return len(self.positions)

    @property
    def times(self) -> Array:
        """Times of the points, shape (n,) [s]."""
        return np.linspace(0.0, self.duration, self.n_points)

    @property
    def phases(self) -> Array:
        """Times of the points as a fraction of the duration, shape (n,), from 0 to 1."""
        return equal_phases(self.n_points)


@lru_cache(maxsize=64)
def equal_phases(n: int) -> Array:
    """Phases from 0 to 1 at n equal times, shape (n,); kept, read-only."""
    return frozen(np.linspace(0.0, 1.0, n))
