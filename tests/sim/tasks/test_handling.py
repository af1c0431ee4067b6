"""On from where an object is grasped: as success asks for it."""

import numpy as np
import pytest

from sim.region import Region
from sim.tasks.handling import handled
from sim.tasks.scene import Corridor
from sim.tasks.success import Success

WIDE = 0.1
PLACE = np.array([0.7, 0.1, 0.71])
REACH = Corridor(
    np.array([[0.6, -0.3, 0.74], [0.6, 0.1, 0.74], [0.7, 0.1, 0.72]]), np.tile([1.0, 0.0, 0.0, 0.0], (3, 1))
)


def after(**asked) -> Corridor:
    success = Success(reached=(0.05, 0.05, 0.05), kicked_over=(0.1, 0.1, 0.1), **asked)
    return handled(REACH, PLACE, success, WIDE)


def test_what_is_to_be_grasped_is_grasped_where_it_is() -> None:
    way = after(grasped=True)
    np.testing.assert_array_equal(way.positions, REACH.positions)
    assert way.openings.tolist() == [WIDE, WIDE, 0.0]


def test_what_is_to_be_lifted_is_lifted_a_little_higher() -> None:
    way = after(lifted=0.08)
    assert way.openings.tolist() == [WIDE, WIDE, 0.0, 0.0]
    np.testing.assert_allclose(way.positions[-1] - REACH.positions[-1], [0.0, 0.0, 0.11])


@pytest.mark.parametrize("lifted", [None, 0.2])
def test_what_is_to_be_placed_is_carried_there_set_down_and_let_go(lifted: float | None) -> None:
    region = Region((0.6, -0.3, 0.71), (0.7, -0.2, 0.75))
    way = after(lifted=lifted, placed=region)
    assert way.openings.tolist() == [WIDE, WIDE, 0.0, 0.0, 0.0, WIDE]
    thing = PLACE + way.positions[-1] - REACH.positions[-1]
    assert region.contains(thing, 0.0)
    assert way.positions[3:5, 2].min() > REACH.positions[-1][2] + 0.1
    assert len(way.orientations) == len(way.positions)
