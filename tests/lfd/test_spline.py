"""The cubic spline, against an independent one and against its definition."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline

from lfd.spline import cubic_spline


@given(seed=st.integers(0, 10_000), n=st.integers(3, 40))
def test_it_is_the_not_a_knot_spline_of_scipy(seed, n):
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.uniform(0.5, 1.5, n))
    y = rng.normal(size=(n, 3))
    wanted = rng.uniform(x[0], x[-1], 50)
    np.testing.assert_allclose(cubic_spline(x, y, wanted), CubicSpline(x, y)(wanted), atol=1e-9)


def test_it_passes_through_its_points(rng):
    x, y = np.arange(6.0), rng.normal(size=(6, 2))
    np.testing.assert_allclose(cubic_spline(x, y, x), y, atol=1e-13)


@pytest.mark.parametrize(("n", "degree"), [(2, 1), (3, 2), (4, 3), (10, 3)])
def test_it_is_exact_for_polynomials_up_to_cubics(n, degree):
    x, wanted = np.linspace(0.0, 1.0, n), np.linspace(0.0, 1.0, 17)
    np.testing.assert_allclose(cubic_spline(x, x[:, None] ** degree, wanted)[:, 0], wanted**degree, atol=1e-13)
