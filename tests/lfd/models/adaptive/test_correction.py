import numpy as np
import pytest

from lfd.models.adaptive.correction import CorrectionOptions, Corrections
from lfd.models.adaptive.regression import Regression, RegressionOptions

OPTIONS = CorrectionOptions()


@pytest.fixture
def none(rng):
    """Six demonstrations of a plane, not corrected yet."""
    conditions = rng.uniform(-0.2, 0.2, size=(6, 2))
    vectors = conditions @ rng.normal(size=(2, 4)) + 1.0
    return Corrections.none(Regression(conditions, vectors, np.eye(4), 0.5, RegressionOptions()), OPTIONS)


def change(corrections, s):
    return corrections.effect(corrections.regression.at(s)).change


def open_share(corrections, s):
    return corrections.effect(corrections.regression.at(s)).open_share


def correct(corrections, s, y):
    place = corrections.regression.at(s)
    return corrections.added(place, place.mean + y)


def test_without_a_correction_nothing_changes_and_everything_is_open(none):
    s = np.array([0.05, 0.1])
    np.testing.assert_array_equal(change(none, s), np.zeros(4))
    assert open_share(none, s) == 1.0


@pytest.mark.parametrize("size", [0.001, 0.01, 0.3])
def test_at_its_own_condition_one_correction_counts_for_all_but_its_noise(none, size):
    """C / (C + noise C), whatever C is, and so large or small a correction."""
    s, y = np.array([0.05, 0.1]), size * np.array([1.0, -1.0, 0.5, 0.0])
    corrected = correct(none, s, y)
    np.testing.assert_allclose(change(corrected, s), y / (1.0 + OPTIONS.noise), rtol=1e-9)
    assert open_share(corrected, s) == pytest.approx(OPTIONS.noise / (1.0 + OPTIONS.noise), rel=1e-6)


def test_a_correction_within_what_was_open_is_no_surprise(none):
    s = np.array([0.05, 0.1])
    assert correct(none, s, 0.001 * np.ones(4)).surprise == 0.0
    large = correct(none, s, 0.5 * np.ones(4))
    assert large.surprise == pytest.approx(1.0 - large.openness[0, 0])


def test_the_newest_correction_of_a_condition_wins(none):
    s = np.array([0.05, 0.1])
    corrected = none
    for y in (0.3, -0.2, 0.1):
        corrected = correct(corrected, s, y * np.ones(4))
    np.testing.assert_allclose(change(corrected, s), 0.1, atol=0.01)


def test_corrections_apart_are_all_kept(none):
    places = [np.array([x, 0.0]) for x in (-0.8, 0.0, 0.8)]
    corrected = none
    for s, y in zip(places, (0.3, -0.2, 0.1), strict=True):
        corrected = correct(corrected, s, y * np.ones(4))
    for s, y in zip(places, (0.3, -0.2, 0.1), strict=True):
        np.testing.assert_allclose(change(corrected, s), y, atol=0.02)


def test_taking_one_back_is_as_if_it_had_not_been(none, rng):
    places, s = rng.uniform(-0.3, 0.3, size=(3, 2)), np.array([0.1, -0.1])
    two = correct(correct(none, places[0], 0.2 * np.ones(4)), places[1], -0.1 * np.ones(4))
    three = correct(two, places[2], 0.4 * np.ones(4))
    np.testing.assert_allclose(change(three.without(-1), s), change(two, s), atol=1e-12)
    np.testing.assert_allclose(
        change(three.without(0), s),
        change(correct(correct(none, places[1], -0.1 * np.ones(4)), places[2], 0.4 * np.ones(4)), s),
        atol=1e-12,
    )


def test_the_most_outdated_is_forgotten_first(none):
    kept = Corrections.none(none.regression, CorrectionOptions(most=2))
    elsewhere, here = np.array([1.0, 0.0]), np.array([0.0, 0.0])
    for s, y in ((elsewhere, 0.1), (here, 0.2), (here, 0.3)):
        kept = correct(kept, s, y * np.ones(4))
    assert len(kept) == 2
    np.testing.assert_allclose(change(kept, elsewhere), 0.1, atol=0.01)
    np.testing.assert_allclose(change(kept, here), 0.3, atol=0.01)


