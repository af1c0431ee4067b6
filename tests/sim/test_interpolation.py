"""Interpolation of way-points, against an independent one."""

import numpy as np
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import PchipInterpolator

from sim.interpolation import through


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
