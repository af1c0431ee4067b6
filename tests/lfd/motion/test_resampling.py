import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation, Slerp

from lfd.exceptions import TimesNotIncreasing, TooFewPoints, WrongShape
from lfd.motion.resampling import Interpolation, from_samples, resample
from lfd.motion.rotations import conjugate, exp_map, log_map, multiply, rotate
from lfd.motion.trajectory import Trajectory


def line(n):
    t = np.linspace(0.0, 1.0, n)[:, None]
    return Trajectory(t * [1.0, -2.0, 0.5], exp_map(t * [0.3, 0.1, -0.4]), duration=3.0)


seeds = st.integers(0, 10_000)


def wild(seed, n):
    """Six degrees of freedom at random, turning by up to 2 rad from point to point, the quaternions' signs mixed."""
    rng = np.random.default_rng(seed)
    steps = exp_map(rng.uniform(-1.1, 1.1, (n, 3)))
    orientations = [steps[0]]
    for step in steps[1:]:
        orientations.append(multiply(orientations[-1], step))
    return rng.normal(size=(n, 3)), rng.choice([-1.0, 1.0], (n, 1)) * orientations


def assert_same_rotations(p, q, atol=1e-12):
    np.testing.assert_allclose(np.abs(np.sum(p * q, axis=-1)), 1.0, atol=atol)


@given(st.integers(2, 40), st.integers(2, 40), st.sampled_from(Interpolation))
def test_a_line_at_constant_speed_stays_itself_at_any_number_of_points(n, m, interpolation):
    resampled = resample(line(n), m, interpolation)
    np.testing.assert_allclose(resampled.positions, line(m).positions, atol=1e-12)
    np.testing.assert_allclose(resampled.orientations, line(m).orientations, atol=1e-12)
    assert resampled.duration == 3.0


def test_the_same_number_of_points_changes_nothing(reach):
    trajectory = reach([0.9, 0.2, 0.6]).trajectory
    same = resample(trajectory, trajectory.n_points)
    np.testing.assert_allclose(same.positions, trajectory.positions, atol=1e-15)
    np.testing.assert_allclose(same.orientations, trajectory.orientations, atol=1e-12)


def test_cubic_is_exact_for_a_cubic():
    def cubic(n):
        t = np.linspace(0.0, 1.0, n)[:, None]
        return Trajectory(t**3 * [1.0, 2.0, 3.0] - t, np.tile([1.0, 0, 0, 0], (n, 1)), 1.0)

    np.testing.assert_allclose(resample(cubic(10), 75, Interpolation.CUBIC).positions, cubic(75).positions, atol=1e-12)


def test_irregular_samples_of_a_uniform_motion_become_regular(rng):
    times = 100.0 + np.concatenate([[0.0], np.sort(rng.uniform(0.0, 3.0, 30)), [3.0]])
    phase = (times - 100.0)[:, None] / 3.0
    trajectory = from_samples(times, phase * [1.0, -2.0, 0.5], exp_map(phase * [0.3, 0.1, -0.4]), n=20)
    np.testing.assert_allclose(trajectory.positions, line(20).positions, atol=1e-12)
    np.testing.assert_allclose(trajectory.orientations, line(20).orientations, atol=1e-12)
    assert trajectory.duration == pytest.approx(3.0)


def test_samples_out_of_order_are_refused_with_their_place():
    quaternions = np.tile([1.0, 0.0, 0.0, 0.0], (4, 1))
    with pytest.raises(TimesNotIncreasing) as caught:
        from_samples([0.0, 0.1, 0.1, 0.2], np.zeros((4, 3)), quaternions, 10)
    assert caught.value.index == 2


def test_samples_that_do_not_belong_together_are_refused():
    quaternions = np.tile([1.0, 0.0, 0.0, 0.0], (4, 1))
    with pytest.raises(WrongShape):
        from_samples([0.0, 0.1, 0.2], np.zeros((4, 3)), quaternions, 10)


