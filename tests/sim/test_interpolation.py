"""Interpolation of way-points, against an independent one."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from sim.interpolation import covered_shares, numbers_at, through


@given(seed=st.integers(0, 10_000), n=st.integers(2, 12))
def test_it_is_the_monotone_line_of_scipy(seed, n):
    rng = np.random.default_rng(seed)
    points = rng.normal(size=(n, 3)).round(1)
    numbers = rng.uniform(0.0, n - 1.0, 40)
    expected = PchipInterpolator(np.arange(n), points)(numbers)
    np.testing.assert_allclose(through(points, numbers), expected, atol=1e-12)


def test_it_passes_through_its_points():
    points = np.array([[0.0, 1.0], [2.0, 1.0], [1.0, 4.0]])
    np.testing.assert_array_equal(through(points, np.arange(3.0)), points)


def test_half_of_a_lines_length_is_in_its_middle_however_its_points_lie():
    points = np.array([[0.0, 0.0], [0.1, 0.0], [1.0, 0.0]])
    halfway = through(points, numbers_at(points, np.array([0.0, 0.5, 1.0])))
    np.testing.assert_allclose(halfway[:, 0], [0.0, 0.5, 1.0], atol=1e-3)


def test_a_line_that_goes_nowhere_is_covered_evenly():
    np.testing.assert_allclose(covered_shares(np.ones((5, 3))), np.linspace(0.0, 1.0, 5))
