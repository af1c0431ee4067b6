from dataclasses import replace
from functools import cache

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.alignment import align, dtw, group_by_condition, reference, warp
from lfd.resampling import at_phases

sequences = st.lists(st.tuples(st.floats(-5, 5), st.floats(-5, 5)), min_size=1, max_size=8).map(np.array)


def defined_distance(a, b):
    """The recursion that defines dynamic time warping."""

    @cache
    def total(i, j):
        cost = float(np.linalg.norm(a[i] - b[j]))
        before = [total(x, y) for x, y in ((i - 1, j), (i, j - 1), (i - 1, j - 1)) if x >= 0 and y >= 0]
        return cost + min(before, default=0.0)

    return total(len(a) - 1, len(b) - 1)


@given(sequences, sequences)
def test_distance_is_that_of_the_definition_and_of_the_path(a, b):
    alignment = dtw(a, b)
    i, j = alignment.path.T
    assert alignment.distance == pytest.approx(defined_distance(a, b), abs=1e-9)
    assert alignment.distance == pytest.approx(np.linalg.norm(a[i] - b[j], axis=1).sum(), abs=1e-9)


@given(sequences, sequences)
def test_path_leads_from_corner_to_corner_in_single_steps(a, b):
    path = dtw(a, b).path
    assert path[0].tolist() == [0, 0]
    assert path[-1].tolist() == [len(a) - 1, len(b) - 1]
    assert {tuple(step) for step in np.diff(path, axis=0)} <= {(0, 1), (1, 0), (1, 1)}


def test_the_example_of_appendix_d():
    """The sequences 1 2 4 3 and 1 1 2 4 align at no cost once each repeats what the other lacks, but for the end."""
    X, Y = np.array([[1.0], [2.0], [4.0], [3.0]]), np.array([[1.0], [1.0], [2.0], [4.0]])
    alignment = dtw(X, Y)
    assert alignment.distance == pytest.approx(1.0)
    assert X[alignment.path[:, 0], 0].tolist() == [1, 1, 2, 4, 3]
    assert Y[alignment.path[:, 1], 0].tolist() == [1, 1, 2, 4, 4]


def test_warping_takes_out_a_difference_of_tempo(reach):
    onto = reach([0.9, 0.2, 0.6], bend=0.2).trajectory
    hurried = at_phases(onto, onto.phases**1.7)
    warped = warp(hurried, onto)
    before = np.abs(hurried.positions - onto.positions).max()
    assert np.abs(warped.positions - onto.positions).max() < 0.15 * before
    np.testing.assert_array_equal(warped.positions[[0, -1]], hurried.positions[[0, -1]])


def test_reference_is_the_most_central_trajectory(reach):
    trajectories = [reach([0.9, 0.2, 0.6], bend=bend).trajectory for bend in (-0.3, 0.0, 0.02, 0.3)]
    assert reference(trajectories) in (1, 2)


def test_conditions_group_within_the_tolerance_and_along_chains():
    conditions = np.array([[0.0, 0, 0], [1.0, 0, 0], [0.008, 0, 0], [0.016, 0, 0], [1.0, 0.02, 0]])
    assert group_by_condition(conditions) == [[0, 2, 3], [1], [4]]
    assert group_by_condition(conditions[:1]) == [[0]]


def test_align_changes_the_tempo_within_a_condition_and_nothing_else(reach):
    first, other = reach([0.9, 0.2, 0.6]), reach([0.9, -0.2, 0.6])
    trajectory = at_phases(first.trajectory, first.trajectory.phases**1.7)
    second = replace(first, trajectory=trajectory)
    aligned = align([first, other, second])
    assert aligned[1].trajectory.positions.tolist() == other.trajectory.positions.tolist()
    difference = aligned[0].trajectory.positions - aligned[2].trajectory.positions
    assert np.abs(difference).max() < 0.15 * np.abs(first.trajectory.positions - trajectory.positions).max()
