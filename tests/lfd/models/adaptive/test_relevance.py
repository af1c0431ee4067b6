"""Dimensions that do not matter are switched off, and those that do are used."""

from dataclasses import replace

import numpy as np
import pytest

from lfd.models.adaptive.relevance import RelevanceOptions, relevant
from tests.lfd.models.adaptive.vectors import D, regression

OPTIONS = RelevanceOptions()


def family(rng, M, useful, useless, noise=0.0):
    """Conditions of which the first few dimensions matter, in a curved way; a function from them to vectors."""
    slopes, waves = rng.normal(size=(useful, D)), 0.2 * rng.normal(size=(useful, D))

    def vectors(S):
        return S[:, :useful] @ slopes + np.sin(4.0 * S[:, :useful]) @ waves

    S = rng.uniform(-0.35, 0.35, size=(M, useful + useless))
    return S, vectors(S) + noise * rng.normal(size=(M, D)), vectors


def fitted(S, X, lengths=False):
    plain = regression(S, X)
    return replace(plain, scale=replace(plain.scale, axes=np.where(lengths, np.arange(S.shape[1]), -1)))


def error(model, S, X):
    return np.sqrt(np.mean((model.at_each(S)[0] - X) ** 2))


def ratio(c, seed):
    """The error with dimensions that do not matter, over that without them; of twenty demonstrations, two matter."""
    rng = np.random.default_rng(seed)
    S, X, vectors = family(rng, 20, useful=2, useless=c - 2, noise=0.02)
    with_all, without = relevant(fitted(S, X), OPTIONS), relevant(fitted(S[:, :2], X), OPTIONS)
    places = rng.uniform(-0.35, 0.35, size=(100, c))
    return error(with_all, places, vectors(places)) / error(without, places[:, :2], vectors(places))


def bowl(rng, M, useless):
    """Conditions of which the first dimension matters, as its square, and the others lie anyhow."""
    along = np.linspace(-1.0, 1.0, M)
    S = np.column_stack([along, *(rng.permutation(along) for _ in range(useless))])
    return S, np.outer(along**2, rng.normal(size=D))


def test_dimensions_of_noise_are_switched_off(rng):
    plain = fitted(*bowl(rng, 12, useless=2))
    chosen = relevant(plain, OPTIONS)
    assert chosen.scale.relevance[0] > chosen.scale.relevance[1:].max()
    assert chosen.score < 0.5 * plain.score


@pytest.mark.sim
@pytest.mark.parametrize("c", [3, 10])
def test_dimensions_of_noise_cost_at_most_twice_the_error(c):
    assert np.median([ratio(c, seed) for seed in range(9)]) < 2.0


def test_a_dimension_that_matters_stays_on(rng):
    S, X, _ = family(rng, 10, useful=2, useless=0)
    assert (relevant(fitted(S, X), OPTIONS).scale.relevance > 0.0).all()


@pytest.mark.parametrize(("lengths", "fewest"), [(False, OPTIONS.conditions), (True, OPTIONS.conditions_of_lengths)])
def test_it_takes_some_conditions_to_judge(lengths, fewest, rng):
    S, X = bowl(rng, fewest, useless=1)
    few, enough = fitted(S[:-1], X[:-1], lengths), fitted(S, X, lengths)
    np.testing.assert_array_equal(relevant(few, OPTIONS).scale.relevance, 1.0)
    assert relevant(enough, OPTIONS).scale.relevance[1] < 1.0


def test_many_demonstrations_of_few_conditions_do_not_judge(rng):
    S, X, _ = family(rng, 7, useful=1, useless=2, noise=0.02)
    repeated = fitted(np.repeat(S, 5, axis=0), np.repeat(X, 5, axis=0))
    assert relevant(repeated, OPTIONS) is repeated


def test_a_change_is_made_only_for_a_gain(rng):
    S, X, _ = family(rng, 10, useful=1, useless=1, noise=0.02)
    plain = fitted(S, X)
    assert relevant(plain, replace(OPTIONS, gain=1.0)) is plain
    chosen = relevant(plain, OPTIONS)
    assert chosen.score < 0.95 * plain.score


def test_without_a_gain_no_change_is_made_though_none_is_asked_for(rng):
    """A dimension in which all are the same makes no difference, whatever its factor."""
    S = np.column_stack([np.linspace(-0.5, 0.5, OPTIONS.conditions), np.zeros(OPTIONS.conditions)])
    plain = fitted(S, np.sin(6.0 * S[:, :1]) @ rng.normal(size=(1, D)))
    chosen = relevant(plain, replace(OPTIONS, gain=0.0))
    assert chosen is not plain
    assert chosen.scale.relevance[1] == 1.0


@pytest.mark.parametrize("seed", range(4))
def test_what_predicts_exactly_is_left_as_it_is(seed):
    rng = np.random.default_rng(seed)
    S = rng.uniform(-0.35, 0.35, size=(10, 2))
    plain = fitted(S, S @ rng.normal(size=(2, D)))
    assert relevant(plain, OPTIONS) is plain


def test_what_was_chosen_is_not_bettered_by_choosing_again(rng):
    chosen = relevant(fitted(*bowl(rng, 12, useless=2)), OPTIONS)
    assert relevant(chosen, OPTIONS) is chosen


def test_of_many_demonstrations_some_are_looked_at_and_all_are_learnt_from(rng):
    S, X, _ = family(rng, 40, useful=1, useless=1, noise=0.02)
    chosen = relevant(fitted(S, X), replace(OPTIONS, most=9))
    assert len(chosen.conditions) == 40
    thinned = np.linspace(0, 39, 9).round().astype(int)
    looked_at = relevant(fitted(S[thinned], X[thinned]), OPTIONS)
    np.testing.assert_array_equal(chosen.scale.relevance, looked_at.scale.relevance)
    assert chosen.options == looked_at.options


def test_a_dimension_without_a_unit_is_left_alone(rng):
    S, X, _ = family(rng, 10, useful=1, useless=1)
    plain = fitted(S, X)
    plain = replace(plain, scale=replace(plain.scale, unit=np.array([1.0, np.inf])))
    assert relevant(plain, OPTIONS).scale.relevance[1] == 1.0


def test_the_process_is_fitted_where_that_predicts_better(rng):
    """A smooth family without noise: less noise is assumed of it."""
    S = np.linspace(-0.5, 0.5, 12)[:, None]
    X = np.sin(6.0 * S) @ rng.normal(size=(1, D))
    plain = fitted(S, X)
    chosen = relevant(plain, OPTIONS)
    assert chosen.options.noise < plain.options.noise
    assert chosen.score < 0.5 * plain.score


def test_few_conditions_do_not_judge_the_process_either(rng):
    S = np.linspace(-0.5, 0.5, OPTIONS.conditions - 1)[:, None]
    plain = fitted(S, np.sin(6.0 * S) @ rng.normal(size=(1, D)))
    assert relevant(plain, OPTIONS) is plain
    assert relevant(plain, replace(OPTIONS, conditions=3)) is not plain
