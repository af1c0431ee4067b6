import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from sim.rotations import rotated, rotation_to

below_pi = st.tuples(*[st.floats(-1.8, 1.8)] * 3).map(np.array)
signs = st.sampled_from([-1.0, 1.0])


def quaternions(vectors):
    return Rotation.from_rotvec(vectors).as_quat(scalar_first=True)


@given(below_pi, below_pi)
def test_a_rotation_is_applied_in_base_axes_as_scipy_does(r, orientation):
    expected = Rotation.from_rotvec(r) * Rotation.from_rotvec(orientation)
    actual = Rotation.from_quat(rotated(quaternions(orientation), r), scalar_first=True)
    assert (actual * expected.inv()).magnitude() < 1e-9


@given(below_pi, below_pi, signs, signs)
def test_the_rotation_between_two_leads_from_one_to_the_other_whatever_their_signs(a, b, sign_a, sign_b):
    p, q = quaternions(a), quaternions(b)
    r = rotation_to(sign_a * p, sign_b * q)
    assert np.linalg.norm(r) <= np.pi + 1e-12
    assert abs(rotated(p, r) @ q) > 1.0 - 1e-12


def test_no_rotation_is_no_rotation_and_a_small_one_keeps_its_size():
    q = quaternions([0.4, -0.2, 1.0])
    np.testing.assert_array_equal(rotated(q, np.zeros(3)), q)
    np.testing.assert_allclose(rotation_to(q, q), 0.0, atol=1e-15)
    np.testing.assert_allclose(rotation_to(q, rotated(q, np.array([1e-9, 0.0, 0.0]))), [1e-9, 0.0, 0.0], atol=1e-15)


def test_both_take_rows():
    vectors = np.random.default_rng(0).uniform(-1.0, 1.0, (5, 3))
    before = quaternions(np.random.default_rng(1).uniform(-1.0, 1.0, (5, 3)))
    np.testing.assert_allclose(rotation_to(before, rotated(before, vectors)), vectors, atol=1e-12)