@pytest.fixture
def undecided(rng):
    """Three points in the plane determine a trend and leave nothing over to judge it by."""
    slope, conditions = rng.normal(size=(2, 4)), np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    regression = Regression(conditions, conditions @ slope, np.eye(4), 1.0, RegressionOptions())
    return Corrections.none(regression, OPTIONS), slope


def told(corrections, s, x):
    return corrections.added(corrections.regression.at(s), x).tested()


def test_corrections_that_agree_with_an_undecided_trend_make_it_believed_and_keep_what_they_said(undecided):
    none, slope = undecided
    s = np.array([-1.0, 0.5])
    believed = told(none, s, s @ slope)
    assert believed.regression.shrinkage < 1e-9 < none.regression.shrinkage
    np.testing.assert_allclose(believed.vectors, [s @ slope], atol=1e-12)
    np.testing.assert_allclose(change(believed, s), np.zeros(4), atol=1e-9)


def test_a_trend_is_doubted_again_when_what_spoke_for_it_is_taken_back(undecided):
    none, slope = undecided
    s = np.array([-1.0, 0.5])
    again = told(none, s, s @ slope).without(-1).tested()
    assert again.regression.shrinkage == none.regression.shrinkage


@pytest.mark.parametrize(("agreeing", "doubted"), [(4, True), (5, False)])
def test_the_first_five_corrections_test_a_trend(undecided, rng, agreeing, doubted):
    """Later ones tell of a world that has changed since."""
    corrections, slope = undecided
    for s in rng.uniform(-1.0, 1.0, size=(agreeing, 2)):
        corrections = told(corrections, s, s @ slope)
    s = np.array([0.7, -0.6])
    corrections = told(corrections, s, s @ slope + 5.0)
    assert (corrections.regression.shrinkage > 1e-3) == doubted


@pytest.mark.parametrize("distance", [0.1, 0.5, 2.0])
def test_a_great_surprise_fades_as_the_matern_kernel_of_its_reach(none, distance):
    """Beside it, what the demonstrations left open is nothing."""
    s, y = np.array([0.05, 0.1]), 1e6 * np.array([1.0, -1.0, 0.5, 0.0])
    r = np.sqrt(3.0) * distance / (OPTIONS.reach * none.regression.extent)
    expected = y * (1.0 + r) * np.exp(-r) / (1.0 + OPTIONS.noise)
    away = s + distance * np.array([0.6, 0.8])
    np.testing.assert_allclose(change(correct(none, s, y), away), expected, rtol=1e-6)


def test_demonstrations_that_can_judge_their_trend_are_left_as_they_are(none):
    corrected = correct(none, np.array([0.05, 0.1]), np.ones(4))
    assert none.regression.determined
    assert corrected.tested() is corrected


@pytest.mark.parametrize(("extent", "slope_std"), [(0.05, 1.0), (0.5, 0.1), (0.5, 1.0), (40.0, 1.0)])
def test_the_slope_that_demonstrations_leave_open_is_that_of_a_bayesian_line(extent, slope_std, rng):
    """Prior slope_std, and at each condition a value known to mean_std of the extent."""
    options = CorrectionOptions(slope_std=slope_std)
    conditions = extent * rng.normal(size=(7, 2))
    regression = Regression(conditions, rng.normal(size=(7, 4)), np.eye(4), extent, RegressionOptions())
    deviations = conditions - conditions.mean(axis=0)
    precision = np.eye(2) / slope_std**2 + deviations.T @ deviations / (options.mean_std * extent) ** 2
    np.testing.assert_allclose(
        Corrections.none(regression, options).slope_covariance, np.linalg.inv(precision), rtol=1e-9, atol=1e-12
    )
