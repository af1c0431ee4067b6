import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from lfd.haptics import force

vectors = st.tuples(*[st.floats(-1.0, 1.0)] * 3).map(np.array)


def test_one_centimetre_at_rest_pulls_back_with_half_a_newton():
    np.testing.assert_allclose(force(np.array([0.01, 0.0, 0.0]), np.zeros(3)), [-0.5, 0.0, 0.0])


@given(vectors, vectors, st.floats(0.0, 2.0))
def test_force_is_linear_in_the_scale(displacement, velocity, scale):
    np.testing.assert_allclose(
        force(displacement, velocity, scale=scale), scale * force(displacement, velocity), atol=1e-12
    )


@given(vectors)
def test_damping_never_drives_the_hand(velocity):
    assert force(np.zeros(3), velocity) @ velocity <= 0.0


@given(vectors, vectors)
def test_along_one_axis_it_is_the_same_to_the_last_bit(displacement, velocity):
    along = [force(x, v) for x, v in zip(displacement.tolist(), velocity.tolist(), strict=True)]
    assert along == force(displacement, velocity).tolist()
