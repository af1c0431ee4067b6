import numpy as np
import pytest

from lfd.exceptions import OutOfRange
from lfd.models.adaptive.moments import Moments
from lfd.models.adaptive.trend import TrendOptions, directions, limited, reach_variance, slopes, slopes_by_coordinate

OPTIONS = TrendOptions()


@pytest.fixture
def data(rng):
    return rng.normal(size=(9, 3)) @ np.diag([1.0, 0.7, 0.3]) + 1.0, rng.normal(size=(9, 4))


def test_the_first_trend_is_the_least_squares_line_and_the_last_is_none(data):
    S, X = data
    B = slopes(Moments.of(S, X), OPTIONS)
    line = np.linalg.lstsq(np.column_stack([S, np.ones(9)]), X, rcond=None)[0][:3]
    np.testing.assert_allclose(B[0], line, atol=1e-10)
    np.testing.assert_array_equal(B[-1], 0.0)


@pytest.mark.parametrize("shrinkage", [0.15, 1.0, 7.0])
def test_a_trend_is_the_ridge_regression_of_a_third_of_the_scatter_in_each_direction_that_counts(data, shrinkage):
    S, X = data
    options = TrendOptions(shrinkages=(0.0, shrinkage, np.inf), marker_noise=0.2)
    away = S - S.mean(axis=0)
    scatter = away.T @ away
    # As many directions as the conditions spread in: the participation ratio of the scatter.
    spread_in = np.trace(scatter) ** 2 / np.trace(scatter @ scatter)
    ridge = shrinkage * (np.trace(scatter) / (3.0 * spread_in) + 9 * 0.2**2)
    expected = np.linalg.solve(scatter + ridge * np.eye(3), away.T @ X)
    np.testing.assert_allclose(slopes(Moments.of(S, X), options)[1], expected, atol=1e-12)


def test_by_coordinates_each_entry_has_the_trend_of_the_dimensions_that_it_depends_on(data):
    """The first entry depends on all three, the second on one, the third on none, the fourth on two."""
    S, X = data
    depends = np.array([[1, 0, 0, 1], [1, 1, 0, 0], [1, 0, 0, 1]], dtype=bool)
    B = slopes_by_coordinate(Moments.of(S, X), depends, OPTIONS)
    for column, of_column in enumerate(depends.T):
        dimensions = np.flatnonzero(of_column)
        if len(dimensions):
            alone = slopes(Moments.of(S[:, dimensions], X[:, [column]]), OPTIONS)[..., 0]
            np.testing.assert_allclose(B[:, dimensions, column], alone, atol=1e-12)
        np.testing.assert_array_equal(B[:, ~of_column, column], 0.0)


def test_directions_in_which_conditions_hardly_differ_teach_no_trend(rng):
    S = np.column_stack([rng.normal(size=50), 0.9 * OPTIONS.least * rng.choice([-1.0, 1.0], size=50)])
    S -= S.mean(axis=0)
    S[:, 1] -= S[:, 0] * (S[:, 0] @ S[:, 1]) / (S[:, 0] @ S[:, 0])
    moments = Moments.of(S, rng.normal(size=(50, 2)))
    axes, scatters, differs = directions(moments, OPTIONS)
    assert differs.tolist() == [False, True]
    assert scatters[1] == pytest.approx(S[:, 0] @ S[:, 0])
    np.testing.assert_allclose(np.abs(axes[:, 1]), [1.0, 0.0], atol=1e-9)
    np.testing.assert_allclose(slopes(moments, OPTIONS)[0][1], 0.0, atol=1e-9)
    assert directions(moments, TrendOptions(least=0.8 * OPTIONS.least))[2].all()


def test_many_sets_at_once_are_as_one_by_one(rng):
    S, X = rng.normal(size=(9, 3)), rng.normal(size=(9, 4))
    owner = np.repeat(np.arange(3), 3)
    B, variance = (f(Moments.without_each(S, X, owner), OPTIONS) for f in (slopes, reach_variance))
    depends = np.array([[1, 0, 0, 1], [0, 1, 0, 1], [0, 1, 1, 0]], dtype=bool)
    C = slopes_by_coordinate(Moments.without_each(S, X, owner), depends, OPTIONS)
    for g in range(3):
        alone = Moments.of(S[owner != g], X[owner != g])
        np.testing.assert_allclose(B[g], slopes(alone, OPTIONS), atol=1e-10)
        np.testing.assert_allclose(C[g], slopes_by_coordinate(alone, depends, OPTIONS), atol=1e-10)
        np.testing.assert_allclose(variance[g], reach_variance(alone, OPTIONS), rtol=1e-9)
    away, radius = rng.normal(size=(6, 3)), rng.uniform(0.2, 1.0, size=6)
    one_by_one = [limited(away[[i]], radius[[i]], OPTIONS)[0] for i in range(6)]
    np.testing.assert_allclose(limited(away, radius, OPTIONS), one_by_one)


def test_where_no_condition_differs_there_is_no_trend(rng):
    moments = Moments.of(np.zeros((4, 2)), rng.normal(size=(4, 3)))
    np.testing.assert_array_equal(slopes(moments, OPTIONS), 0.0)


def test_a_slope_is_the_less_known_the_less_its_direction_was_seen(data):
    S, X = data
    moments = Moments.of(S, X)
    expected = np.linalg.inv(moments.scatter + 9 * OPTIONS.least**2 * np.eye(3))
    np.testing.assert_allclose(reach_variance(moments, OPTIONS), expected, atol=1e-12)


def test_within_the_conditions_seen_a_trend_is_followed_whole(rng):
    away = rng.normal(size=(20, 3))
    away *= (2.0 * rng.uniform(size=20) / np.linalg.norm(away, axis=1))[:, None]
    np.testing.assert_allclose(limited(away, np.array([2.0]), OPTIONS), away, rtol=1e-12)
    np.testing.assert_array_equal(limited(np.zeros((1, 3)), np.array([2.0]), OPTIONS), 0.0)


def test_beyond_them_it_ends_softly_within_a_fraction_of_their_radius():
    distances = np.linspace(0.0, 40.0, 400)
    followed = limited(distances[:, None] * [[0.6, 0.8]], np.array([2.0]), TrendOptions(softness=0.25))
    np.testing.assert_allclose(followed[:, 0] * 0.8, followed[:, 1] * 0.6, atol=1e-12)
    lengths = np.linalg.norm(followed, axis=1)
    slopes_along = np.diff(lengths) / np.diff(distances)
    assert (np.diff(slopes_along) < 1e-9).all()
    assert slopes_along.min() > -1e-9
    assert lengths[-1] == pytest.approx(2.0 + 0.25 * 2.0)
    one_beyond = limited(np.array([[2.5]]), np.array([2.0]), TrendOptions(softness=0.25))[0, 0]
    assert one_beyond == pytest.approx(2.0 + 0.5 * (1.0 - np.exp(-1.0)))


def test_a_single_condition_leads_nowhere():
    np.testing.assert_allclose(limited(np.array([[1.0, 2.0]]), np.zeros(1), OPTIONS), 0.0, atol=1e-250)


@pytest.mark.parametrize(
    "shrinkages",
    [
        (-0.1, np.inf),
        (0.0, np.nan, np.inf),
        (0.0, 0.5),
        (0.1, np.inf),
        (0.0, 2.0, 1.0, np.inf),
        (np.inf,),
        (0.0, np.nan),
    ],
)
def test_shrinkages_that_do_not_ascend_from_none_to_all_are_refused(shrinkages):
    with pytest.raises(OutOfRange, match="shrinkages"):
        TrendOptions(shrinkages=shrinkages)
