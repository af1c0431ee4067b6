from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.adaptive.kinds import DURATION, ORIENTATION, POSITION
from lfd.models.adaptive.moments import Moments
from lfd.models.adaptive.regression import RegressionOptions
from lfd.models.adaptive.trend import slopes, slopes_by_coordinate
from tests.lfd.models.adaptive.vectors import KINDS, D, regression, sized

OPTIONS = RegressionOptions()
TRENDS = len(OPTIONS.trend.shrinkages) + 1


@given(st.integers(1, 4), st.integers(0, 2**32 - 1))
def test_a_linear_family_is_recovered_whatever_its_size_and_trusted_everywhere(c, seed):
    rng = np.random.default_rng(seed)
    slope, offset = rng.normal(size=(c, D)), rng.normal(size=D)
    conditions = rng.normal(size=(c + 4, c))
    fitted = regression(conditions, conditions @ slope + offset)
    s = 10.0 * rng.normal(size=c)
    np.testing.assert_allclose(fitted.at(s).mean, s @ slope + offset, atol=1e-6)
    np.testing.assert_allclose(fitted.shares[-1], 1.0, atol=1e-3)


@pytest.mark.parametrize("M", [2, 3, 5, 21, 26, 50, 100, 300])
def test_more_demonstrations_are_never_worse(M, rng):
    slope, conditions = rng.normal(size=(1, D)), np.linspace(-0.5, 0.5, M)[:, None]
    fitted = regression(conditions, conditions @ slope)
    along = np.linspace(-0.5, 0.5, 41)[:, None]
    np.testing.assert_allclose(fitted.at_each(along)[0], along @ slope, atol=1e-6)


def test_what_does_not_depend_on_the_condition_counts_the_trend_of_no_slope_most(rng):
    fitted = regression(rng.normal(size=(30, 2)), rng.normal(size=(30, D)))
    assert (fitted.shares.argmax(axis=0) == TRENDS - 2).all()


def test_only_a_trend_that_predicts_exactly_is_followed_far_beyond_the_conditions_shown(rng):
    """The line of noise ends softly beyond them; what is predicted departs no further from the mean than it does."""
    fitted = regression(rng.normal(size=(30, 2)), rng.normal(size=(30, D)))
    line = replace(fitted)
    line.__dict__["shares"] = np.eye(TRENDS)[:, :1] * np.ones(3)
    far, mean = np.array([50.0, -50.0]), fitted.vectors.mean(axis=0)
    assert np.linalg.norm(fitted.at(far).mean - mean) < np.linalg.norm(line.at(far).mean - mean)


def test_each_kind_of_output_trusts_the_trend_that_serves_it(rng):
    """Positions are linear in the condition, orientations the same everywhere but for noise."""
    conditions = rng.normal(size=(12, 2))
    vectors = np.zeros((12, D))
    vectors[:, KINDS.columns[POSITION]] = conditions @ rng.normal(size=(2, 9))
    vectors[:, KINDS.columns[ORIENTATION]] = rng.normal(size=(12, 9))
    fitted = regression(conditions, vectors)
    assert fitted.shares[-1, POSITION] == pytest.approx(1.0, abs=1e-3)
    assert fitted.shares[:, ORIENTATION].argmax() == TRENDS - 2


@pytest.mark.parametrize("conditions", [[[0.3]], [[0.3], [0.3]], [[0.3], [0.301], [0.299]]], ids=["1", "2", "3"])
def test_one_condition_teaches_no_trend(conditions, rng):
    vectors = rng.normal(size=(len(conditions), D))
    fitted = regression(conditions, vectors)
    np.testing.assert_allclose(fitted.at(np.array([50.0])).mean, vectors.mean(axis=0), atol=1e-6)
    np.testing.assert_array_equal(fitted.shares, np.eye(TRENDS)[:, [TRENDS - 2]] * np.ones(3))
    assert fitted.left_out[0].shape == vectors.shape
    assert np.isnan(fitted.left_out[0]).all()
    assert np.isnan(fitted.left_out[1]).all()
    assert fitted.score == np.inf


def test_two_conditions_are_joined_by_a_line_that_ends_beyond_them(rng):
    vectors = rng.normal(size=(2, D))
    fitted = regression([[-0.5], [0.5]], vectors)
    np.testing.assert_allclose(fitted.at(np.array([0.0])).mean, vectors.mean(axis=0), atol=1e-9)
    np.testing.assert_allclose(fitted.at(np.array([0.5])).mean, vectors[1], atol=1e-9)
    most = 0.5 * (1.0 + OPTIONS.trend.softness)
    expected = vectors.mean(axis=0) + most * (vectors[1] - vectors[0])
    np.testing.assert_allclose(fitted.at(np.array([50.0])).mean, expected, atol=1e-9)
    assert (fitted.shares[0] == 1.0).all()
    assert fitted.shares.sum() == 3.0