def test_one_point_is_no_trajectory():
    with pytest.raises(TooFewPoints):
        resample(line(5), 1)


@given(seeds, st.integers(2, 12), st.integers(2, 40))
def test_orientations_are_those_of_scipys_slerp_of_unit_norm_and_sign_continuous(seed, n, m):
    positions, orientations = wild(seed, n)
    resampled = resample(Trajectory(positions, orientations, 3.0), m).orientations
    key_frames = Rotation.from_quat(orientations, scalar_first=True)
    expected = Slerp(np.linspace(0.0, 1.0, n), key_frames)(np.linspace(0.0, 1.0, m))
    assert_same_rotations(resampled, expected.as_quat(scalar_first=True))
    np.testing.assert_allclose(np.linalg.norm(resampled, axis=1), 1.0, atol=1e-14)
    assert (np.sum(resampled[1:] * resampled[:-1], axis=1) >= 0.0).all()


@given(seeds, st.integers(2, 12), st.integers(2, 40))
def test_the_signs_of_the_quaternions_do_not_matter(seed, n, m):
    positions, orientations = wild(seed, n)
    signs = np.random.default_rng(seed + 1).choice([-1.0, 1.0], (n, 1))
    times = np.linspace(0.0, 3.0, n)
    for make in (lambda q: resample(Trajectory(positions, q, 3.0), m), lambda q: from_samples(times, positions, q, m)):
        flipped, plain = make(signs * orientations), make(orientations)
        np.testing.assert_array_equal(flipped.positions, plain.positions)
        np.testing.assert_array_equal(flipped.orientations, signs[0] * plain.orientations)


@given(seeds, st.integers(2, 12), st.integers(1, 5), st.sampled_from(Interpolation))
def test_the_points_themselves_are_kept_where_their_times_are(seed, n, between, interpolation):
    positions, orientations = wild(seed, n)
    fine = resample(Trajectory(positions, orientations, 3.0), between * (n - 1) + 1, interpolation)
    np.testing.assert_allclose(fine.positions[::between], positions, atol=1e-10)
    assert_same_rotations(fine.orientations[::between], orientations)


@given(seeds, st.integers(2, 12), st.integers(2, 40), st.sampled_from(Interpolation))
def test_another_base_frame_describes_the_same_motion(seed, n, m, interpolation):
    positions, orientations = wild(seed, n)
    turn, shift = exp_map(np.array([0.4, -1.2, 2.0])), np.array([0.3, -0.2, 1.0])
    here = resample(Trajectory(positions, orientations, 3.0), m, interpolation)
    elsewhere = Trajectory(rotate(turn, positions) + shift, multiply(turn, orientations), 3.0)
    there = resample(elsewhere, m, interpolation)
    np.testing.assert_allclose(there.positions, rotate(turn, here.positions) + shift, atol=1e-9)
    assert_same_rotations(there.orientations, multiply(turn, here.orientations))


@given(seeds, st.integers(2, 12), st.integers(2, 40), st.sampled_from(Interpolation))
def test_backwards_in_time_it_is_the_same_path(seed, n, m, interpolation):
    positions, orientations = wild(seed, n)
    forth = resample(Trajectory(positions, orientations, 3.0), m, interpolation)
    back = resample(Trajectory(positions[::-1], orientations[::-1], 3.0), m, interpolation)
    np.testing.assert_allclose(back.positions[::-1], forth.positions, atol=1e-9)
    assert_same_rotations(back.orientations[::-1], forth.orientations)


@given(seeds, st.integers(2, 12), st.integers(2, 40))
def test_it_turns_no_further_than_from_point_to_point(seed, n, m):
    def turned(q):
        return np.linalg.norm(log_map(multiply(conjugate(q[:-1]), q[1:])), axis=1).sum()

    positions, orientations = wild(seed, n)
    assert turned(resample(Trajectory(positions, orientations, 3.0), m).orientations) <= turned(orientations) + 1e-9
