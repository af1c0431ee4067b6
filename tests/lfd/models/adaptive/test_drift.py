"""What corrections show together: it is followed as far as they bear it out, and no law of theirs is broken by it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.adaptive.correction import CorrectionOptions
from lfd.models.adaptive.drift import DriftOptions
from lfd.models.adaptive.kinds import POSITION
from tests.lfd.models.adaptive.vectors import KINDS, D, along, correct, corrections, effect, regression, sized

ONE = regression([[0.0, 0.0]], np.zeros((1, D)))  # a demonstration
NEVER = DriftOptions(doubt=1e300)
SQUARE = np.array([[-0.2, -0.2], [-0.2, 0.0], [-0.2, 0.2], [0.0, -0.2], [0.2, 0.0]])


def linear(rng, c=2, size=0.5):
    """Changes in proportion to the condition."""
    slopes = np.array([sum(sized(kind, size, rng) for kind in range(3)) for _ in range(c)])
    return lambda s: np.asarray(s) @ slopes


def told(changes, places, taught=ONE, noise=None, **options):
    held = corrections(taught, **options)
    for s in places:
        held = correct(held, s, changes(s) + (0.0 if noise is None else noise()))
    return held


def missed(held, changes, s):
    """Share of a change that is not predicted."""
    wanted = changes(s)
    sizes = KINDS.sizes(np.array([effect(held, s).change - wanted, wanted]))
    return np.sqrt(sizes[:, 0] / sizes[:, 1]).max()


@pytest.mark.parametrize("seed", range(5))
def test_after_four_corrections_on_a_linear_trend_the_next_needs_none_and_is_known(seed):
    """On the other side, which was seen in each number; without a drift a third of it and more is missed."""
    changes, next_one = linear(np.random.default_rng(seed)), [0.15, 0.1]
    corner = [[-0.2, -0.2], [-0.2, 0.2], [0.2, -0.1], [0.0, 0.2]]
    held = told(changes, corner)
    assert missed(held, changes, next_one) < 0.03
    assert effect(held, next_one).open_share < 0.05
    assert missed(told(changes, corner, drift=NEVER), changes, next_one) > 0.33


@pytest.mark.parametrize("seed", range(5))
def test_a_trend_that_changes_something_where_the_demonstrations_are_is_one_of_the_condition(seed):
    rng = np.random.default_rng(seed)
    slope, offset = linear(rng), sum(sized(kind, 0.2, rng) for kind in range(3))
    corner = [[-0.2, -0.2], [-0.2, 0.2], [0.2, -0.2], [0.2, 0.2], [0.0, 0.2]]
    held = told(lambda s: slope(s) + offset, corner)
    assert missed(held, lambda s: slope(s) + offset, [0.1, -0.05]) < 0.03


@given(st.integers(0, 2), st.integers(0, 2**32 - 1))
def test_up_to_two_corrections_show_no_trend(J, seed):
    rng = np.random.default_rng(seed)
    changes, places = linear(rng), rng.uniform(-0.3, 0.3, size=(J, 2))
    s = rng.uniform(-0.5, 0.5, size=2)
    with_it, without = (effect(told(changes, places, drift=d), s) for d in (DriftOptions(), NEVER))
    np.testing.assert_array_equal(with_it.change, without.change)
    assert with_it.open_share == without.open_share


def test_corrections_again_and_again_at_two_conditions_show_no_trend():
    changes = linear(np.random.default_rng(0))
    places = [[0.2, 0.0], [0.0, 0.2]] * 4
    s = [0.2, 0.2]
    with_it, without = (effect(told(changes, places, drift=d), s) for d in (DriftOptions(), NEVER))
    np.testing.assert_array_equal(with_it.change, without.change)


@pytest.mark.parametrize("J", [3, 5, 9])
@pytest.mark.parametrize("seed", range(5))
def test_where_what_departs_from_a_trend_is_as_large_as_the_changes_nothing_is_changed_by_it(J, seed):
    rng = np.random.default_rng(seed)
    places = rng.uniform(-0.3, 0.3, size=(J, 2))
    by_place = {tuple(s): sized(POSITION, 0.2, rng) for s in places}
    one, other = (told(lambda s: by_place[tuple(s)], places, drift=d) for d in (DriftOptions(), NEVER))
    for s in rng.uniform(-0.5, 0.5, size=(5, 2)):
        np.testing.assert_array_equal(effect(one, s).change, effect(other, s).change)


def test_the_more_corrections_scatter_about_a_trend_the_less_is_known_of_the_next():
    opens = []
    for scatter in (0.001, 0.01, 0.03, 0.1):
        rng = np.random.default_rng(3)
        held = told(linear(rng), SQUARE, noise=lambda s=scatter, r=rng: sized(POSITION, s, r))
        opens.append(effect(held, [0.15, 0.15]).open_share)
    assert (np.diff(opens) > 0.0).all()
    assert opens[0] < 0.05


def test_beyond_the_corrections_less_and_less_is_known():
    held = told(linear(np.random.default_rng(0)), SQUARE)
    opens = [effect(held, [x, 0.1]).open_share for x in (0.1, 0.3, 0.5, 1.0, 3.0)]
    assert (np.diff(opens) > 0.0).all()
    assert opens[-1] > 0.95


@pytest.mark.parametrize("c", [1, 2])
def test_what_grows_to_one_side_of_the_demonstration_is_never_its_opposite_on_the_other(c):
    """Lifted the more the further aside: beyond the demonstration it is not lowered."""
    one = regression(np.zeros((1, c)), np.zeros((1, D)))
    aside = np.eye(c)[0]
    held = told(lambda s: s[0] * sized(POSITION, 1.0), [x * aside for x in (0.1, 0.2, 0.3, 0.4)], one)
    assert along(effect(held, 0.25 * aside).change, POSITION) == pytest.approx(0.25, rel=0.02)
    for x in (-0.01, -0.1, -0.3, -1.0, -3.0):
        assert along(effect(held, x * aside).change, POSITION) > -1e-3 * 0.4


@given(st.integers(3, 7), st.booleans(), st.floats(0.0, 0.05), st.integers(0, 2**32 - 1))
def test_nowhere_is_more_changed_than_by_the_largest_correction_and_it_fades_as_the_nearest_does(J, bent, noise, seed):
    """Of trends that are exact, noisy, or of a part of the corrections only."""
    rng = np.random.default_rng(seed)
    conditions = rng.uniform(-0.1, 0.1, size=(int(rng.integers(1, 4)), 2))
    slope, offset = linear(rng), rng.choice([0.0, 0.2]) * sized(POSITION, 1.0, rng)
    held = told(
        lambda s: slope(s) * (1.0 + bent * s[0]) + offset,
        rng.uniform(-0.4, 0.4, size=(J, 2)),
        regression(conditions, rng.normal(size=(len(conditions), D))),
        noise=lambda: sized(POSITION, noise, rng),
    )
    most = KINDS.sizes(held.changes).max(axis=1)
    for s in [*rng.uniform(-0.6, 0.6, size=(6, 2)), *rng.uniform(-10.0, 10.0, size=(4, 2))]:
        nearest = min(np.linalg.norm(c.s - s) for c in held.held)
        r = np.sqrt(3.0) * nearest / np.array(CorrectionOptions().covariance.reach)
        size = KINDS.sizes(effect(held, s).change[None])[:, 0]
        assert (size <= most * ((1.0 + r) * np.exp(-r) * (1.0 + 1e-9)) ** 2 + 1e-12).all()


def test_a_world_that_changed_is_followed_at_the_first_correction_whatever_the_trend_was():
    rng = np.random.default_rng(0)
    held = told(linear(rng), SQUARE)
    changed = sum(sized(kind, 0.5, rng) for kind in range(3))
    assert missed(correct(held, SQUARE[2], changed), lambda _: changed, SQUARE[2]) < 0.04


def test_a_trend_is_borne_out_as_by_fitting_without_each_condition_in_turn():
    """In one direction: 1 - doubt q^((n - p) / 2), where p is the trace of the ridge regression's hat matrix."""
    rng, options = np.random.default_rng(1), DriftOptions()
    unit = sized(POSITION, 1.0)
    held = told(lambda s: (0.5 * s[0] - 0.3 * s[1] + 0.01 * rng.normal()) * unit, SQUARE)
    y, F = np.array([along(change, POSITION) for change in held.changes]), held._outside
    C, n = np.linalg.inv(held._solved[0].inverse[POSITION]), len(SQUARE)
    ridge = n * options.least**2 * np.eye(2)
    with_it, without = np.zeros(n), np.zeros(n)
    for j in range(n):
        rest = np.arange(n) != j
        with_it[j] = y[j] - F[j] @ np.linalg.solve(F[rest].T @ F[rest] + ridge, F[rest].T @ y[rest])
        without[j] = y[j] - C[j, rest] @ np.linalg.solve(C[np.ix_(rest, rest)], y[rest])
    p = np.trace(F @ np.linalg.solve(F.T @ F + ridge, F.T))
    trust = 1.0 - options.doubt * (with_it @ with_it / (without @ without)) ** (0.5 * (n - p))
    assert held._drift.of_outside
    assert held._drift.known == pytest.approx(trust * (1.0 - with_it @ with_it / (y @ y)), rel=1e-6)


def test_at_their_conditions_corrections_are_what_counts_as_without_a_trend():
    """However much they depart from it."""
    rng = np.random.default_rng(2)
    held = told(linear(rng), SQUARE, noise=lambda: sized(POSITION, 0.02, rng))
    assert held._drift is not None
    for s, change in zip(SQUARE, held.changes, strict=True):
        np.testing.assert_allclose(effect(held, s).change, change, atol=0.02 * np.abs(change).max())


def test_old_corrections_bear_out_nothing():
    changes = linear(np.random.default_rng(0))
    held = corrections(ONE, half_life_s=1.0)
    for i, s in enumerate(SQUARE):
        held = correct(held, s, changes(s), at_s=100.0 * i)
    assert held._drift is None
    assert told(changes, SQUARE)._drift is not None
