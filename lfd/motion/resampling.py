"""Resampling: the same motion at other times."""

from enum import Enum

import numpy as np
from numpy.typing import ArrayLike

from lfd.arrays import Array, checked, checked_quaternions
from lfd.bounds import check_points, check_type
from lfd.exceptions import TimesNotIncreasing, WrongShape
from lfd.motion.rotations import sign_continuous, slerp
from lfd.motion.spline import cubic_spline
from lfd.motion.trajectory import Trajectory, equal_phases


class Interpolation(Enum):
    """How positions are interpolated; orientations always are by SLERP."""

    LINEAR = "linear"  # the thesis' choice
    CUBIC = "cubic"  # a not-a-knot cubic spline: smooth velocity


def resample(trajectory: Trajectory, n: int, interpolation: Interpolation = Interpolation.LINEAR) -> Trajectory:
    """The same trajectory with n points at equal times; the end points and the duration stay.

    Args:
        trajectory: Any number of points.
        n: Number of points of the result, at least 2.
        interpolation: Of the positions.

    Raises:
        TooFewPoints: n is less than 2.
        OutOfRange: It is no whole number, or the interpolation none.
    """
    check_points("resampled trajectory", n)
    check_type("interpolation", interpolation, Interpolation)
    return at_phases(trajectory, equal_phases(n), interpolation)


def at_phases(trajectory: Trajectory, phases: Array, interpolation: Interpolation = Interpolation.LINEAR) -> Trajectory:
    """The poses of a trajectory at given phases in [0, 1], shape (n,), with the trajectory's own duration.

    Positions by the interpolation, orientations by SLERP, both in the trajectory's frame.
    """
    return Trajectory(*poses_at(trajectory, phases, interpolation), trajectory.duration)


def poses_at(
    trajectory: Trajectory, phases: Array, interpolation: Interpolation = Interpolation.LINEAR
) -> tuple[Array, Array]:
    """Positions (n, 3) [m] and unit quaternions (n, 4) of a trajectory at phases: see `at_phases`."""
    return _poses_at(trajectory.phases, trajectory.positions, trajectory.orientations, phases, interpolation)


def from_samples(
    times: ArrayLike, positions: ArrayLike, orientations: ArrayLike, n: int, *, index: int | None = None
) -> Trajectory:
    """A trajectory of n points at equal times from raw samples at irregular times (linear, SLERP).

    Args:
        times: Strictly increasing, shape (m,) [s], with any offset.
        positions: Shape (m, 3) [m].
        orientations: Unit quaternions (w, x, y, z), shape (m, 4).
        n: Number of points of the result, at least 2.
        index: Of the motion among several, for the names of arrays in an error.

    Raises:
        TooFewPoints: There are fewer than two samples, or n is less than 2.
        TimesNotIncreasing: Two samples are out of order or have one time.
        NotNumbers: An array holds something else than numbers.
        WrongShape: The arrays do not belong together.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: An orientation is not a unit quaternion.
    """
    of = "" if index is None else f"[{index}]"
    t = checked(f"times{of}", times, (None,))
    p = checked(f"positions{of}", positions, (None, 3))
    q = checked_quaternions(f"orientations{of}", orientations, (None, 4))
    if len(p) != len(t):
        raise WrongShape(f"positions{of}", f"({len(t)}, 3)", p.shape)
    if len(q) != len(t):
        raise WrongShape(f"orientations{of}", f"({len(t)}, 4)", q.shape)
    check_points(f"positions{of}", len(t))
    check_points("resampled trajectory", n)
    backwards = np.flatnonzero(np.diff(t) <= 0.0)
    if backwards.size:
        i = int(backwards[0])
        raise TimesNotIncreasing(i + 1, float(t[i]), float(t[i + 1]), f"times{of}")
    wanted = np.linspace(t[0], t[-1], n)
    return Trajectory(*_poses_at(t, p, sign_continuous(q), wanted), duration=float(t[-1] - t[0]))


def _poses_at(
    times: Array, p: Array, q: Array, wanted: Array, interpolation: Interpolation = Interpolation.LINEAR
) -> tuple[Array, Array]:
    """Of positions p and orientations q at increasing times, at least two: those at wanted times, or at the nearer end.

    The numbers of points from the first one on say which two a time lies between, and how far from the first of them.
    """
    points = np.interp(wanted, times, np.arange(len(times)))
    before = np.minimum(points.astype(np.intp), len(times) - 2)
    after, share = before + 1, points - before
    orientations = slerp(q.take(before, axis=0), q.take(after, axis=0), share)
    if interpolation is Interpolation.CUBIC:
        return cubic_spline(times, p, wanted), orientations
    share = share[:, None]
    return (1.0 - share) * p.take(before, axis=0) + share * p.take(after, axis=0), orientations
