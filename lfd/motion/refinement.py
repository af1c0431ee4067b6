"""Equation (18): a prediction and its refinement become the trajectory that is learnt."""

import numpy as np

from lfd.bounds import FRACTION, check_number, check_points
from lfd.motion.dtw import dtw
from lfd.motion.resampling import from_samples, resample
from lfd.motion.rotations import slerp
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory


def refine(
    prediction: Trajectory, refinement: Trajectory, alpha: float = 1.0, n: int = PREDICTION_POINTS
) -> Trajectory:
    """The prediction moved by the fraction alpha towards the refinement: tau_d + alpha (tau_hr - tau_d).

    A refinement is the execution that an operator corrected while it ran (teleoperated or kinesthetic correction).

    Both are brought to the number of points of the longer and matched by dynamic time warping, since points at equal
    times do not correspond (thesis, fig. 11). Matched points are blended in position, orientation, time and, for the
    whole, duration; so alpha = 0 is the prediction and alpha = 1 the refinement, each in its own tempo.

    Args:
        prediction: tau_d.
        refinement: tau_hr, in the same frame.
        alpha: From 0 to 1.
        n: Number of points of the result.

    Raises:
        OutOfRange: alpha is not in [0, 1].
        TooFewPoints: n is less than 2.
    """
    check_number("alpha", alpha, FRACTION)
    check_points("refined motion", n)
    longer = max(prediction.n_points, refinement.n_points)
    old, human = resample(prediction, longer), resample(refinement, longer)
    i, j = dtw(old.positions, human.positions).path.T
    phases = (1.0 - alpha) * old.phases[i] + alpha * human.phases[j]
    times = ((1.0 - alpha) * prediction.duration + alpha * refinement.duration) * phases
    positions = (1.0 - alpha) * old.positions[i] + alpha * human.positions[j]
    orientations = slerp(old.orientations[i], human.orientations[j], np.full(len(i), alpha))
    # At alpha 0 and 1, or a rounding error from them, the path's repeated indices give one point several times.
    times, first = np.unique(times, return_index=True)
    return from_samples(times, positions[first], orientations[first], n)
