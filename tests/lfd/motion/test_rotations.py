import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from lfd.motion import rotations

components = st.floats(-1.7, 1.7)
vectors = st.tuples(components, components, components).map(np.array)  # below pi in length


def xyzw(q):
    return q[..., [1, 2, 3, 0]]


def same_rotation(p, q):
    return np.allclose(np.abs(np.sum(p * q, axis=-1)), 1.0, atol=1e-12)


@given(vectors)
def test_log_is_the_inverse_of_exp(r):
    np.testing.assert_allclose(rotations.log_map(rotations.exp_map(r)), r, atol=1e-9)


@pytest.mark.parametrize("size", [0.0, 1e-200, 1e-12, 1e-8, 1e-5])
def test_log_is_the_inverse_of_exp_near_the_identity(size):
    r = size * np.array([0.6, 0.0, -0.8])
    np.testing.assert_allclose(rotations.log_map(rotations.exp_map(r)), r, rtol=1e-6, atol=0.0)


def test_log_is_the_same_where_rounding_left_the_scalar_part_a_little_below_one():
    q = np.array([np.nextafter(1.0, 0.0), 3e-10, 0.0, -4e-10])
    np.testing.assert_allclose(rotations.log_map(q), [6e-10, 0.0, -8e-10], rtol=1e-9, atol=0.0)


@pytest.mark.parametrize("size", [1e-12, 1e-8, 1e-5])
def test_log_that_keeps_the_sign_is_near_a_full_turn_what_it_is_near_none(size):
    """Where the rotation vector is about as long as a full turn its direction has no meaning; near none it has."""
    r = size * np.array([0.6, 0.0, -0.8])
    back = rotations.exp_map(rotations.log_map(-rotations.exp_map(r), shortest=False))
    assert rotations.log_map(back) == pytest.approx(r, rel=1e-6)


@given(vectors)
def test_the_vector_of_a_quaternion_and_of_its_negative_is_the_same_and_at_most_pi_long(r):
    q = rotations.exp_map(3.0 * r)
    np.testing.assert_array_equal(rotations.log_map(-q), rotations.log_map(q))
    assert np.linalg.norm(rotations.log_map(q)) <= np.pi


@given(st.tuples(*[st.floats(-100.0, 100.0)] * 3).map(np.array))
def test_exp_has_unit_norm_for_many_turns_as_well(r):
    assert np.linalg.norm(rotations.exp_map(r)) == pytest.approx(1.0, abs=1e-12)


@given(vectors, vectors)
def test_product_is_that_of_scipy(a, b):
    product = rotations.multiply(rotations.exp_map(a), rotations.exp_map(b))
    expected = Rotation.from_rotvec(a) * Rotation.from_rotvec(b)
    assert same_rotation(xyzw(product), expected.as_quat())


def test_nobody_can_change_what_the_identity_is():
    np.testing.assert_array_equal(rotations.IDENTITY, [1.0, 0.0, 0.0, 0.0])
    assert not rotations.IDENTITY.flags.writeable


@given(vectors)
def test_conjugate_is_the_inverse(r):
    q = rotations.exp_map(r)
    np.testing.assert_allclose(rotations.multiply(q, rotations.conjugate(q)), rotations.IDENTITY, atol=1e-12)


@given(vectors, vectors)
def test_rotate_is_multiplication_by_the_matrix(r, v):
    q = rotations.exp_map(r)
    np.testing.assert_allclose(rotations.rotate(q, v), rotations.matrix_from_quaternion(q) @ v, atol=1e-12)
    np.testing.assert_allclose(rotations.matrix_from_quaternion(q), Rotation.from_rotvec(r).as_matrix(), atol=1e-12)


@given(vectors, vectors, st.floats(0.0, 1.0))
def test_slerp_turns_at_a_constant_rate_about_one_axis(a, b, fraction):
    p, q = rotations.exp_map(a), rotations.exp_map(b)
    whole = rotations.log_map(rotations.multiply(rotations.conjugate(p), q))
    part = rotations.multiply(rotations.conjugate(p), rotations.slerp(p, q, np.array(fraction)))
    np.testing.assert_allclose(rotations.log_map(part), fraction * whole, atol=1e-7)


