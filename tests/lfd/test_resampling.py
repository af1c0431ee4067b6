import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.exceptions import TimesNotIncreasing, TooFewPoints, WrongShape
from lfd.resampling import Interpolation, from_samples, resample
from lfd.rotations import exp_map
from lfd.trajectory import Trajectory


def line(n):
    t = np.linspace(0.0, 1.0, n)[:, None]
    return Trajectory(t * [1.0, -2.0, 0.5], exp_map(t * [0.3, 0.1, -0.4]), duration=3.0)


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
