"""Recordings in plain arrays, as other libraries hold them, become demonstrations."""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from lfd.arrays import Array, checked
from lfd.exceptions import NotNumbers, TooFewDemonstrations, WrongShape
from lfd.motion.demonstration import Demonstration, Situation, checked_condition
from lfd.motion.provenance import UNKNOWN, Provenance
from lfd.motion.resampling import from_samples
from lfd.motion.rotations import IDENTITY

AXES = 3


def demonstration_from_arrays(
    times: ArrayLike,
    positions: ArrayLike,
    condition: ArrayLike,
    orientations: ArrayLike | None = None,
    origin: ArrayLike | None = None,
    *,
    opening: ArrayLike | None = None,
    provenance: Provenance = UNKNOWN,
    index: int | None = None,
) -> Demonstration:
    """A demonstration of one recorded motion.

    Args:
        times: Of the T samples, strictly increasing, with any offset and at any intervals, shape (T,) [s].
        positions: In any one frame, here the base frame, shape (T, D) with D from 1 to 3; axes that are not there are
            zero [m].
        condition: External state that the motion was right for (task parameter, context), shape (C,), or one number.
        orientations: Unit quaternions (w, x, y, z) in that frame, shape (T, 4); none where it did not turn.
        origin: Point that the motion is learnt relative to, shape (D,) [m]; zero where there is none.
        opening: Of the gripper, shape (T,) [m]; None where it takes no part.
        provenance: Whose it is.
        index: Of the motion among several, for the names of arrays in an error.

    Returns:
        The demonstration, with T points at equal times.

    Raises:
        NotNumbers: An array holds something else than numbers, or rows of different lengths.
        WrongShape: An array has the wrong shape, or two do not belong together.
        NotFinite: A number is NaN or infinite.
        TooFewPoints: There are fewer than two samples.
        TimesNotIncreasing: Two samples are out of order or have one time.
        NotUnitQuaternion: An orientation is not a unit quaternion.
        OutOfRange: An opening is negative.
    """
    of = "" if index is None else f"[{index}]"
    path = _with_three_axes(f"positions{of}", positions)
    turns = np.tile(IDENTITY, (len(path), 1)) if orientations is None else orientations
    trajectory = from_samples(times, path, turns, max(len(path), 2), opening, index=index)
    place = _point(f"origin{of}", np.zeros(AXES) if origin is None else origin)
    return Demonstration(trajectory, place, checked_condition(condition, f"condition{of}"), provenance)


def demonstrations_from_arrays(
    times: ArrayLike | Sequence[ArrayLike],
    positions: ArrayLike | Sequence[ArrayLike],
    conditions: ArrayLike | Sequence[ArrayLike],
    orientations: ArrayLike | Sequence[ArrayLike] | None = None,
    origins: ArrayLike | None = None,
    *,
    openings: ArrayLike | Sequence[ArrayLike] | None = None,
    provenance: Provenance = UNKNOWN,
) -> list[Demonstration]:
    """Demonstrations of N recorded motions, each with as many samples as it has.

    Where all have T samples these are arrays of N x T, as other libraries hold them; else sequences of N arrays.

    Args:
        times: Shape (N, T), or (T,) where they are the same for all; see `demonstration_from_arrays`, as for the rest.
        positions: Shape (N, T, D) [m].
        conditions: Shape (N,) or (N, C).
        orientations: Shape (N, T, 4).
        origins: Shape (N, D), or (D,) where there is one for all [m].
        openings: Shape (N, T) [m]; None where the gripper takes no part.
        provenance: Whose they are.

    Raises:
        TooFewDemonstrations: There is none.
        WrongShape: There are not as many of the one as of the other, or the conditions differ in dimension, or see
            `demonstration_from_arrays`, which raises the other errors too, with the motion's index in the name.
    """
    paths, given = _each("positions", positions), _each("conditions", conditions)
    N = len(paths)
    if N == 0:
        raise TooFewDemonstrations
    all_times = [np.asarray(times)] * N if _depth(times) == 1 else _each("times", times)
    turns = [None] * N if orientations is None else _each("orientations", orientations)
    grasps = [None] * N if openings is None else _each("openings", openings)
    shared = origins is None or _depth(origins) == 1
    places = [origins] * N if shared or origins is None else _each("origins", origins)
    several = {"conditions": given, "times": all_times, "orientations": turns, "origins": places, "openings": grasps}
    for name, values in several.items():
        if len(values) != N:
            raise WrongShape(name, f"({N}, ...), as there are {N} motions", (len(values),))
    motions = zip(all_times, paths, given, turns, places, grasps, strict=True)
    made = [
        demonstration_from_arrays(t, path, s, turn, place, opening=grasp, provenance=provenance, index=i)
        for i, (t, path, s, turn, place, grasp) in enumerate(motions)
    ]
    for i, one in enumerate(made):
        if len(one.condition) != len(made[0].condition):
            raise WrongShape(f"conditions[{i}]", f"({len(made[0].condition)},), as the first", one.condition.shape)
    return made


def situation_from_arrays(
    condition: ArrayLike,
    start_position: ArrayLike,
    start_orientation: ArrayLike | None = None,
    origin: ArrayLike | None = None,
) -> Situation:
    """What a motion is to be predicted from.

    Args:
        condition: As of the demonstrations, shape (C,), or one number.
        start_position: Where the motion is to start, in their frame, shape (D,) [m].
        start_orientation: How, a unit quaternion (w, x, y, z); none where nothing turns.
        origin: Point that the motion is relative to, shape (D,) [m]; zero where there is none.

    Raises:
        NotNumbers: An array holds something else than numbers.
        WrongShape: An array has the wrong shape.
        NotFinite: A number is NaN or infinite.
        NotUnitQuaternion: The orientation is not a unit quaternion.
    """
    place = _point("origin", np.zeros(AXES) if origin is None else origin)
    turn = IDENTITY if start_orientation is None else checked("start_orientation", start_orientation, (4,))
    return Situation(checked_condition(condition), place, _point("start_position", start_position), turn)


def _with_three_axes(name: str, points: ArrayLike) -> Array:
    """Points (T, D) with zeros for the axes that are not there, shape (T, 3)."""
    given = checked(name, points, (None, None))
    if not 1 <= given.shape[1] <= AXES:
        raise WrongShape(name, "(T, D) with D from 1 to 3", given.shape)
    return np.pad(given, ((0, 0), (0, AXES - given.shape[1])))


def _point(name: str, values: ArrayLike) -> Array:
    """A point (D,) with zeros for the axes that are not there, shape (3,)."""
    given = checked(name, values, (None,))
    if not 1 <= len(given) <= AXES:
        raise WrongShape(name, "(D,) with D from 1 to 3", given.shape)
    return np.pad(given, (0, AXES - len(given)))


def _each(name: str, values: ArrayLike | Sequence[ArrayLike]) -> list[ArrayLike]:
    """The first axis of an array, or a sequence, as a list."""
    try:
        return list(values)  # type: ignore[arg-type]  # what cannot be gone through is refused
    except TypeError:
        raise NotNumbers(name) from None


def _depth(values: object) -> int:
    """How many axes something has, by its first entries."""
    if isinstance(values, str) or not isinstance(values, Iterable):
        return 0
    return 1 + _depth(next(iter(values), None))
