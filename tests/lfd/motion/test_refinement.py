import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.exceptions import OutOfRange
from lfd.motion.refinement import refine
from lfd.motion.resampling import at_phases, resample
from lfd.motion.trajectory import Trajectory


def line(end, duration):
    return Trajectory(np.linspace(0.0, 1.0, 40)[:, None] * end, np.tile([1.0, 0, 0, 0], (40, 1)), duration)


@pytest.fixture
def prediction(reach):
    return reach([0.9, 0.2, 0.6], duration=5.0, n=75).trajectory


@pytest.fixture
def refinement(reach):
    return reach([0.9, 0.3, 0.7], bend=0.2, duration=8.0, n=140).trajectory


def test_alpha_one_is_the_refinement(prediction, refinement):
    refined, expected = refine(prediction, refinement), resample(refinement, 75)
    np.testing.assert_allclose(refined.positions, expected.positions, atol=1e-12)
    np.testing.assert_allclose(refined.orientations, expected.orientations, atol=1e-9)
    assert refined.duration == pytest.approx(8.0)


def test_alpha_zero_is_the_prediction(prediction, refinement):
    refined = refine(prediction, refinement, alpha=0.0)
    np.testing.assert_allclose(refined.positions, prediction.positions, atol=2e-4)
    assert refined.duration == pytest.approx(5.0)


@pytest.mark.parametrize("alpha", [0.0, 0.3, 1.0])
def test_a_satisfied_operator_changes_nothing(prediction, alpha):
    """tau_hr = tau_d is the fixed point at which the refinement loop of the thesis ends."""
    refined = refine(prediction, prediction, alpha)
    np.testing.assert_allclose(refined.positions, prediction.positions, atol=1e-12)


@given(alpha=st.floats(0.0, 1.0))
def test_the_end_points_and_the_duration_move_by_alpha(alpha):
    old, new = line(np.array([1.0, 0.0, 0.0]), 2.0), line(np.array([1.0, 1.0, 0.0]), 4.0)
    refined = refine(old, new, alpha)
    np.testing.assert_allclose(refined.positions[-1], [1.0, alpha, 0.0], atol=1e-12)
    assert refined.duration == pytest.approx(2.0 + 2.0 * alpha)
    assert refined.n_points == 75


@pytest.mark.parametrize("alpha", [0.0, 0.4, 1.0])
def test_orientations_have_unit_norm_and_the_quaternions_signs_do_not_matter(prediction, refinement, alpha):
    refined = refine(prediction, refinement, alpha)
    flipped = Trajectory(refinement.positions, -refinement.orientations, refinement.duration)
    other = refine(prediction, flipped, alpha)
    np.testing.assert_allclose(np.linalg.norm(refined.orientations, axis=1), 1.0, atol=1e-14)
    np.testing.assert_array_equal(other.positions, refined.positions)
    np.testing.assert_array_equal(other.orientations, refined.orientations)


@pytest.mark.parametrize("alpha", [0.0, 0.2, 0.5, 1.0])
def test_refining_is_symmetric(prediction, refinement, alpha):
    """The fraction alpha from one to the other is the fraction 1 - alpha from the other to the one."""
    there, back = refine(prediction, refinement, alpha), refine(refinement, prediction, 1.0 - alpha)
    np.testing.assert_allclose(there.positions, back.positions, atol=1e-12)
    np.testing.assert_allclose(np.abs(np.sum(there.orientations * back.orientations, axis=1)), 1.0, atol=1e-12)
    assert there.duration == pytest.approx(back.duration)


@given(alpha=st.floats(0.0, 1.0) | st.floats(0.0, 1e-14), duration=st.floats(0.1, 30.0))
def test_time_runs_forwards_whatever_the_tempo(alpha, duration):
    """On one line a blend of two motions that never turn back never turns back."""
    end = np.array([1.0, 2.0, 0.0])
    old, new = line(end, 3.0), at_phases(line(end, duration), np.linspace(0.0, 1.0, 70) ** 3)
    refined = refine(old, new, alpha)
    assert np.diff(refined.positions @ end).min() > 0.0
    assert refined.duration == pytest.approx((1.0 - alpha) * 3.0 + alpha * duration)


def test_points_that_correspond_are_blended_not_points_of_equal_time():
    """Figure 11: a refinement that stops short does not pull the whole prediction back by stretching over it."""
    end = np.array([1.0, 0.0, 0.0])
    corner = np.vstack([np.linspace([0, 0, 0], [1, 0, 0], 50), np.linspace([1, 0, 0], [1, 1, 0], 50)[1:]])
    whole = Trajectory(corner, np.tile([1.0, 0, 0, 0], (99, 1)), 10.0)
    short = Trajectory(corner[:70], np.tile([1.0, 0, 0, 0], (70, 1)), 7.0)
    refined = refine(whole, short, alpha=0.5, n=200)
    off_the_first_leg = refined.positions[refined.positions @ end < 0.98]
    np.testing.assert_allclose(off_the_first_leg[:, 1:], 0.0, atol=0.01)
    np.testing.assert_allclose(refined.positions[-1], 0.5 * (corner[-1] + corner[69]), atol=1e-12)


def test_alpha_outside_its_range_is_refused(prediction):
    with pytest.raises(OutOfRange):
        refine(prediction, prediction, alpha=1.5)
