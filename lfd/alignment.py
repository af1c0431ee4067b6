"""Dynamic time warping: exact, with the path; and the alignment of demonstrations of one condition."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np
from numpy.typing import NDArray
from scipy.cluster.hierarchy import fcluster, linkage
from scipy.spatial.distance import cdist, pdist

from lfd.arrays import Array
from lfd.demonstration import Demonstration, relative_to_origin, to_base
from lfd.resampling import at_phases
from lfd.trajectory import Trajectory

SAME_CONDITION = 0.01  # [m] conditions nearer than this count as one (thesis, section II-C)


@dataclass(frozen=True, eq=False)
class Alignment:
    """The cheapest monotonic matching of two sequences.

    Attributes:
        distance: Sum of the Euclidean distances along the path.
        path: Matched indices (i, j), shape (L, 2), from (0, 0) to (n - 1, m - 1); each step raises i, j or both by 1.
    """

    distance: float
    path: NDArray[np.intp]


def dtw(a: Array, b: Array) -> Alignment:
    """Exact dynamic time warping of a (n, d) and b (m, d), in O(n m).

    The accumulated cost is filled by anti-diagonals i + j = k, along which all cells are independent.
    """
    n, m = len(a), len(b)
    cost = cdist(a, b)
    skewed = np.full((n + m - 1, n), np.inf)
    i, j = np.indices((n, m))
    skewed[i + j, i] = cost
    # Row k + 2 is diagonal k and column i + 1 is index i, so that a neighbour outside the matrix reads infinity.
    total = np.full((n + m + 1, n + 1), np.inf)
    total[0, 0] = 0.0  # the virtual cell (-1, -1) before the start
    for k in range(n + m - 1):
        up, left, diagonal = total[k + 1, :-1], total[k + 1, 1:], total[k, :-1]
        total[k + 2, 1:] = skewed[k] + np.minimum(np.minimum(up, left), diagonal)
    return Alignment(float(total[n + m, n]), _path(total, n, m))


def _path(total: Array, n: int, m: int) -> NDArray[np.intp]:
    i, j = n - 1, m - 1
    path = [(i, j)]
    while i > 0 or j > 0:
        k = i + j
        diagonal = total[k, i] if i and j else np.inf
        up = total[k + 1, i] if i else np.inf
        left = total[k + 1, i + 1] if j else np.inf
        if diagonal <= min(up, left):
            i, j = i - 1, j - 1
        elif up <= left:
            i -= 1
        else:
            j -= 1
        path.append((i, j))
    return np.array(path[::-1], dtype=np.intp)


def warp(trajectory: Trajectory, onto: Trajectory) -> Trajectory:
    """The trajectory in the tempo of another: point i is where the alignment met point i of `onto`.

    It keeps its shape, its end points and its duration; it gets the number of points of `onto`.
    """
    path = dtw(onto.positions, trajectory.positions).path
    matches = np.bincount(path[:, 0])
    phases = np.bincount(path[:, 0], weights=path[:, 1]) / matches / (trajectory.n_points - 1)
    phases[[0, -1]] = 0.0, 1.0
    return at_phases(trajectory, phases)


def reference(trajectories: Sequence[Trajectory]) -> int:
    """Index of the trajectory with the least summed DTW distance to all others (equation (22))."""
    distances = np.zeros((len(trajectories), len(trajectories)))
    for i, a in enumerate(trajectories):
        for j in range(i):
            distances[i, j] = distances[j, i] = dtw(a.positions, trajectories[j].positions).distance
    return int(np.argmin(distances.sum(axis=1)))


def group_by_condition(conditions: Array, tolerance: float = SAME_CONDITION) -> list[list[int]]:
    """Indices of equal conditions (M, c), grouped, in order of first appearance.

    Transitive: a chain of conditions, each within the tolerance of the next, is one group. The thesis compares pairs
    (equation (21)) and leaves open what follows when a = b and b = c but not a = c.
    """
    if len(conditions) < 2:
        return [[i] for i in range(len(conditions))]
    labels = fcluster(linkage(pdist(conditions), "single"), tolerance, "distance")
    groups: dict[int, list[int]] = {}
    for index, label in enumerate(labels):
        groups.setdefault(int(label), []).append(index)
    return list(groups.values())


def align(demonstrations: Sequence[Demonstration], tolerance: float = SAME_CONDITION) -> list[Demonstration]:
    """The demonstrations in their order, those of one condition in the tempo of their reference.

    All demonstrations of a condition are kept. The thesis keeps the reference and the one most similar to it, which
    predicts worse on its own recordings.
    """
    aligned = list(demonstrations)
    conditions = np.array([d.condition for d in demonstrations])
    for group in group_by_condition(conditions, tolerance):
        members = {i: relative_to_origin(aligned[i].trajectory, aligned[i].origin) for i in group}
        chosen = group[reference(list(members.values()))]
        for i in group:
            if i != chosen:
                warped = to_base(warp(members[i], onto=members[chosen]), aligned[i].origin)
                aligned[i] = replace(aligned[i], trajectory=warped)
    return aligned
