import numpy as np
import pytest

from lfd.exceptions import NotFinite, WrongShape
from lfd.motion.demonstration import Demonstration, Situation, relative_to_origin, to_base


def test_condition_is_the_object_seen_from_the_start(reach):
    demonstration = reach([0.9, 0.1, 0.6], start=(0.5, -0.1, 0.4))
    np.testing.assert_allclose(demonstration.condition, [0.4, 0.2, 0.2])


def test_relative_trajectory_starts_at_minus_the_condition_and_returns_to_the_base(reach):
    demonstration = reach([0.9, 0.1, 0.6])
    relative = relative_to_origin(demonstration.trajectory, demonstration.origin)
    np.testing.assert_allclose(relative.positions[0], -demonstration.condition)
    back = to_base(relative, demonstration.origin)
    np.testing.assert_allclose(back.positions, demonstration.trajectory.positions)


def test_an_object_that_was_not_seen_is_refused(reach):
    with pytest.raises(NotFinite):
        Demonstration.reaching(reach([0.9, 0.1, 0.6]).trajectory, np.full(3, np.nan))


@pytest.mark.parametrize("c", [1, 2, 7])
def test_a_condition_has_any_dimension_but_none(reach, c):
    trajectory = reach([0.9, 0.1, 0.6]).trajectory
    assert Demonstration(trajectory, np.zeros(3), np.arange(c)).situation.condition.shape == (c,)
    with pytest.raises(WrongShape):
        Demonstration(trajectory, np.zeros(3), np.empty(0))


def test_the_situation_before_a_motion_is_what_the_motion_knew(reach):
    demonstration = reach([0.9, 0.1, 0.6], start=(0.5, -0.1, 0.4))
    trajectory = demonstration.trajectory
    reaching = Situation.reaching(np.array([0.9, 0.1, 0.6]), trajectory.positions[0], trajectory.orientations[0])
    for name in ("condition", "origin", "start_position", "start_orientation"):
        np.testing.assert_array_equal(getattr(demonstration.situation, name), getattr(reaching, name))
