"""Motions between NumPy and the wire."""

import numpy as np
import pytest

from protocol.messages import Array, Motion
from services.bus.arrays import NotFinite, motion_from_wire, motion_to_wire

POSITIONS = np.linspace((0.4, 0.0, 0.4), (0.6, 0.1, 0.5), 5)
ORIENTATIONS = np.tile([1.0, 0.0, 0.0, 0.0], (5, 1))
OPENING = np.array([0.08, 0.08, 0.08, 0.0, 0.0])


@pytest.mark.parametrize("opening", [None, OPENING])
def test_a_motion_comes_back_as_it_was_sent_with_the_gripper_or_without(opening):
    positions, orientations, duration, back = motion_from_wire(motion_to_wire(POSITIONS, ORIENTATIONS, 3.0, opening))
    np.testing.assert_array_equal(positions, POSITIONS)
    np.testing.assert_array_equal(orientations, ORIENTATIONS)
    assert duration == 3.0
    assert back is None if opening is None else np.array_equal(back, opening)


@pytest.mark.parametrize("shape", [(4,), (5, 1)])
def test_an_opening_that_does_not_belong_to_the_positions_is_refused(shape):
    plain = motion_to_wire(POSITIONS, ORIENTATIONS, 3.0)
    wrong = Array("<f8", shape, b"\0" * 8 * int(np.prod(shape)))
    with pytest.raises(ValueError, match="opening"):
        Motion(plain.positions, plain.orientations, 3.0, wrong)


def test_an_opening_of_no_numbers_is_refused():
    with pytest.raises(NotFinite):
        motion_from_wire(motion_to_wire(POSITIONS, ORIENTATIONS, 3.0, np.full(5, np.nan)))