def test_coordinates_that_each_depend_on_their_own_are_told_from_all_else(rng):
    """Few noisy motions: what follows the object axis by axis is learnt by trends that know no more than that."""
    conditions = rng.normal(size=(8, 3))
    slope = np.zeros((3, D))
    for axis in range(3):
        slope[axis, KINDS.axis_of_column == axis] = 1.0
    noisy = conditions @ slope + 0.5 * rng.normal(size=(8, D))
    places, numbers = (regression(conditions, noisy, axes=axes) for axes in ([0, 1, 2], None))
    assert places.shares[TRENDS:, POSITION].sum() > 0.9
    missed, missed_without = (
        KINDS.sizes(conditions @ slope - fitted.at_each(conditions)[0])[POSITION].sum() for fitted in (places, numbers)
    )
    assert missed < 0.7 * missed_without


def test_by_coordinates_a_motion_follows_each_coordinate_of_the_place_in_its_own_only(rng):
    conditions = rng.normal(size=(8, 3))
    fitted = regression(conditions, rng.normal(size=(8, D)), axes=[0, 1, 2])
    fitted.__dict__["shares"] = np.eye(2 * TRENDS - 1)[:, [TRENDS]] * np.ones(3)
    centre = conditions.mean(axis=0)
    for axis, step in enumerate(0.1 * np.eye(3)):
        changed = np.abs(fitted.at(centre + step).mean - fitted.at(centre).mean) > 1e-9
        of_column = KINDS.axis_of_column
        np.testing.assert_array_equal(changed, (of_column < 0) | (of_column == axis))


@pytest.fixture(params=[None, [1, -1]], ids=["numbers", "place and number"])
def curved(rng, request):
    conditions = np.repeat(rng.normal(size=(5, 2)), [1, 2, 1, 3, 1], axis=0)
    vectors = rng.normal(size=(8, D)) + conditions @ rng.normal(size=(2, D))
    return regression(conditions, vectors, axes=request.param)


def anew(whole, rest):
    """Fitted without some, what was chosen by all of them given."""
    fitted = replace(whole, conditions=whole.conditions[rest], vectors=whole.vectors[rest])
    fitted.__dict__["shares"], fitted.__dict__["length"] = whole.shares, whole.length
    return fitted


def test_left_out_errors_are_those_of_a_regression_that_has_not_seen_the_condition(curved):
    errors, variances = curved.left_out
    for group in curved.groups:
        fitted = anew(curved, np.setdiff1d(np.arange(8), group))
        for i in group:
            s = curved.conditions[i]
            np.testing.assert_allclose(errors[i], curved.vectors[i] - fitted.at(s).mean, atol=1e-9)
            assert variances[i] == pytest.approx(fitted.uncertainty(fitted.at(s)), rel=1e-6)


def test_shares_go_with_a_power_of_the_errors_at_left_out_conditions(curved):
    """Of each trend alone, in each kind: fitted anew without each condition."""
    count = len(curved.shares)
    squares = np.zeros((count, 3))
    for k in range(count):
        alone = np.zeros((count, 3))
        alone[k] = 1.0
        for group in curved.groups:
            fitted = anew(curved, np.setdiff1d(np.arange(8), group))
            fitted.__dict__["shares"] = alone
            missed = curved.vectors[group] - fitted.at_each(curved.conditions[group])[0]
            squares[k] += KINDS.sizes(missed).sum(axis=1)
    weights = squares**-OPTIONS.sharpness
    weights[TRENDS - 1] = 0.0  # followed everywhere only if it predicts exactly
    np.testing.assert_allclose(curved.shares, weights / weights.sum(axis=0), rtol=1e-6)


def test_however_sharply_trends_are_told_apart_the_best_counts_and_nothing_overflows(curved):
    sharp = replace(curved, options=replace(OPTIONS, sharpness=1e6))
    np.testing.assert_allclose(sharp.shares, curved.shares == curved.shares.max(axis=0), atol=1e-9)


def test_the_score_is_the_error_at_left_out_conditions_relative_to_the_spread(curved):
    spread = KINDS.sizes(curved.vectors - curved.vectors.mean(axis=0)).sum(axis=1)
    assert curved.score == pytest.approx(np.sum(KINDS.sizes(curved.left_out[0]).sum(axis=1) / spread))


def test_a_kind_that_never_differs_but_for_rounding_does_not_count_in_the_score(curved):
    vectors = curved.vectors.copy()
    vectors[:, KINDS.columns[ORIENTATION]] = np.where(np.arange(8) % 2, 0.3, 0.1 + 0.2)[:, None]
    vectors[:, KINDS.columns[DURATION]] = -1.0
    score = replace(curved, vectors=vectors).score
    spread = KINDS.sizes(vectors - vectors.mean(axis=0)).sum(axis=1)[POSITION]
    missed = KINDS.sizes(replace(curved, vectors=vectors).left_out[0]).sum(axis=1)[POSITION]
    assert score == pytest.approx(missed / spread)


