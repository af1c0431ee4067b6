import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lfd.models.adaptive.regression import Regression, RegressionOptions


def regression(conditions, vectors, extent=1.0, options=None):
    vectors = np.asarray(vectors, float)
    return Regression(np.asarray(conditions, float), vectors, np.eye(vectors.shape[1]), extent, options or OPTIONS)


OPTIONS = RegressionOptions()


@given(st.integers(1, 4), st.integers(1, 5), st.integers(0, 2**32 - 1))
@settings(max_examples=30, deadline=None)
def test_a_linear_family_is_recovered_whatever_its_size(c, D, seed):
    rng = np.random.default_rng(seed)
    slope, offset = rng.normal(size=(c, D)), rng.normal(size=D)
    conditions = rng.normal(size=(c + 4, c))
    fitted = regression(conditions, conditions @ slope + offset)
    s = 10.0 * rng.normal(size=c)
    np.testing.assert_allclose(fitted.mean(s), s @ slope + offset, atol=1e-9)
    assert fitted.shrinkage < 1e-12


def test_what_does_not_depend_on_the_condition_is_shrunk_to_its_mean(rng):
    conditions, vectors = rng.normal(size=(30, 2)), rng.normal(size=(30, 4))
    fitted = regression(conditions, vectors)
    assert fitted.shrinkage == 1.0
    far = 5.0 * rng.normal(size=(20, 2))
    unshrunk = np.linalg.lstsq(np.column_stack([np.ones(30), conditions]), vectors, rcond=None)[0][1:]
    shrunk = np.linalg.norm(fitted.trend(far) - vectors.mean(axis=0))
    assert shrunk < 0.8 * np.linalg.norm((far - conditions.mean(axis=0)) @ unshrunk)


@pytest.mark.parametrize("conditions", [[[0.3]], [[0.3], [0.3]], [[0.3], [0.301], [0.299]]], ids=["1", "2", "3"])
def test_one_condition_teaches_no_trend(conditions):
    vectors = [[1.0], [2.0], [3.0]][: len(conditions)]
    fitted = regression(conditions, vectors)
    np.testing.assert_allclose(fitted.trend(np.array([5.0])), np.mean(vectors), atol=0.3)


def test_the_scale_of_everything_does_not_matter(rng):
    conditions, vectors, s = rng.normal(size=(6, 3)), rng.normal(size=(6, 4)), rng.normal(size=3)
    small = regression(conditions, vectors, extent=0.5)
    large = regression(1e3 * conditions, 1e3 * vectors, extent=500.0)
    np.testing.assert_allclose(large.mean(1e3 * s), 1e3 * small.mean(s), rtol=1e-9)
    assert large.uncertainty(large.at(1e3 * s)) == pytest.approx(small.uncertainty(small.at(s)))


def test_left_out_errors_are_those_of_a_regression_that_has_not_seen_the_condition(rng):
    """Against fitting anew without each condition, the shrinkage and the kernel's length given."""
    conditions = np.repeat(rng.normal(size=(5, 2)), [1, 2, 1, 3, 1], axis=0)
    vectors = rng.normal(size=(8, 3))
    whole = regression(conditions, vectors)
    errors, variances = whole.left_out
    for group in whole.groups:
        rest = np.setdiff1d(np.arange(8), group)
        anew = regression(conditions[rest], vectors[rest])
        anew.__dict__["_left_out_ratio"], anew.__dict__["length"] = whole.shrinkage, whole.length
        for i in group:
            np.testing.assert_allclose(errors[i], vectors[i] - anew.mean(conditions[i]), atol=1e-9)
            assert variances[i] == pytest.approx(anew.uncertainty(anew.at(conditions[i])), rel=1e-6)


def test_the_variance_of_one_demonstration_by_hand():
    """At its own condition: r + (1 - 1 / (1 + r)) (1 + 1); far from it the trend's reach is added."""
    fitted = regression([[0.2]], [[1.0]])
    r, s = OPTIONS.noise, np.array([0.2])
    assert fitted.uncertainty(fitted.at(s)) == pytest.approx(r + (1.0 - 1.0 / (1.0 + r)) * 2.0)
    away = 0.5
    far = np.array([0.2 + away])
    precision = OPTIONS.marker_noise**2 + OPTIONS.same**2
    expected = r + (1.0 - fitted.at(far).nearness[0] ** 2 / (1.0 + r)) * (2.0 + away**2 / precision)
    assert fitted.uncertainty(fitted.at(far)) == pytest.approx(expected)


def test_uncertainty_grows_away_from_the_conditions(rng):
    fitted = regression(rng.uniform(-0.1, 0.1, size=(6, 2)), rng.normal(size=(6, 3)))
    away = [np.array([x, 0.0]) for x in (0.1, 0.3, 0.6, 1.0, 3.0)]
    assert (np.diff([fitted.uncertainty(fitted.at(s)) for s in away]) > 0.0).all()


def test_a_trend_that_cannot_be_judged_is_believed_once_corrections_agree_with_it(rng):
    """Three points in the plane determine a trend and leave nothing over to judge it by."""
    slope, conditions = rng.normal(size=(2, 8)), np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    fitted = regression(conditions, conditions @ slope)
    assert (fitted.determined, fitted.shrinkage) == (False, OPTIONS.undetermined)
    elsewhere = np.array([[-1.0, 0.5]])
    right = elsewhere @ slope
    changed = right + np.array([3.0] * 4 + [0.0] * 4)
    for tested in (fitted.tested(elsewhere, right), fitted.tested(elsewhere, changed)):
        assert tested.shrinkage < 1e-12
        np.testing.assert_allclose(tested.mean(np.array([2.0, -3.0])), np.array([2.0, -3.0]) @ slope, atol=1e-9)


def test_a_trend_that_fails_a_test_is_shrunk_no_more_than_before(rng):
    conditions = np.array([[0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    fitted = regression(conditions, conditions @ rng.normal(size=(2, 8)))
    assert fitted.tested(np.array([[-1.0, 0.5]]), 9.0 * rng.normal(size=(1, 8))).shrinkage == OPTIONS.undetermined


def test_demonstrations_that_can_tell_do_not_listen_to_a_test(rng):
    fitted = regression(rng.normal(size=(9, 2)), rng.normal(size=(9, 4)))
    assert fitted.determined
    tested = fitted.tested(np.array([[0.3, 0.3]]), np.zeros((1, 4)))
    assert tested.shrinkage == fitted.shrinkage
