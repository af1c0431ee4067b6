"""The median over pictures, and when it starts anew."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from services.perception.filter import PoseFilter
from services.perception.placement import placement

UPRIGHT = (1.0, 0.0, 0.0, 0.0)


def at(x):
    return placement((x, 0.0, 0.5), UPRIGHT)


@given(st.lists(st.floats(-0.009, 0.009), min_size=1, max_size=9))
def test_the_position_is_the_median_of_what_was_seen(offsets):
    smooth = PoseFilter(window=9)
    for offset in offsets:
        result = smooth.update(at(offset))
    assert result[0, 3] == np.median(offsets)
    assert len(smooth) == len(offsets)


def test_only_the_last_pictures_count():
    smooth = PoseFilter(window=3)
    for x in (0.0, 0.0, 0.0, 0.010, 0.010):
        result = smooth.update(at(x))
    assert result[0, 3] == 0.010


def test_one_outlier_says_nothing_and_changes_nothing():
    smooth = PoseFilter(window=9)
    smooth.update(at(0.0))
    assert smooth.update(at(0.3)) is None
    assert smooth.update(at(0.0))[0, 3] == 0.0


def test_outliers_that_disagree_with_each_other_are_no_move():
    smooth = PoseFilter(window=9)
    smooth.update(at(0.0))
    assert [smooth.update(at(x)) for x in (0.3, -0.3, 0.6, -0.6)] == [None] * 4


def test_three_that_agree_are_a_move_and_forget_the_place_before():
    smooth = PoseFilter(window=9)
    for x in (0.0, 0.0, 0.3, 0.301):
        smooth.update(at(x))
    assert smooth.update(at(0.302))[0, 3] == 0.302
    assert len(smooth) == 1


def test_the_rotation_stays_a_rotation():
    smooth = PoseFilter(window=9)
    for angle in (-0.1, 0.05, 0.1):
        result = smooth.update(placement((0.0, 0.0, 0.0), (np.cos(angle), 0.0, 0.0, np.sin(angle))))
    np.testing.assert_allclose(result[:3, :3] @ result[:3, :3].T, np.eye(3), atol=1e-12)
    assert np.linalg.det(result[:3, :3]) > 0
