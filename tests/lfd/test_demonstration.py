import numpy as np
import pytest

from lfd.demonstration import Demonstration, relative_to_object, to_base
from lfd.exceptions import NotFinite


def test_condition_is_the_object_seen_from_the_start(reach):
    demonstration = reach([0.9, 0.1, 0.6], start=(0.5, -0.1, 0.4))
    np.testing.assert_allclose(demonstration.condition, [0.4, 0.2, 0.2])


def test_relative_trajectory_starts_at_minus_the_condition_and_returns_to_the_base(reach):
    demonstration = reach([0.9, 0.1, 0.6])
    relative = relative_to_object(demonstration.trajectory, demonstration.object_position)
    np.testing.assert_allclose(relative.positions[0], -demonstration.condition)
    back = to_base(relative, demonstration.object_position)
    np.testing.assert_allclose(back.positions, demonstration.trajectory.positions)


def test_an_object_that_was_not_seen_is_refused(reach):
    with pytest.raises(NotFinite):
        Demonstration(reach([0.9, 0.1, 0.6]).trajectory, np.full(3, np.nan))
