import numpy as np
import pytest

from lfd.models.adaptive.scale import SPREADS, ConditionScale
from lfd.motion.demonstration import Demonstration

EXTENT = 0.7
PLACES = [[0.9, 0.3, 0.6], [0.8, -0.1, 0.7], [0.7, 0.2, 0.45]]


def described(reach, describe):
    """Demonstrations whose conditions are what a function makes of the way to the object, and a number of each."""
    return [
        Demonstration(d.trajectory, d.origin, np.array(describe(d.condition, i)))
        for i, d in enumerate(map(reach, PLACES))
    ]


def test_one_unit_of_a_length_is_one_extent_in_whatever_unit_it_was_measured(reach):
    scale = ConditionScale.of(described(reach, lambda s, i: [1e3 * s[0], -0.01 * s[1], s[2]]), EXTENT)
    assert scale.axes.tolist() == [0, 1, 2]
    np.testing.assert_allclose(scale.unit, EXTENT * np.array([1e3, 0.01, 1.0]))


@pytest.mark.parametrize("coordinate", range(3))
def test_a_single_number_is_a_length_if_it_is_any_coordinate_of_the_way(reach, coordinate):
    scale = ConditionScale.of(described(reach, lambda s, i: [2.0 * s[coordinate]]), EXTENT)
    assert scale.axes.tolist() == [coordinate]
    np.testing.assert_allclose(scale.unit, 2.0 * EXTENT)


def test_one_unit_of_anything_else_is_some_standard_deviations(reach):
    scale = ConditionScale.of(described(reach, lambda s, i: [s[0], [2.0, 5.0, 11.0][i]]), EXTENT)
    assert scale.axes.tolist() == [0, -1]
    np.testing.assert_allclose(scale.unit, [EXTENT, SPREADS * np.std([2.0, 5.0, 11.0])])


def test_a_number_that_grows_with_a_coordinate_and_an_offset_is_no_length(reach):
    scale = ConditionScale.of(described(reach, lambda s, i: [s[0] + 0.1, s[1]]), EXTENT)
    assert scale.axes.tolist() == [-1, 1]


def test_a_number_that_is_none_where_a_coordinate_is_and_else_goes_its_own_way_is_no_length(reach):
    places = [[0.9, 0.3, 0.6], [0.8, 0.0, 0.7], [0.7, 0.2, 0.45]]
    told = zip(map(reach, places), [2.0, 0.0, 5.0], strict=True)
    demonstrations = [Demonstration(d.trajectory, d.origin, np.array([d.condition[0], size])) for d, size in told]
    assert ConditionScale.of(demonstrations, EXTENT).axes.tolist() == [0, -1]


def test_one_demonstration_of_a_place_tells_its_unit(reach):
    scale = ConditionScale.of(described(reach, lambda s, i: 10.0 * s)[:1], EXTENT)
    assert scale.axes.tolist() == [0, 1, 2]
    np.testing.assert_allclose(scale.unit, 10.0 * EXTENT)


def test_a_place_straight_ahead_has_its_unit_to_the_sides_too(reach):
    """One coordinate is zero: it is a length as the others are."""
    ahead = reach([0.9, 0.0, 0.6])
    np.testing.assert_allclose(ConditionScale.of([ahead], EXTENT).unit, EXTENT)
    np.testing.assert_allclose(ConditionScale.of([ahead, reach([0.7, 0.0, 0.6])], EXTENT).unit, EXTENT)


def test_a_size_that_never_varied_is_no_length_though_the_height_did_not_either(reach):
    demonstrations = [
        Demonstration(d.trajectory, d.origin, np.array([*d.condition[:2], 0.05]))
        for d in map(reach, ([0.9, 0.3, 0.6], [0.8, -0.1, 0.6], [0.7, 0.2, 0.6]))
    ]
    scale = ConditionScale.of(demonstrations, EXTENT)
    assert scale.lengths.tolist() == [True, True, False]
    assert scale.unseen(np.array([0.3, 0.1, 0.06]))


def test_one_demonstration_of_other_than_three_numbers_does_not(reach):
    scale = ConditionScale.of(described(reach, lambda s, i: s[:2])[:1], EXTENT)
    assert not scale.lengths.any()
    assert np.isinf(scale.unit).all()


def test_where_nothing_moves_there_are_no_lengths(reach):
    demonstrations = described(reach, lambda s, i: s)
    here = [Demonstration(d.trajectory, d.trajectory.positions[0], d.condition) for d in demonstrations]
    assert not ConditionScale.of(here, EXTENT).lengths.any()
    nowhere = [Demonstration(d.trajectory, d.origin, np.zeros(3)) for d in here]
    assert not ConditionScale.of(nowhere, EXTENT).lengths.any()


def test_a_dimension_that_never_varied_makes_no_difference_and_is_told_apart():
    scale = ConditionScale.of_conditions(np.array([[1.0, 3.0], [2.0, 3.0]]), np.zeros(2), np.full(2, -1))
    assert scale.unit[1] == np.inf
    np.testing.assert_array_equal(scale.standard(np.array([1.5, 9.0])), [0.0, 0.0])
    assert scale.unseen(np.array([1.5, 9.0]))
    assert not scale.unseen(np.array([7.0, 3.0]))
    assert not scale.unseen(np.array([1.5, 3.0 * (1.0 + 1e-15)]))


def test_rounding_is_no_variation():
    third = 0.1 + 0.2
    scale = ConditionScale.of_conditions(np.array([[third], [0.3], [0.3]]), np.zeros(1), np.full(1, -1))
    assert np.isinf(scale.unit).all()
    varied = ConditionScale.of_conditions(np.array([[0.3 + 1e-9], [0.3], [0.3]]), np.zeros(1), np.full(1, -1))
    assert np.isfinite(varied.unit).all()


def test_conditions_become_distances_from_their_centre_in_units_times_their_relevance():
    scale = ConditionScale(np.array([1.0, -2.0]), np.array([0.5, 4.0]), np.arange(2), np.array([1.0, 0.5]))
    np.testing.assert_allclose(scale.standard(np.array([[2.0, 2.0], [1.0, -2.0]])), [[2.0, 0.5], [0.0, 0.0]])


def test_a_correction_gives_a_unit_where_there_was_none_and_leaves_the_others():
    scale = ConditionScale.of_conditions(np.array([[1.0, 3.0], [2.0, 3.0]]), np.zeros(2), np.full(2, -1))
    completed = scale.completed(np.array([[9.0, 4.0], [1.5, 1.0]]))
    np.testing.assert_allclose(completed.unit, [scale.unit[0], SPREADS * np.sqrt((1.0 + 4.0) / 2.0)])
    assert scale.completed(np.array([[9.0, 3.0]])) is scale


def test_no_correction_completes_nothing():
    scale = ConditionScale.of_conditions(np.array([[1.0, 3.0]]), np.zeros(2), np.full(2, -1))
    assert scale.completed(np.zeros((0, 2))) is scale


@pytest.mark.parametrize("factor", [0.01, 100.0])
def test_a_dimension_s_unit_makes_no_difference(reach, factor):
    def standard(unit):
        demonstrations = described(reach, lambda s, i: [s[0], unit * s[1], unit * [2.0, 5.0, 11.0][i]])
        return ConditionScale.of(demonstrations, EXTENT).standard(np.array([0.3, unit * 0.2, unit * 4.0]))

    np.testing.assert_allclose(standard(factor), standard(1.0), rtol=1e-12)
