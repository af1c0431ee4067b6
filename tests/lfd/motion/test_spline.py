"""The splines, against independent ones and against their definitions."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.interpolate import CubicSpline, interp1d

from lfd.motion.spline import cubic_spline, quadratic_spline


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


def quadratics_of_the_thesis(x, y):
    """The a, b and c of each piece, shape (n, 3), from the 3 n equations of the text."""
    n = len(x) - 1
    A, right = np.zeros((3 * n, 3 * n)), np.zeros(3 * n)
    for i in range(n):
        for row, end in ((2 * i, i), (2 * i + 1, i + 1)):
            A[row, 3 * i : 3 * i + 3] = x[end] ** 2, x[end], 1.0  # (E.2)
            right[row] = y[end]
    for i in range(n - 1):
        knot = x[i + 1]
        A[2 * n + i, 3 * i : 3 * i + 6] = 2.0 * knot, 1.0, 0.0, -2.0 * knot, -1.0, 0.0  # (E.3) to (E.6)
    A[-1, 0] = 1.0  # a_1 = 0
    return np.linalg.solve(A, right).reshape(n, 3)


@given(seed=st.integers(0, 10_000), n=st.integers(2, 12))
def test_the_quadratic_one_solves_the_equations_of_the_thesis(seed, n):
    rng = np.random.default_rng(seed)
    x = np.cumsum(rng.uniform(0.5, 1.5, n))
    y = rng.normal(size=n)
    for piece, abc in enumerate(quadratics_of_the_thesis(x, y)):
        wanted = rng.uniform(x[piece], x[piece + 1], 9)
        np.testing.assert_allclose(quadratic_spline(x, y[:, None], wanted)[:, 0], np.polyval(abc, wanted), atol=1e-7)


@given(seed=st.integers(0, 10_000), n=st.integers(2, 40))
def test_the_quadratic_one_passes_through_its_points_with_one_slope_and_begins_straight(seed, n):
    rng = np.random.default_rng(seed)
    x, y = np.cumsum(rng.uniform(0.5, 1.5, n)), rng.normal(size=(n, 3))
    np.testing.assert_allclose(quadratic_spline(x, y, x), y, atol=1e-10)
    step = 1e-6
    before, at, after = (quadratic_spline(x, y, x[1:-1] + shift) for shift in (-step, 0.0, step))
    np.testing.assert_allclose((at - before) / step, (after - at) / step, atol=1e-3)
    first = quadratic_spline(x, y, np.linspace(x[0], x[1], 5))
    np.testing.assert_allclose(np.diff(first, axis=0, n=2), 0.0, atol=1e-12)


def test_the_quadratic_one_is_exact_for_a_straight_line_and_is_not_that_of_scipy(rng):
    x, wanted = np.cumsum(rng.uniform(0.5, 1.5, 6)), np.linspace(3.0, 4.0, 9)
    line = np.outer(x, [1.0, -2.0, 0.5]) + 3.0
    np.testing.assert_allclose(quadratic_spline(x, line, wanted), np.outer(wanted, [1.0, -2.0, 0.5]) + 3.0, atol=1e-12)
    bent = line + rng.normal(size=(6, 3))
    difference = quadratic_spline(x, bent, wanted) - interp1d(x, bent, kind="quadratic", axis=0)(wanted)
    assert np.abs(difference).max() > 0.01
