import numpy as np
import pytest

from lfd.models.adaptive.ways import contradictions, probabilities, sort_into_ways

SLOPE, NOISE = 0.5, 0.01**2


def sort(changes, places, slope=SLOPE, noise=NOISE, current=None):
    changes, places = np.atleast_2d(np.asarray(changes, float).T).T, np.asarray(places, float)
    distances = np.abs(places[:, None] - places)
    against = contradictions(changes @ changes.T, distances, slope, noise)
    return sort_into_ways(against, distances, np.ones(len(places), bool) if current is None else current).tolist()


def test_left_and_right_side_by_side_are_two_ways():
    assert sort([0.2, -0.2], [0.0, 0.1]) == [0, 1]


def test_the_same_direction_is_one_way():
    assert sort([0.2, 0.1, 0.25], [0.0, 0.1, 0.2]) == [0, 0, 0]


@pytest.mark.parametrize("angle", [1.0, 1.5, 2.0])
def test_what_halfway_still_departs_as_far_as_one_of_them_is_one_way(angle):
    """Of equal size, halfway is cos(angle / 2) of it, and the sum less than one of them beyond 120 degrees."""
    assert sort([[0.2, 0.0], [0.2 * np.cos(angle), 0.2 * np.sin(angle)]], [0.0, 0.1]) == [0, 0]
    wider = angle + 1.1
    assert sort([[0.2, 0.0], [0.2 * np.cos(wider), 0.2 * np.sin(wider)]], [0.0, 0.1]) == [0, 1]


def test_a_third_joins_the_way_that_it_fits():
    assert sort([0.2, -0.2, -0.15, 0.3], [0.0, 0.1, 0.05, 0.05]) == [0, 1, 1, 0]


def test_one_that_fits_several_joins_the_nearest():
    """Straight on contradicts neither."""
    assert sort([[0.2, 0.0], [-0.2, 0.0], [0.0, 0.2]], [0.0, 0.1, 0.02]) == [0, 1, 0]
    assert sort([[0.2, 0.0], [-0.2, 0.0], [0.0, 0.2]], [0.0, 0.1, 0.08]) == [0, 1, 1]


def test_a_way_is_as_near_as_the_nearest_of_it():
    """The first way also has a correction far away."""
    assert sort([[0.2, 0.0], [0.2, 0.0], [-0.2, 0.0], [0.0, 0.2]], [0.0, 0.5, 0.1, 0.02]) == [0, 0, 1, 0]


def test_one_that_contradicts_a_single_one_of_a_way_does_not_join_it():
    assert sort([[0.2, 0.0], [0.15, 0.2], [-0.2, 0.01]], [0.0, 0.02, 0.03]) == [0, 0, 1]


def test_one_that_each_way_contradicts_is_a_way_of_its_own():
    angles = np.radians([0.0, 100.0, 190.0, 320.0])
    assert sort(0.2 * np.column_stack([np.cos(angles), np.sin(angles)]), [0.0, 0.01, 0.02, 0.03]) == [0, 0, 1, 2]


def test_a_difference_that_the_way_between_explains_is_no_contradiction():
    """At a slope of 0.5, a motion may change by 0.4 over 0.8."""
    assert sort([0.2, -0.2], [0.0, 0.79]) == [0, 1]
    assert sort([0.2, -0.2], [0.0, 0.81]) == [0, 0]


def test_a_difference_within_noise_is_no_contradiction():
    assert sort([0.2, -0.2], [0.0, 0.0], noise=0.099**2) == [0, 1]
    assert sort([0.2, -0.2], [0.0, 0.0], noise=0.101**2) == [0, 0]


def test_one_that_no_longer_holds_has_no_say_and_belongs_to_the_way_of_the_nearest_that_does():
    changes, places = [0.2, -0.2, -0.15, 0.15], [0.0, 0.1, 0.02, 0.09]
    assert sort(changes, places) == [0, 1, 1, 0]
    assert sort(changes, places, current=np.array([True, True, False, False])) == [0, 1, 0, 1]
    assert sort(changes, places, current=np.array([True, False, False, True])) == [0, 0, 0, 0]
    assert sort(changes, places, current=np.array([False, True, False, True])) == [1, 0, 1, 1]


def test_a_way_is_probable_by_its_nearest_correction():
    ways = np.array([0, 1, 1])
    likely = probabilities(np.array([0.3, 0.9, 0.2]), ways, gate=0.05)
    np.testing.assert_allclose(likely, [1.0 / (1.0 + np.exp(2.0)), 1.0 / (1.0 + np.exp(-2.0))])
    np.testing.assert_allclose(probabilities(np.array([0.4, 0.9, 0.4]), ways, gate=0.05), [0.5, 0.5])


def test_far_away_probabilities_are_still_numbers():
    np.testing.assert_allclose(probabilities(np.array([1e4, 2e4]), np.array([0, 1]), gate=0.05), [1.0, 0.0])
