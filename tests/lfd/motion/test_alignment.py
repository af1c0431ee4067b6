from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion import alignment
from lfd.motion.alignment import Selection, align, distance_matrix, group_by_condition, most_similar, reference, warp
from lfd.motion.dtw import dtw
from lfd.motion.resampling import at_phases


def test_warping_takes_out_a_difference_of_tempo(reach):
    onto = reach([0.9, 0.2, 0.6], bend=0.2).trajectory
    hurried = at_phases(onto, onto.phases**1.7)
    warped = warp(hurried, onto)
    before = np.abs(hurried.positions - onto.positions).max()
    assert np.abs(warped.positions - onto.positions).max() < 0.15 * before
    np.testing.assert_array_equal(warped.positions[[0, -1]], hurried.positions[[0, -1]])


def test_reference_is_the_most_central_trajectory(reach):
    trajectories = [reach([0.9, 0.2, 0.6], bend=bend).trajectory for bend in (-0.3, -0.2, 0.0, 0.05, 0.3)]
    distances = distance_matrix(trajectories)
    np.testing.assert_array_equal(distances, distances.T)
    assert reference(distances) == 2
    assert most_similar(distances, to=2) == 3


def test_the_example_of_appendix_d():
    """The sums 1868, 1348 and 1778 of equation (D.8) are those of these distances; trajectories 2 and 3 are used."""
    distances = np.array([[0.0, 719, 1149], [719, 0, 629], [1149, 629, 0]])
    assert distances.sum(axis=1).tolist() == [1868, 1348, 1778]
    assert reference(distances) == 1
    assert most_similar(distances, to=1) == 2


def test_the_most_similar_need_not_have_the_second_lowest_sum():
    distances = np.array([[0.0, 3, 4, 4], [3, 0, 9, 9], [4, 9, 0, 5], [4, 9, 5, 0]])
    assert np.argsort(distances.sum(axis=1), kind="stable")[1] == 2
    assert reference(distances) == 0
    assert most_similar(distances, to=0) == 1


def test_conditions_group_within_the_tolerance():
    conditions = np.array([[0.0, 0, 0], [1.0, 0, 0], [0.008, 0, 0], [0.016, 0, 0], [1.0, 0.02, 0]])
    assert group_by_condition(conditions) == [[0, 2], [1], [3], [4]]
    assert group_by_condition(conditions[:1]) == [[0]]
    assert group_by_condition(conditions[:0]) == []


def test_the_tolerance_itself_still_counts():
    assert group_by_condition(np.array([[0.0], [0.5]]), tolerance=0.5) == [[0, 1]]
    assert group_by_condition(np.array([[0.0, 0.0], [0.3, 0.41]]), tolerance=0.5) == [[0], [1]]


def test_a_dense_line_is_many_conditions():
    """Where a chain of pairs would make it one."""
    assert len(group_by_condition(np.linspace(0.0, 1.0, 101)[:, None], tolerance=0.1)) >= 10


@given(st.integers(1, 40), st.integers(1, 3), st.integers(0, 2**32 - 1))
def test_no_two_of_a_group_lie_further_apart_than_the_tolerance_whatever_their_order(M, c, seed):
    rng = np.random.default_rng(seed)
    conditions = rng.uniform(size=(M, c))
    groups = group_by_condition(conditions, tolerance=0.3)
    assert sorted(i for group in groups for i in group) == list(range(M))
    assert groups == sorted(sorted(group) for group in groups)
    for group in groups:
        apart = np.linalg.norm(conditions[group][:, None] - conditions[group], axis=2)
        assert apart.max() <= 0.3 + 1e-12
    order = rng.permutation(M)
    again = {frozenset(order[group].tolist()) for group in group_by_condition(conditions[order], tolerance=0.3)}
    assert again == {frozenset(group) for group in groups}


@given(st.integers(1, 5), st.integers(1, 3), st.integers(0, 2**32 - 1))
def test_clusters_that_lie_apart_are_found(clusters, c, seed):
    rng = np.random.default_rng(seed)
    owners = rng.integers(clusters, size=30)
    conditions = owners[:, None] + rng.uniform(-0.1, 0.1, size=(30, c)) / np.sqrt(c)
    groups = group_by_condition(conditions, tolerance=0.2)
    assert sorted(groups) == sorted(np.flatnonzero(owners == k).tolist() for k in set(owners.tolist()))


def test_align_changes_the_tempo_within_a_condition_and_nothing_else(reach):
    first, other = reach([0.9, 0.2, 0.6]), reach([0.9, -0.2, 0.6])
    trajectory = at_phases(first.trajectory, first.trajectory.phases**1.7)
    second = replace(first, trajectory=trajectory)
    aligned = align([first, other, second])
    assert aligned[1].trajectory.positions.tolist() == other.trajectory.positions.tolist()
    difference = aligned[0].trajectory.positions - aligned[2].trajectory.positions
    assert np.abs(difference).max() < 0.15 * np.abs(first.trajectory.positions - trajectory.positions).max()


def test_by_the_thesis_only_the_reference_and_the_one_most_similar_to_it_stay(reach):
    other = reach([0.9, -0.2, 0.6])
    bends = (0.0, 0.02, 0.3)
    demonstrations = [other, *(reach([0.9, 0.2, 0.6], bend, duration=4.0 + i) for i, bend in enumerate(bends))]
    kept = align(demonstrations, selection=Selection.SIMILAR_PAIR)
    assert [d.trajectory.duration for d in kept] == [other.trajectory.duration, 4.0, 5.0]
    assert len(align(demonstrations)) == len(demonstrations)


@pytest.mark.parametrize("selection", Selection)
def test_two_of_a_condition_are_treated_alike_by_both_selections(reach, selection):
    demonstrations = [reach([0.9, 0.2, 0.6], bend) for bend in (0.0, 0.1)]
    aligned, expected = align(demonstrations, selection=selection), align(demonstrations)
    assert [d.trajectory.positions.tolist() for d in aligned] == [d.trajectory.positions.tolist() for d in expected]


def test_alignment_does_not_depend_on_where_the_object_stands(reach):
    """Demonstrations are compared relative to their own origin."""
    here = [reach([0.9, 0.2, 0.6], bend) for bend in (0.0, 0.2)]
    shift = np.array([0.3, -1.0, 0.2])
    there = replace(
        here[1],
        trajectory=replace(here[1].trajectory, positions=here[1].trajectory.positions + shift),
        origin=here[1].origin + shift,
    )
    moved, expected = align([here[0], there])[1], align(here)[1]
    np.testing.assert_allclose(moved.trajectory.positions, expected.trajectory.positions + shift, atol=1e-12)


def test_many_of_one_condition_cost_no_more_than_in_proportion(reach, monkeypatch):
    """Of every further demonstration beyond the ones compared, one more alignment."""
    monkeypatch.setattr(alignment, "COMPARED", 4)
    calls = []

    def counted(a, b):
        calls.append(1)
        return dtw(a, b)

    monkeypatch.setattr(alignment, "dtw", counted)
    counts = []
    for count in (4, 5, 12):
        calls.clear()
        align([reach([0.9, 0.2, 0.6], bend=0.01 * i, n=10) for i in range(count)])
        counts.append(len(calls))
    assert counts == [6 + 3, 6 + 4, 6 + 11]


def test_nothing_to_align_is_nothing():
    assert align([]) == []