def test_slerp_takes_the_shorter_way_whatever_the_signs():
    p, q = rotations.exp_map(np.array([0.1, 0.0, 0.0])), rotations.exp_map(np.array([0.3, 0.0, 0.0]))
    middle = rotations.slerp(p, -q, np.array(0.5))
    assert same_rotation(middle, rotations.exp_map(np.array([0.2, 0.0, 0.0])))


@given(vectors, vectors, st.floats(0.0, 1.0), st.sampled_from([-1.0, 1.0]))
def test_slerp_is_that_of_scipy_has_unit_norm_and_is_the_same_from_the_other_end(a, b, fraction, sign):
    p, q = rotations.exp_map(a), sign * rotations.exp_map(b)
    part = rotations.slerp(p, q, np.array(fraction))
    expected = Slerp([0.0, 1.0], Rotation.from_rotvec([a, b]))(fraction)
    assert same_rotation(xyzw(part), expected.as_quat())
    assert np.linalg.norm(part) == pytest.approx(1.0, abs=1e-14)
    assert same_rotation(part, rotations.slerp(q, p, np.array(1.0 - fraction)))


@given(vectors, vectors, vectors, st.floats(0.0, 1.0))
def test_slerp_is_the_same_in_any_frame_and_for_any_tool(a, b, c, fraction):
    p, q, turn = rotations.exp_map(a), rotations.exp_map(b), rotations.exp_map(c)
    part = rotations.slerp(p, q, np.array(fraction))
    for move in (lambda r: rotations.multiply(turn, r), lambda r: rotations.multiply(r, turn)):
        assert same_rotation(rotations.slerp(move(p), move(q), np.array(fraction)), move(part))


@given(vectors, vectors)
def test_a_rotation_keeps_lengths_and_its_negative_quaternion_is_the_same_rotation(r, v):
    q = rotations.exp_map(r)
    assert np.linalg.norm(rotations.rotate(q, v)) == pytest.approx(np.linalg.norm(v), abs=1e-12)
    np.testing.assert_array_equal(rotations.rotate(-q, v), rotations.rotate(q, v))


def test_mean_rotation_ignores_signs_and_is_the_middle_of_a_symmetric_set(rng):
    centre = rotations.exp_map(np.array([0.3, -0.2, 0.5]))
    tangents = rng.normal(scale=0.3, size=(10, 3))
    q = rotations.multiply(centre, rotations.exp_map(np.vstack([tangents, -tangents])))
    signs = rng.choice([-1.0, 1.0], size=(20, 1))
    mean = rotations.mean_rotation(signs * q)
    assert same_rotation(mean, centre)
    assert mean[0] > 0.0


@given(st.lists(st.tuples(*[st.floats(-3.0, 3.0)] * 3), min_size=1, max_size=4).map(np.array))
def test_a_mean_rotation_has_no_negative_scalar_part(r):
    assert rotations.mean_rotation(rotations.exp_map(r))[0] >= 0.0


def test_sign_continuous_keeps_the_rotations_and_joins_the_signs(rng):
    q = rotations.exp_map(np.linspace(0.0, 5.0, 40)[:, None] * [0.0, 0.6, 0.8])
    joined = rotations.sign_continuous(rng.choice([-1.0, 1.0], size=(40, 1)) * q)
    assert same_rotation(joined, q)
    assert (np.sum(joined[1:] * joined[:-1], axis=1) > 0.0).all()


def test_log_along_a_continuous_sequence_passes_pi_without_a_jump():
    r = np.linspace(0.0, 5.0, 40)[:, None] * [0.0, 0.6, 0.8]
    np.testing.assert_allclose(rotations.log_map(rotations.exp_map(r), shortest=False), r, atol=1e-12)


def test_many_rotations_have_the_matrices_of_each():
    q = rotations.exp_map(np.array([[0.3, -0.2, 0.5], [1.0, 0.0, 0.0], [0.0, -2.0, 0.4]])).reshape(3, 1, 4)
    many = rotations.matrix_from_quaternion(q)
    assert many.shape == (3, 1, 3, 3)
    for one, matrix in zip(q[:, 0], many[:, 0], strict=True):
        np.testing.assert_array_equal(matrix, rotations.matrix_from_quaternion(one))
        np.testing.assert_allclose(matrix, Rotation.from_quat(xyzw(one)).as_matrix(), atol=1e-12)
