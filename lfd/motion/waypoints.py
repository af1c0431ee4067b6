"""Teaching by waypoints: a motion through a few poses (thesis, appendix E, OffKey)."""

from dataclasses import replace
from enum import Enum

import numpy as np
from numpy.typing import ArrayLike

from lfd.arrays import Array, checked, checked_quaternions
from lfd.bounds import check_points, check_type
from lfd.exceptions import TooFewWaypoints
from lfd.motion.resampling import from_samples, ways
from lfd.motion.spline import cubic_spline, quadratic_spline
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory

LEAST_WAYPOINTS = 3

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
) -> Trajectory:
    """The motion that passes the waypoints, the first at time 0, the last at the end, the others between.

    Positions lie on a spline: by default on the quadratic one of equations (E.1) to (E.6), so the velocity is
    continuous; orientations are interpolated by SLERP, so the angular velocity jumps at a waypoint. Waypoints may
    coincide. The n points of the result are even in time, and meet a waypoint only where one of them has its time:
    all of them, at even times, where n - 1 is a multiple of their number less one.

    Args:
        positions: Of the k waypoints, shape (k, 3) [m], k at least 3.
        orientations: Unit quaternions (w, x, y, z), shape (k, 4).
        duration: From the first waypoint to the last [s].
        n: Number of points of the result, at least 2.
        passing: When each waypoint is passed.

    Raises:
        TooFewWaypoints: There are fewer than three.
        TooFewPoints: n is less than 2.
        WrongShape: An array has the wrong shape, or the two differ in length.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: An orientation is not a unit quaternion.
        InvalidDuration: The duration is not positive.
        OutOfRange: It is no way of passing.
    """
    y = checked("positions", positions, (None, 3))
    if len(y) < LEAST_WAYPOINTS:
        raise TooFewWaypoints(len(y))
    check_points("motion through waypoints", n)
    phases = passed_at(y, orientations, passing)
    # Its positions lie on straight lines between the waypoints; only its orientations are kept.
    motion = from_samples(phases, y, orientations, n)
    spline = quadratic_spline if passing is Passing.EVEN else cubic_spline
    return replace(motion, positions=spline(phases, y, motion.phases), duration=duration)


def passed_at(positions: ArrayLike, orientations: ArrayLike, passing: Passing = Passing.EVEN) -> Array:
    """The phases at which waypoints are passed, shape (k,), from 0 to 1; arguments and errors as `through_waypoints`.

    Centripetal: the time from one to the next grows with the root of the way between them.
    """
    check_type("passing", passing, Passing)
    y = checked("positions", positions, (None, 3))
    if passing is Passing.EVEN:
        return np.linspace(0.0, 1.0, len(y))
    q = checked_quaternions("orientations", orientations, (len(y), 4))
    apart = np.maximum(ways(y[:-1], q[:-1], y[1:], q[1:]), _LEAST_WAY)
    times = np.concatenate([[0.0], np.cumsum(np.sqrt(apart))])
    return np.asarray(times / times[-1], dtype=np.float64)
