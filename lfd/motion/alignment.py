"""Alignment in time of the demonstrations of one condition."""

from collections.abc import Sequence
from dataclasses import replace
from enum import StrEnum

import numpy as np

from lfd.arrays import Array
from lfd.bounds import NOT_NEGATIVE, check_number, check_type
from lfd.distances import squared_distances
from lfd.motion.demonstration import Demonstration, relative_to_origin, to_base
from lfd.motion.dtw import dtw
from lfd.motion.opening import compared
from lfd.motion.resampling import at_phases
from lfd.motion.trajectory import Trajectory

SAME_CONDITION = 0.01  # [m] conditions nearer than this count as one (thesis, section II-C)
COMPARED = 30  # demonstrations of one condition among which the reference is sought: every pair of them is aligned


class Selection(StrEnum):
    """Which demonstrations of a condition (context) are learnt from."""

    ALL = "all"
    SIMILAR_PAIR = "similar pair"  # the thesis': the reference, and the one most similar to it


def warp(trajectory: Trajectory, onto: Trajectory) -> Trajectory:
    """The trajectory in the tempo of another: point i is where the alignment met point i of `onto`.

    It keeps its shape, its end points and its duration; it gets the number of points of `onto`.
    """
    path = dtw(*compared(onto, trajectory)).path
    matches = np.bincount(path[:, 0])
    phases = np.bincount(path[:, 0], weights=path[:, 1]) / matches / (trajectory.n_points - 1)
    phases[[0, -1]] = 0.0, 1.0
    return at_phases(trajectory, phases)


def distance_matrix(trajectories: Sequence[Trajectory]) -> Array:
    """DTW distances of all trajectories to each other, by what `compared` says, shape (M, M) [m]."""
    distances = np.zeros((len(trajectories), len(trajectories)))
    for i, a in enumerate(trajectories):
        for j in range(i):
            distances[i, j] = distances[j, i] = dtw(*compared(a, trajectories[j])).distance
    return distances


def reference(distances: Array) -> int:
    """Index of the trajectory with the least summed distance to all others: the medoid, equation (22).

    Args:
        distances: Of each to each, shape (M, M) [m].
    """
    return int(np.argmin(distances.sum(axis=1)))


def most_similar(distances: Array, to: int) -> int:
    """Index of the trajectory nearest to the trajectory `to`, from all distances (M, M) with M at least 2.

    This is the choice of section II-C. Appendix D takes the trajectory with the second lowest sum of equation (22)
    instead. For three the two agree (each sum lacks only the distance of the other two); for more they need not, and
    the second lowest sum may belong to one that is central but unlike the reference, which is not worth matching to it.
    """
    others = distances[to].copy()
    others[to] = np.inf
    return int(np.argmin(others))


def group_by_condition(conditions: Array, tolerance: float = SAME_CONDITION) -> list[list[int]]:
    """Indices of equal conditions (M, c), grouped, in order of first appearance.

    No two of a group lie further apart than the tolerance (complete linkage): a dense line of conditions is many
    groups, where a chain of pairs would make it one. The thesis compares pairs (equation (21)) and leaves open what
    follows when a = b and b = c but not a = c. Which of a chain belong together does not depend on their order: they
    are gone through by their coordinates, and each joins the first group that it fits.
    """
    if not len(conditions):
        return []
    groups: list[list[int]] = []
    order = np.lexsort(conditions.T[::-1])
    # Of each group, the least and the greatest coordinates: what lies beyond them is not compared with its members.
    least, most = np.empty_like(conditions), np.empty_like(conditions)
    for i in order.tolist():
        s, count = conditions[i], len(groups)
        within = (s >= most[:count] - tolerance) & (s <= least[:count] + tolerance)
        near = np.flatnonzero(within.all(axis=1)).tolist()
        fits = (g for g in near if squared_distances(s[None], conditions[groups[g]]).max() <= tolerance**2)
        g = next(fits, count)
        if g == count:
            groups.append([i])
            least[g], most[g] = s, s
        else:
            groups[g].append(i)
            least[g], most[g] = np.minimum(least[g], s), np.maximum(most[g], s)
    return sorted(sorted(group) for group in groups)


def align(
    demonstrations: Sequence[Demonstration],
    tolerance: float = SAME_CONDITION,
    selection: Selection = Selection.ALL,
) -> list[Demonstration]:
    """The demonstrations in their order, those of one condition in the tempo of their reference.

    By default all are kept. The thesis keeps two of each condition, as one path matches two sequences; but all can be
    matched to the reference, one by one, and dropping some predicts worse on the thesis' own recordings. Of more than
    `COMPARED` at one condition, that many, evenly taken, compete for being the reference.

    Args:
        demonstrations: Of any conditions, all of one dimension.
        tolerance: Within which conditions count as one, in their own unit, zero or more; see `group_by_condition`.
        selection: Which of them to keep.

    Raises:
        OutOfRange: The tolerance is negative, or the selection none.
        OpeningMismatch: The gripper takes part in some of one condition only.
    """
    check_number("tolerance", tolerance, NOT_NEGATIVE)
    check_type("selection", selection, Selection)
    aligned: dict[int, Demonstration] = {}
    for group in group_by_condition(np.array([d.condition for d in demonstrations]), tolerance):
        members = [relative_to_origin(demonstrations[i].trajectory, demonstrations[i].origin) for i in group]
        rivals = np.linspace(0, len(group) - 1, min(len(group), COMPARED)).round().astype(int).tolist()
        distances = distance_matrix([members[rival] for rival in rivals])
        best = reference(distances)
        chosen = rivals[best]
        aligned[group[chosen]] = demonstrations[group[chosen]]
        others = [member for member in range(len(group)) if member != chosen]
        if selection is Selection.SIMILAR_PAIR and others:
            others = [rivals[most_similar(distances, to=best)]]
        for member in others:
            original = demonstrations[group[member]]
            warped = to_base(warp(members[member], onto=members[chosen]), original.origin)
            aligned[group[member]] = replace(original, trajectory=warped)
    return [aligned[i] for i in sorted(aligned)]
