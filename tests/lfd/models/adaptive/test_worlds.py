"""Noise or change: against all segmentations, and on worlds that did change."""

from itertools import combinations

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.adaptive.worlds import WorldOptions, Worlds, find_worlds

OPTIONS = WorldOptions()
VARIANCES = 2.0 ** np.arange(0.0, 5.5, 0.5)


def found(changes, groups=None, unit=1.0, options=OPTIONS):
    changes = np.asarray(changes, float).reshape(len(changes), -1)
    worlds = find_worlds((changes @ changes.T)[None], groups or [range(len(changes))], np.array([unit]), options)
    return Worlds(worlds.current[0], worlds.shared[0], worlds.noise[0])


def cost(x, begins, variance, unit=1.0, options=OPTIONS):
    """Twice the least negative log evidence of stretches that begin there: of the module's text, written anew."""
    n, total = len(x), 0.0
    for begin, end in zip(begins, [*begins[1:], n], strict=True):
        stretch = x[begin:end]
        scatter = np.sum((stretch - stretch.mean(axis=0)) ** 2)
        total += scatter / variance + (len(stretch) - 1) * np.log(variance)
        total += np.log(len(stretch)) + 2.0 * np.log(options.jump * unit)
    return total + (len(begins) - 1) * 2.0 * np.log(options.stays * n)


def best(groups, unit=1.0, options=OPTIONS):
    """By going through all of them: the last stretches' lengths, and the variance."""
    outcomes = []
    for variance in (options.noise * unit) ** 2 * VARIANCES:
        total = options.evidence * ((options.noise * unit) ** 2 / variance + np.log(variance))
        lasts = []
        for x in groups:
            ways = [(0, *later) for k in range(len(x)) for later in combinations(range(1, len(x)), k)]
            costs = [cost(x, begins, variance, unit, options) for begins in ways]
            total += min(costs)
            lasts.append(len(x) - ways[int(np.argmin(costs))][-1])
        outcomes.append((total, lasts, variance))
    return min(outcomes, key=lambda outcome: outcome[0])[1:]


@given(
    st.lists(st.integers(2, 6), min_size=1, max_size=3),
    st.integers(1, 3),
    st.sampled_from([0.003, 0.02, 0.06, 0.3]),
    st.sampled_from([0.5, 1.0, 3.0]),
    st.integers(0, 2**32 - 1),
)
def test_the_stretches_are_the_best_of_all(sizes, d, spread, unit, seed):
    rng = np.random.default_rng(seed)
    groups = [spread * rng.normal(size=(n, d)) + np.where(np.arange(n)[:, None] < n // 2, 0.2, 0.0) for n in sizes]
    indices = np.split(np.arange(sum(sizes)), np.cumsum(sizes)[:-1])
    worlds = found(np.concatenate(groups), [g.tolist() for g in indices], unit)
    lasts, variance = best(groups, unit)
    assert worlds.noise == pytest.approx(variance)
    for index, last in zip(indices, lasts, strict=True):
        assert worlds.current[index].tolist() == [False] * (len(index) - last) + [True] * last
        assert (worlds.shared[index] == last).all()


def test_the_evidence_is_that_of_a_gaussian_world_whose_mean_may_be_anywhere(rng):
    """The marginal likelihood, by the dense Gaussian density, of one world against two; the prior of a change apart."""
    options, variance = WorldOptions(jump=300.0), 0.04
    x = 0.2 * rng.normal(size=(5, 1))

    def density(part):
        covariance = variance * np.eye(len(part)) + options.jump**2
        return part[:, 0] @ np.linalg.inv(covariance) @ part[:, 0] + np.linalg.slogdet(covariance)[1]

    change = 2.0 * np.log(options.stays * 5)
    for begin in range(1, 5):
        exact = density(x[:begin]) + density(x[begin:]) - density(x)
        ours = cost(x, (0, begin), variance, options=options) - cost(x, (0,), variance, options=options) - change
        assert ours == pytest.approx(exact, abs=1e-4)


def test_the_corrections_of_other_conditions_are_told_apart_by_their_own_order():
    """Two conditions, taught in turn: each has its own worlds."""
    worlds = found([[0.2], [-0.3], [0.2], [0.3]], [[0, 2], [1, 3]])
    assert worlds.current.tolist() == [True, False, True, True]
    assert worlds.shared.tolist() == [2.0, 1.0, 2.0, 1.0]


def test_one_correction_a_condition_tells_nothing_of_noise():
    worlds = found([[0.2], [-0.2]], [[0], [1]], unit=2.0)
    assert worlds.noise == pytest.approx((2.0 * OPTIONS.noise) ** 2)
    assert worlds.current.all()
    assert (worlds.shared == 1.0).all()


@pytest.mark.parametrize("n", [2, 5, 12])
def test_a_change_clearly_larger_than_the_noise_is_followed_at_once(n, rng):
    noisy = 0.01 * rng.normal(size=(n, 3)) + [0.2, 0.0, 0.0]
    worlds = found([*noisy, [-0.2, 0.0, 0.0]])
    assert worlds.current.tolist() == [False] * n + [True]


@pytest.mark.parametrize("n", [3, 6, 12])
def test_corrections_of_an_unchanged_world_all_hold(n, rng):
    worlds = found(0.01 * rng.normal(size=(n, 3)) + [0.2, 0.0, 0.0])
    assert worlds.current.all()
    assert (worlds.shared == n).all()


def test_the_noise_is_learnt_from_all_conditions(rng):
    def learnt(spread):
        changes = spread / np.sqrt(3.0) * rng.normal(size=(24, 3))
        changes[:, 0] += np.repeat([0.2, -0.2, 0.1, 0.0], 6)
        return np.sqrt(found(changes, np.arange(24).reshape(4, 6).tolist()).noise)

    assert learnt(0.005) == pytest.approx(OPTIONS.noise)
    assert learnt(0.03) == pytest.approx(0.03, rel=0.3)


def test_the_unit_makes_no_difference(rng):
    changes = 0.03 * rng.normal(size=(7, 2))
    changes[4:] += 0.2
    one, thousand = found(changes), found(1e3 * changes, unit=1e3)
    assert one.current.tolist() == thousand.current.tolist()
    assert thousand.noise == pytest.approx(1e6 * one.noise)
