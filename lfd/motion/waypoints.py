"""Teaching by waypoints: a motion through a few poses (thesis, appendix E, OffKey).

Where the gripper takes part a waypoint is a pose and an opening, from there on: between waypoints the opening is not
blended, as what is half closed holds nothing. Where it changes, it does so when the waypoint is reached, and the motion
stands there while the fingers move.
"""

from dataclasses import replace
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike

from lfd.arrays import Array, checked, checked_quaternions
from lfd.bounds import check_points, check_type
from lfd.exceptions import TooFewWaypoints
from lfd.motion.resampling import at_phases, from_samples, ways
from lfd.motion.spline import cubic_spline, quadratic_spline
from lfd.motion.standing import Standing
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory, equal_phases

LEAST_WAYPOINTS = 3

_FINE = 1000  # points at which orientations are known where a motion stands
_LEAST_WAY = 1e-3  # [m] waypoints may coincide, and take their time all the same


class Passing(Enum):
    """When a motion passes its waypoints, and on which spline."""

    EVEN = "even"  # the thesis': at even times, on the quadratic spline of (E.1) to (E.6)
    CENTRIPETAL = "centripetal"  # later the further apart (Lee, 1989), on a cubic spline: it swings out less


def through_waypoints(
    positions: ArrayLike,
    orientations: ArrayLike,
    duration: float,
    n: int = PREDICTION_POINTS,
    passing: Passing = Passing.EVEN,
    *,
    opening: ArrayLike | None = None,
) -> Trajectory:
    """The motion that passes the waypoints, the first at time 0, the last at the end, the others between.

    Positions lie on a spline: by default on the quadratic one of equations (E.1) to (E.6), so the velocity is
    continuous; orientations are interpolated by SLERP, so the angular velocity jumps at a waypoint. Waypoints may
    coincide. The n points of the result are even in time, and meet a waypoint only where one of them has its time:
    all of them, at even times, where n - 1 is a multiple of their number less one. It stands where the gripper opens
    or closes.

    Args:
        positions: Of the k waypoints, shape (k, 3) [m], k at least 3.
        orientations: Unit quaternions (w, x, y, z), shape (k, 4).
        duration: From the first waypoint to the last [s].
        n: Number of points of the result, at least 2.
        passing: When each waypoint is passed.
        opening: Of the gripper from each waypoint on, shape (k,) [m]; None where it takes no part.

    Raises:
        TooFewWaypoints: There are fewer than three.
        TooFewPoints: n is less than 2.
        WrongShape: An array has the wrong shape, or two differ in length.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: An orientation is not a unit quaternion.
        InvalidDuration: The duration is not positive.
        OutOfRange: It is no way of passing, or an opening is negative.
    """
    y = checked("positions", positions, (None, 3))
    if len(y) < LEAST_WAYPOINTS:
        raise TooFewWaypoints(len(y))
    check_points("motion through waypoints", n)
    phases = _passed_at(y, orientations, passing)
    spline = quadratic_spline if passing is Passing.EVEN else cubic_spline
    # Its positions lie on straight lines between the waypoints; only its orientations are kept.
    if opening is None:
        motion = from_samples(phases, y, orientations, n)
        return replace(motion, positions=spline(phases, y, motion.phases), duration=duration)
    standing = Standing.at(phases, checked("opening", opening, (len(y),)), duration)
    times = equal_phases(n)
    on_way = standing.way_at(times)
    motion = at_phases(from_samples(phases, y, orientations, _FINE), on_way)
    there, grasp = spline(phases, y, on_way), standing.opening_at(times)
    return replace(motion, positions=there, duration=duration, opening=grasp)


def passed_at(
    positions: ArrayLike,
    orientations: ArrayLike,
    passing: Passing = Passing.EVEN,
    *,
    opening: ArrayLike | None = None,
    duration: float = 1.0,
) -> Array:
    """The phases at which waypoints are passed, shape (k,), from 0 to 1; arguments and errors as `through_waypoints`.

    Centripetal: the time from one to the next grows with the root of the way between them. A waypoint at which the
    motion stands is passed when it is reached.
    """
    phases = _passed_at(positions, orientations, passing)
    if opening is None:
        return phases
    return Standing.at(phases, checked("opening", opening, (len(phases),)), duration).reached(phases)


def _passed_at(positions: ArrayLike, orientations: ArrayLike, passing: Passing) -> Array:
    check_type("passing", passing, Passing)
    y = checked("positions", positions, (None, 3))
    if passing is Passing.EVEN:
        return np.linspace(0.0, 1.0, len(y))
    q = checked_quaternions("orientations", orientations, (len(y), 4))
    apart = np.maximum(ways(y[:-1], q[:-1], y[1:], q[1:]), _LEAST_WAY)
    times = np.concatenate([[0.0], np.cumsum(np.sqrt(apart))])
    return np.asarray(times / times[-1], dtype=np.float64)
