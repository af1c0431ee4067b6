import numpy as np
import pytest

from lfd.motion.departure import Departure
from lfd.motion.trajectory import Trajectory

STRAIGHT = np.linspace([0.0, 0.0, 0.0], [1.0, 0.0, 0.0], 101)


def _motion(positions):
    return Trajectory(positions, np.tile([1.0, 0.0, 0.0, 0.0], (len(positions), 1)), 1.0)


def test_a_motion_departs_from_another_one_by_the_distance_of_their_ways():
    bent = STRAIGHT + np.outer(np.sin(np.pi * np.linspace(0.0, 1.0, 101)), [0.0, 0.0, 0.1])
    departure = Departure.of(_motion(bent), _motion(STRAIGHT))
    assert departure.most == pytest.approx(0.1)
    assert departure.mean == pytest.approx(0.1 * 2.0 / np.pi, rel=0.02)


def test_the_tempo_does_not_count():
    slow_first = np.linspace(0.0, 1.0, 101)[:, None] ** 2 * [1.0, 0.0, 0.0]
    assert Departure.of(_motion(slow_first), _motion(STRAIGHT)).most < 0.006


def test_only_the_part_counts_that_the_motion_speaks_of():
    raised = STRAIGHT.copy()
    raised[:50, 2], raised[50:, 2] = 0.1, 0.3
    for part, most in (((0.0, 0.3), 0.1), ((0.6, 1.0), 0.3), ((0.6, 0.6001), 0.3)):
        assert Departure.of(_motion(raised), _motion(STRAIGHT), part).most == pytest.approx(most)
