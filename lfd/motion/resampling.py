"""Resampling: the same motion at other times."""

from enum import Enum

import numpy as np
from numpy.typing import ArrayLike, NDArray

from lfd.arrays import Array, checked, checked_quaternions
from lfd.bounds import check_points, check_type
from lfd.exceptions import TimesNotIncreasing, WrongShape
from lfd.motion.rotations import conjugate, log_map, multiply, sign_continuous, slerp
from lfd.motion.spline import cubic_spline
from lfd.motion.trajectory import Trajectory, equal_phases

TURN_AS_WAY = 0.1
"""A turn of one radian counts as this much of a way [m]: what is so far from the axis moves by as much."""

_NO_WAY = 1e-9  # [m] between two points of a motion that stands


class Interpolation(Enum):
    """How positions are interpolated; orientations always are by SLERP, openings linearly: a spline would swing."""

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


def along_the_way(trajectory: Trajectory, n: int, still: float = 0.005) -> Trajectory:
    """The same way with n points that are equally far apart, however long the motion lingered anywhere on it.

    With points at equal times, the place where a demonstration lingered takes most of them, and elsewhere the few that
    are left lie far apart: the motion jumps there (thesis, Fig. 29). Where the tempo does not matter none of that is.
    What the gripper's fingers move counts as way, so that a motion that stands to grasp still stands to grasp.

    Args:
        trajectory: Any number of points.
        n: Number of points of the result, at least 2.
        still: By less than this a hand trembles, and goes nowhere [m]; a turn of one radian is `TURN_AS_WAY`. The
            result leaves the way by no more.

    Raises:
        TooFewPoints: n is less than 2.
    """
    check_points("resampled trajectory", n)
    kept = _moving(trajectory, still)
    p, q = trajectory.positions.take(kept, axis=0), trajectory.orientations.take(kept, axis=0)
    opening = None if trajectory.opening is None else trajectory.opening.take(kept)
    steps = ways(p[:-1], q[:-1], p[1:], q[1:])
    if opening is not None:
        steps += np.abs(np.diff(opening))
    way = np.concatenate([[0.0], np.cumsum(np.maximum(steps, _NO_WAY))])
    wanted = np.linspace(0.0, way[-1], n)
    return Trajectory(*_poses_at(way, p, q, wanted), trajectory.duration, _opening_at(way, opening, wanted))


def _moving(trajectory: Trajectory, still: float) -> NDArray[np.intp]:
    """Numbers of the points that lead on: each further than `still` from the one before; the first and the last."""
    p, q, opening = trajectory.positions, trajectory.orientations, trajectory.opening
    kept = [0]
    for i in range(1, len(p) - 1):
        last = kept[-1]
        grasped = 0.0 if opening is None else abs(opening[i] - opening[last])
        if ways(p[last], q[last], p[i], q[i]) + grasped > still:
            kept.append(i)
    return np.array([*kept, len(p) - 1])


def ways(p: Array, q: Array, p_next: Array, q_next: Array) -> Array:
    """From poses to others [m], shape (...): a turn counts as `TURN_AS_WAY` a radian."""
    turns = log_map(multiply(conjugate(q), q_next))
    return np.asarray(
        np.linalg.norm(p_next - p, axis=-1) + TURN_AS_WAY * np.linalg.norm(turns, axis=-1), dtype=np.float64
    )


def at_phases(trajectory: Trajectory, phases: Array, interpolation: Interpolation = Interpolation.LINEAR) -> Trajectory:
    """The poses of a trajectory at given phases in [0, 1], shape (n,), with the trajectory's own duration.

    Positions by the interpolation, orientations by SLERP, both in the trajectory's frame; openings linearly.
    """
    opening = _opening_at(trajectory.phases, trajectory.opening, phases)
    return Trajectory(*poses_at(trajectory, phases, interpolation), trajectory.duration, opening)


def poses_at(
    trajectory: Trajectory, phases: Array, interpolation: Interpolation = Interpolation.LINEAR
) -> tuple[Array, Array]:
    """Positions (n, 3) [m] and unit quaternions (n, 4) of a trajectory at phases: see `at_phases`."""
    return _poses_at(trajectory.phases, trajectory.positions, trajectory.orientations, phases, interpolation)


def from_samples(
    times: ArrayLike,
    positions: ArrayLike,
    orientations: ArrayLike,
    n: int,
    opening: ArrayLike | None = None,
    *,
    index: int | None = None,
) -> Trajectory:
    """A trajectory of n points at equal times from raw samples at irregular times (linear, SLERP).

    Args:
        times: Strictly increasing, shape (m,) [s], with any offset.
        positions: Shape (m, 3) [m].
        orientations: Unit quaternions (w, x, y, z), shape (m, 4).
        n: Number of points of the result, at least 2.
        opening: Of the gripper, shape (m,) [m]; None where it takes no part.
        index: Of the motion among several, for the names of arrays in an error.

    Raises:
        TooFewPoints: There are fewer than two samples, or n is less than 2.
        TimesNotIncreasing: Two samples are out of order or have one time.
        NotNumbers: An array holds something else than numbers.
        WrongShape: The arrays do not belong together.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: An orientation is not a unit quaternion.
        OutOfRange: An opening is negative.
    """
    of = "" if index is None else f"[{index}]"
    t = checked(f"times{of}", times, (None,))
    p = checked(f"positions{of}", positions, (None, 3))
    q = checked_quaternions(f"orientations{of}", orientations, (None, 4))
    if len(p) != len(t):
        raise WrongShape(f"positions{of}", f"({len(t)}, 3)", p.shape)
    if len(q) != len(t):
        raise WrongShape(f"orientations{of}", f"({len(t)}, 4)", q.shape)
    openings = None if opening is None else checked(f"opening{of}", opening, (len(t),))
    check_points(f"positions{of}", len(t))
    check_points("resampled trajectory", n)
    backwards = np.flatnonzero(np.diff(t) <= 0.0)
    if backwards.size:
        i = int(backwards[0])
        raise TimesNotIncreasing(i + 1, float(t[i]), float(t[i + 1]), f"times{of}")
    wanted = np.linspace(t[0], t[-1], n)
    poses = _poses_at(t, p, sign_continuous(q), wanted)
    return Trajectory(*poses, duration=float(t[-1] - t[0]), opening=_opening_at(t, openings, wanted))


def _opening_at(times: Array, opening: Array | None, wanted: Array) -> Array | None:
    """Of openings (n,) at increasing times: those at wanted times, or at the nearer end; None of none."""
    return None if opening is None else np.asarray(np.interp(wanted, times, opening), dtype=np.float64)


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
