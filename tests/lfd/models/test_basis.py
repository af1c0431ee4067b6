import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.exceptions import OutOfRange
from lfd.models.basis import GaussianBasis, least_squares

PHASES = np.linspace(0.0, 1.0, 75)


@given(st.integers(2, 30), st.floats(0.03, 0.5))
def test_functions_sum_to_one_at_every_phase(count, width):
    np.testing.assert_allclose(GaussianBasis(count, width).matrix(PHASES).sum(axis=1), 1.0, atol=1e-12)


def test_weights_of_a_combination_are_its_own(rng):
    Phi = GaussianBasis(10, 0.1).matrix(PHASES)
    w = rng.normal(size=(10, 3))
    np.testing.assert_allclose(least_squares(Phi) @ Phi @ w, w, atol=1e-9)


def test_residual_is_orthogonal_to_the_functions(rng):
    """The normal equations of least squares, which equation (3) solves."""
    Phi, values = GaussianBasis(10, 0.1).matrix(PHASES), rng.normal(size=(75, 2))
    np.testing.assert_allclose(Phi.T @ (values - Phi @ least_squares(Phi) @ values), 0.0, atol=1e-10)


def test_with_fewer_samples_than_functions_the_weights_are_the_smallest(rng):
    Phi, values = GaussianBasis(20, 0.05).matrix(np.linspace(0.0, 1.0, 10)), rng.normal(size=(10, 2))
    expected = np.linalg.lstsq(Phi, values, rcond=None)[0]
    np.testing.assert_allclose(least_squares(Phi) @ values, expected, atol=1e-9)


@pytest.mark.parametrize("arguments", [(1, 0.1), (10, 0.0), (10, float("nan"))])
def test_a_basis_that_cannot_be_is_refused(arguments):
    with pytest.raises(OutOfRange):
        GaussianBasis(*arguments)
