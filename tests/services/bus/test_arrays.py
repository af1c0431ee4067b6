"""Arrays survive the wire, and what is no number does not."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from services.bus.arrays import NotFinite, from_wire, quaternion, to_wire, vector3

FINITE = st.floats(-1e6, 1e6)


@given(arrays(np.float64, st.tuples(st.integers(0, 5), st.integers(1, 4)), elements=FINITE))
def test_an_array_survives_the_wire(array):
    np.testing.assert_array_equal(from_wire(to_wire(array)), array)


def test_what_comes_from_the_wire_is_read_only():
    with pytest.raises(ValueError, match="read-only"):
        from_wire(to_wire([1.0]))[0] = 2.0


@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf, 1.001e9, -1e300])
def test_what_is_no_number_is_refused_with_a_count(value):
    with pytest.raises(NotFinite) as caught:
        from_wire(to_wire([1.0, value, value]))
    assert caught.value.count == 2


def test_vectors_and_quaternions_are_plain_tuples():
    assert vector3(np.arange(3)) == (0.0, 1.0, 2.0)
    assert quaternion(np.arange(4)) == (0.0, 1.0, 2.0, 3.0)