def test_departures_from_the_trend_are_a_gaussian_process(curved):
    """Ordinary formulas, with the trend that was chosen: k (K + r I)^-1 (X - trend)."""
    z, s = curved.conditions, np.array([0.3, -0.2])
    centre = z.mean(axis=0)
    length = np.sqrt(OPTIONS.near**2 + OPTIONS.near_spread**2 * np.mean(np.sum((z - centre) ** 2, axis=1)))
    assert curved.length == pytest.approx(length)
    K = np.exp(-0.5 * np.sum((z[:, None] - z) ** 2, axis=2) / length**2)
    k = np.exp(-0.5 * np.sum((z - s) ** 2, axis=1) / length**2)
    weights = np.linalg.solve(K + OPTIONS.noise * np.eye(8), k)
    assert np.linalg.norm(s - centre) < np.linalg.norm(z - centre, axis=1).max()
    away = curved.vectors - curved.vectors.mean(axis=0)
    moments, trend = Moments.of(z, curved.vectors), OPTIONS.trend
    beside = slopes(moments, trend)
    shares = curved.shares[:, KINDS.of_column]
    expected = curved.vectors.mean(axis=0)
    for share, B in zip(shares, [*beside, beside[0]], strict=False):
        expected = expected + share * ((s - centre) @ B + weights @ (away - (z - centre) @ B))
    if len(shares) > TRENDS:
        # The first dimension is the second coordinate of the place: other coordinates do not depend on it.
        depends = np.array([(KINDS.axis_of_column < 0) | (KINDS.axis_of_column == 1), np.ones(D, dtype=bool)])
        alone = (s - centre) @ slopes_by_coordinate(moments, depends, trend)
        expected = expected + np.sum(shares[TRENDS:] * alone, axis=0)
    np.testing.assert_allclose(curved.at(s).mean, expected, atol=1e-9)
    assert curved.at(s).unexplained == pytest.approx(1.0 - weights @ k)


def test_many_conditions_at_once_are_as_one_by_one(curved, rng):
    conditions = 5.0 * rng.normal(size=(6, 2))
    for s, mean, outside in zip(conditions, *curved.at_each(conditions), strict=True):
        expected = curved.at(s)
        np.testing.assert_allclose(mean, expected.mean, atol=1e-12)
        np.testing.assert_allclose(outside, expected.outside, atol=1e-12)


def test_among_the_conditions_shown_nothing_is_outside_and_beyond_them_more_and_more(curved):
    np.testing.assert_allclose(curved.at_each(curved.conditions)[1], 0.0, atol=1e-12)
    direction = np.array([0.6, 0.8])
    beyond = [np.linalg.norm(curved.at(direction * far).outside) for far in (3.0, 5.0, 50.0)]
    assert (np.diff(beyond) > 0.0).all()
    assert beyond[-1] > 40.0


def test_the_variance_of_one_demonstration_by_hand(rng):
    """At its own condition: r + (1 - 1 / (1 + r)) (1 + 1); far from it the trend's reach is added."""
    fitted = regression([[0.2]], rng.normal(size=(1, D)))
    r, s = OPTIONS.noise, np.array([0.2])
    assert fitted.uncertainty(fitted.at(s)) == pytest.approx(r + (1.0 - 1.0 / (1.0 + r)) * 2.0)
    far = np.array([0.7])
    nearness = np.exp(-0.5 * (0.5 / OPTIONS.near) ** 2)
    expected = r + (1.0 - nearness**2 / (1.0 + r)) * (2.0 + 0.5**2 / OPTIONS.trend.least**2)
    assert fitted.uncertainty(fitted.at(far)) == pytest.approx(expected)


def test_uncertainty_grows_away_from_the_conditions(rng):
    fitted = regression(rng.uniform(-0.1, 0.1, size=(6, 2)), rng.normal(size=(6, D)))
    away = [np.array([x, 0.0]) for x in (0.1, 0.3, 0.6, 1.0, 3.0)]
    assert (np.diff([fitted.uncertainty(fitted.at(s)) for s in away]) > 0.0).all()


def test_conditions_nearer_than_that_are_one(rng):
    fitted = regression([[0.0], [0.9 * OPTIONS.same], [2.0 * OPTIONS.same]], rng.normal(size=(3, D)))
    assert [group.tolist() for group in fitted.groups] == [[0, 1], [2]]


def test_identical_demonstrations_are_predicted_as_they_are():
    vectors = np.tile(sized(POSITION, 0.3) + sized(DURATION, 1.0), (6, 1))
    fitted = regression(np.linspace(-1.0, 1.0, 6)[:, None], vectors)
    np.testing.assert_allclose(fitted.at(np.array([7.0])).mean, vectors[0], atol=1e-9)
    assert np.isfinite(fitted.shares).all()
