import numpy as np
import pytest

from lfd.models.adaptive.kinds import DURATION, ORIENTATION, POSITION
from lfd.models.adaptive.spread import SpreadPrior, spread_of
from tests.lfd.models.adaptive.vectors import ENCODING, KINDS, D

PRIOR = SpreadPrior()


def test_before_a_condition_was_left_out_the_assumption_holds():
    spread = spread_of(ENCODING, np.full((2, D), np.nan), np.full(2, np.nan), 0.5, PRIOR)
    diagonal = np.diag(spread.covariance)
    np.testing.assert_allclose(diagonal[KINDS.columns[POSITION]], (PRIOR.position_std * 0.5) ** 2)
    np.testing.assert_allclose(diagonal[KINDS.columns[ORIENTATION]], PRIOR.rotation_std**2)
    np.testing.assert_allclose(diagonal[KINDS.columns[DURATION]], PRIOR.duration_std**2)


def test_departures_are_alike_at_near_phases_and_each_output_departs_by_itself():
    spread = spread_of(ENCODING, np.zeros((0, D)), np.zeros(0), 0.5, PRIOR)
    weights = spread.covariance[:-1, :-1].reshape(3, 6, 3, 6)
    alike = np.exp(-0.5 * ((np.arange(3)[:, None] - np.arange(3)) * 0.5 / 0.2) ** 2)
    for output, std in enumerate([PRIOR.position_std * 0.5] * 3 + [PRIOR.rotation_std] * 3):
        np.testing.assert_allclose(weights[:, output, :, output], std**2 * alike)
        others = [o for o in range(6) if o != output]
        np.testing.assert_array_equal(weights[:, output][:, :, others], 0.0)
    np.testing.assert_array_equal(spread.covariance[-1, :-1], 0.0)


def test_errors_count_in_units_of_their_predicted_variance_beside_the_assumption(rng):
    errors, variances = rng.normal(size=(6, D)), rng.uniform(0.5, 2.0, size=6)
    variances[2] = np.nan
    known = [0, 1, 3, 4, 5]
    assumed = spread_of(ENCODING, errors[:0], variances[:0], 0.5, PRIOR).covariance
    scatter = sum(np.outer(errors[i], errors[i]) / variances[i] for i in known)
    expected = (PRIOR.count * assumed + scatter) / (PRIOR.count + 5)
    np.testing.assert_allclose(spread_of(ENCODING, errors, variances, 0.5, PRIOR).covariance, expected)


@pytest.mark.parametrize("n", [75, 20])
def test_the_positions_spread_as_those_of_motions_drawn_from_it(n, rng):
    spread = spread_of(ENCODING, rng.normal(size=(9, D)), np.ones(9), 0.5, PRIOR)
    draws = rng.multivariate_normal(np.zeros(D), spread.covariance, size=20000)
    paths = ENCODING.positions(draws, n)
    drawn = np.einsum("jni,njk->nik", paths, paths.transpose(1, 0, 2)) / len(draws)
    np.testing.assert_allclose(spread.positions(n), drawn, atol=0.05 * np.abs(drawn).max())


def test_the_mean_square_is_that_of_positions_over_time(rng):
    spread = spread_of(ENCODING, rng.normal(size=(9, D)), np.ones(9), 0.5, PRIOR)
    assert spread.mean_square == pytest.approx(np.trace(spread.positions(75), axis1=1, axis2=2).mean())
