import numpy as np
import pytest

from lfd.models.adaptive.left_out import leave_out
from lfd.models.adaptive.moments import Moments
from lfd.models.adaptive.trend import TrendOptions, directions, limited, reach_variance, slopes, slopes_by_coordinate

OPTIONS = TrendOptions(least=0.01)
NOISE, LENGTH = 0.2, 0.8
DEPENDS = np.array([[True, False, True], [False, True, True]])


def kernel(a, b, length=LENGTH):
    return np.exp(-0.5 * np.sum((a[:, None] - b) ** 2, axis=2) / length**2)


def left_out(z, Y, groups, depends=None):
    inverse = np.linalg.inv(kernel(z, z) + NOISE * np.eye(len(z)))
    return leave_out(z, Y, groups, inverse, noise=NOISE, options=OPTIONS, depends=depends)


@pytest.fixture
def data(rng):
    z = np.repeat(rng.normal(size=(5, 2)), [1, 2, 1, 3, 1], axis=0)
    z, Y = z - z.mean(axis=0), rng.normal(size=(8, 3))
    groups = [np.array(g) for g in ([0], [1, 2], [3], [4, 5, 6], [7])]
    return z, Y - Y.mean(axis=0), groups


def test_errors_are_those_of_a_regression_that_was_fitted_without_the_condition(data):
    z, Y, groups = data
    found = left_out(z, Y, groups)
    for group in groups:
        rest = np.setdiff1d(np.arange(8), group)
        moments = Moments.of(z[rest], Y[rest])
        radius = np.linalg.norm(z[rest] - moments.s_mean, axis=1).max(keepdims=True)
        nearness = kernel(z[group], z[rest]) @ np.linalg.inv(kernel(z[rest], z[rest]) + NOISE * np.eye(len(rest)))
        for k, B in enumerate([*slopes(moments, OPTIONS), slopes(moments, OPTIONS)[0]]):
            away = z[group] - moments.s_mean
            followed = limited(away, radius, OPTIONS) if k < 5 else away
            departures = Y[rest] - moments.mean - (z[rest] - moments.s_mean) @ B
            predicted = moments.mean + followed @ B + nearness @ departures
            np.testing.assert_allclose(found.errors[k, group], Y[group] - predicted, atol=1e-9)


def test_so_are_those_of_trends_by_coordinates_which_stand_alone(data):
    z, Y, groups = data
    found, without = left_out(z, Y, groups, DEPENDS), left_out(z, Y, groups)
    np.testing.assert_array_equal(found.errors[:6], without.errors)
    for group in groups:
        rest = np.setdiff1d(np.arange(8), group)
        moments = Moments.of(z[rest], Y[rest])
        radius = np.linalg.norm(z[rest] - moments.s_mean, axis=1).max(keepdims=True)
        followed = limited(z[group] - moments.s_mean, radius, OPTIONS)
        predicted = moments.mean + followed @ slopes_by_coordinate(moments, DEPENDS, OPTIONS)
        np.testing.assert_allclose(found.errors[6:, group], Y[group] - predicted, atol=1e-9)


def test_what_is_left_open_there_is_the_variance_of_the_process_of_the_others(data):
    z, Y, groups = data
    found = left_out(z, Y, groups)
    for group in groups:
        rest = np.setdiff1d(np.arange(8), group)
        moments = Moments.of(z[rest], Y[rest])
        k = kernel(z[group], z[rest])
        explained = np.diag(k @ np.linalg.inv(kernel(z[rest], z[rest]) + NOISE * np.eye(len(rest))) @ k.T)
        np.testing.assert_allclose(found.unexplained[group], 1.0 - explained, atol=1e-9)
        away = z[group] - moments.s_mean
        leverage = 1.0 / len(rest) + np.diag(away @ reach_variance(moments, OPTIONS) @ away.T)
        np.testing.assert_allclose(found.leverage[group], leverage, rtol=1e-9)


def test_a_condition_without_which_a_direction_is_lost_tells_nothing():
    z = np.array([[-1.0, 0.0], [0.0, 0.0], [1.0, 0.0], [0.0, 1.0]])
    z = z - z.mean(axis=0)
    found = left_out(z, np.eye(4), [np.array([i]) for i in range(4)])
    assert found.telling.tolist() == [True, True, True, False]
    assert directions(Moments.of(z, np.eye(4)), OPTIONS)[2].all()


def test_beside_others_hardly_anything_is_left_open_and_never_less_than_nothing():
    z = np.linspace(-0.1, 0.1, 9)[:, None]
    inverse = np.linalg.inv(kernel(z, z, length=5.0) + 0.01 * np.eye(9))
    groups = [np.array([i]) for i in range(9)]
    found = leave_out(z, np.ones((9, 2)), groups, inverse, noise=0.01, options=OPTIONS)
    assert found.unexplained.max() < 0.01
    assert found.unexplained.min() >= 0.0
