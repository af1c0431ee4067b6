"""Teaching by waypoints: a motion through a few poses (thesis, appendix E, OffKey)."""

from dataclasses import replace

import numpy as np
from numpy.typing import ArrayLike

from lfd.arrays import checked
from lfd.bounds import check_points
from lfd.exceptions import TooFewWaypoints
from lfd.motion.resampling import at_phases
from lfd.motion.spline import quadratic_spline
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory

LEAST_WAYPOINTS = 3


def through_waypoints(
    positions: ArrayLike, orientations: ArrayLike, duration: float, n: int = PREDICTION_POINTS
) -> Trajectory:
    """The motion that passes the waypoints, the first at time 0, the last at the end, the others evenly between.

    Positions lie on the quadratic spline of equations (E.1) to (E.6), so the velocity is continuous; orientations are
    interpolated by SLERP, so the angular velocity jumps at a waypoint. Waypoints may coincide. The n points of the
    result are even in time as well, and meet all waypoints only where n - 1 is a multiple of their number less one.

    Args:
        positions: Of the k waypoints, shape (k, 3) [m], k at least 3.
        orientations: Unit quaternions (w, x, y, z), shape (k, 4).
        duration: From the first waypoint to the last [s].
        n: Number of points of the result, at least 2.

    Raises:
        TooFewWaypoints: There are fewer than three.
        TooFewPoints: n is less than 2.
        WrongShape: An array has the wrong shape, or the two differ in length.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: An orientation is not a unit quaternion.
        InvalidDuration: The duration is not positive.
    """
    y = checked("positions", positions, (None, 3))
    if len(y) < LEAST_WAYPOINTS:
        raise TooFewWaypoints(len(y))
    check_points("motion through waypoints", n)
    waypoints = Trajectory(y, np.asarray(orientations, dtype=np.float64), duration)
    phases = np.linspace(0.0, 1.0, n)
    # Its positions lie on straight lines between the waypoints; only its orientations are kept.
    motion = at_phases(waypoints, phases)
    return replace(motion, positions=quadratic_spline(waypoints.phases, waypoints.positions, phases))
