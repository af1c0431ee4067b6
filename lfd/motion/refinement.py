"""A prediction and its refinement become the trajectory that is learnt: in full (equation (18)), or in a part."""

import numpy as np

from lfd.arrays import Array
from lfd.bounds import FRACTION, SHARE, check_number, check_points
from lfd.motion.dtw import dtw
from lfd.motion.opening import compared, joined_openings, openings
from lfd.motion.part import WHOLE, Part, check_part
from lfd.motion.resampling import at_phases, from_samples, resample
from lfd.motion.rotations import conjugate, multiply, slerp
from lfd.motion.trajectory import PREDICTION_POINTS, Trajectory

BLEND = 0.15
"""Share of a motion in which it goes over from its prediction to a part that was corrected, and back."""


def refine(
    prediction: Trajectory, refinement: Trajectory, alpha: float = 1.0, n: int = PREDICTION_POINTS
) -> Trajectory:
    """The prediction moved by the fraction alpha towards the refinement: tau_d + alpha (tau_hr - tau_d).

    A refinement is the execution that an operator corrected while it ran (teleoperated or kinesthetic correction).

    Both are brought to the number of points of the longer and matched by dynamic time warping, since points at equal
    times do not correspond (thesis, fig. 11). Matched points are blended in position, orientation, opening, time and,
    for the whole, duration; so alpha = 0 is the prediction and alpha = 1 the refinement, each in its own tempo.

    Args:
        prediction: tau_d.
        refinement: tau_hr, in the same frame.
        alpha: From 0 to 1.
        n: Number of points of the result.

    Raises:
        OutOfRange: alpha is not in [0, 1].
        TooFewPoints: n is less than 2.
        OpeningMismatch: The gripper takes part in one of the two only.
    """
    check_number("alpha", alpha, FRACTION)
    check_points("refined motion", n)
    longer = max(prediction.n_points, refinement.n_points)
    old, human = resample(prediction, longer), resample(refinement, longer)
    i, j = dtw(*compared(old, human)).path.T
    phases = (1.0 - alpha) * old.phases[i] + alpha * human.phases[j]
    times = ((1.0 - alpha) * prediction.duration + alpha * refinement.duration) * phases
    positions = (1.0 - alpha) * old.positions[i] + alpha * human.positions[j]
    orientations = slerp(old.orientations[i], human.orientations[j], np.full(len(i), alpha))
    # At alpha 0 and 1, or a rounding error from them, the path's repeated indices give one point several times.
    times, first = np.unique(times, return_index=True)
    both = openings(old, human)
    opening = None if both is None else ((1.0 - alpha) * both[0][i] + alpha * both[1][j])[first]
    return from_samples(times, positions[first], orientations[first], n, opening)


def joined(prediction: Trajectory, correction: Trajectory, part: Part, blend: float = BLEND) -> Trajectory:
    """The correction between two phases and the prediction elsewhere, smoothly joined (partial, local refinement).

    Nothing that the correction says outside its part counts. Beyond each end of the part the difference of the two
    decays to nothing: of positions as the cubic Hermite polynomial from its value and slope there to zero, so that the
    path has a continuous tangent; of orientations by SLERP. The tempo goes over in the same time. A part that ends
    nearer than the blend to an end of the motion leaves the room that there is, and that end as predicted. Openings are
    not led over: see `joined_openings`.

    Args:
        prediction: Of the whole motion.
        correction: Of the whole motion too, of which the part counts, in the same frame.
        part: First and last phase of the correction that count, each from 0 to 1.
        blend: Share of the motion, above 0 and at most 1, that each joint may take.

    Returns:
        As many points as the longer of the two, in its own tempo: the prediction's outside the part and its joints, the
        correction's inside. A whole part is the correction itself.

    Raises:
        OutOfRange: A phase is not from 0 to 1, or the blend not above 0 and at most 1.
        EmptyPart: The part does not end after it begins.
        OpeningMismatch: The gripper takes part in one of the two only.
    """
    check_part(part)
    check_number("blend", blend, SHARE)
    if part == WHOLE:
        return correction
    n = max(prediction.n_points, correction.n_points)
    phases, duration = _tempo(prediction.duration, correction.duration, part, blend, n)
    old, new = at_phases(prediction, phases), at_phases(correction, phases)
    within = (phases >= part[0]) & (phases <= part[1])
    both = openings(old, new)
    opening = None if both is None else joined_openings(*both, within)
    inside = within[:, None]
    positions = np.where(inside, new.positions, old.positions)
    orientations = np.where(inside, new.orientations, old.orientations)
    step = min(1.0 / (n - 1), part[1] - part[0])
    for edge, outwards, width in _joints(part, blend):
        distance = outwards * (phases - edge)
        near = (distance > 0.0) & (distance < width)
        u = distance[near] / width
        at = np.array([edge, edge - outwards * step])
        there, said = at_phases(prediction, at), at_phases(correction, at)
        gap, inner = said.positions - there.positions
        bend = (u * (1.0 - u) ** 2)[:, None] * width * (gap - inner) / step
        positions[near] += _kept(u)[:, None] * gap + bend
        turn = multiply(conjugate(there.orientations[0]), said.orientations[0])
        orientations[near] = slerp(old.orientations[near], multiply(old.orientations[near], turn), _kept(u))
    return Trajectory(positions, orientations, duration, opening)


def _joints(part: Part, blend: float) -> tuple[tuple[float, float, float], ...]:
    """Where each joint begins, in which direction it leads, and what room it has [phase]."""
    first, last = part
    return (first, -1.0, min(blend, first)), (last, 1.0, min(blend, 1.0 - last))


def _kept(u: Array) -> Array:
    """What is left of a difference at a share u (n,) of a joint: from 1 to 0, level at both ends."""
    kept: Array = (1.0 + 2.0 * u) * (1.0 - u) ** 2
    return kept


def _tempo(old: float, new: float, part: Part, blend: float, n: int) -> tuple[Array, float]:
    """The phases (n,) at equal times of a motion whose pace goes over between two durations, and its duration [s].

    A phase takes dt = (old + w (new - old)) dphase, where w is 1 in the part and `_kept` in its joints.
    """
    corners = [edge + outwards * share * width for edge, outwards, width in _joints(part, blend) for share in (0, 1)]
    grid = np.union1d(np.linspace(0.0, 1.0, 8 * n), np.clip(corners, 0.0, 1.0))
    covered = np.clip(grid - part[0], 0.0, part[1] - part[0])
    for edge, outwards, width in _joints(part, blend):
        if width > 0.0:
            u = np.clip(outwards * (grid - edge), 0.0, width) / width
            behind = u - u**3 + 0.5 * u**4  # the integral of `_kept`, 1/2 over the whole joint
            covered += width * (behind if outwards > 0.0 else 0.5 - behind)
    times = old * grid + (new - old) * covered
    return np.interp(np.linspace(0.0, times[-1], n), times, grid), float(times[-1])
