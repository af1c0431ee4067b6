"""Placements and quaternions."""

import numpy as np
from hypothesis import assume, given
from hypothesis import strategies as st

from services.perception.placement import (
    angle_between,
    inverse,
    placement,
    quaternion_from_rotation,
    rotation_from_quaternion,
)

components = st.lists(st.floats(-1.0, 1.0), min_size=4, max_size=4).map(np.array)


@given(components)
def test_a_quaternion_survives_its_matrix_up_to_sign(q):
    assume(np.linalg.norm(q) > 0.1)
    back = quaternion_from_rotation(rotation_from_quaternion(q))
    assert abs(back @ q) / np.linalg.norm(q) > 1 - 1e-9
    assert back[0] >= 0


@given(components)
def test_a_placement_and_its_inverse_cancel(q):
    assume(np.linalg.norm(q) > 0.1)
    there = placement((1.0, -2.0, 3.0), q)
    np.testing.assert_allclose(there @ inverse(there), np.eye(4), atol=1e-12)


@given(st.floats(0.01, 3.1))
def test_the_angle_between_placements_is_that_of_the_rotation(angle):
    turned = placement((0.0, 0.0, 0.0), (np.cos(angle / 2), 0.0, np.sin(angle / 2), 0.0))
    assert abs(angle_between(np.eye(4), turned) - angle) < 1e-6
