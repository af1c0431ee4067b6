"""Tests by ranks: published examples, SciPy by hand, every case counted out, and the laws that they obey."""

import itertools

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy import stats

from services.study.analysis.hypotheses import Direction
from services.study.analysis.ranks import holm, kruskal_wallis, mann_whitney, signed_rank

# Hollander and Wolfe, Nonparametric Statistical Methods (1973), pages 29 to 33: Hamilton's depression scale at the
# first and second visit of nine patients; the answers are R's documented ones, V = 40, p = 0.01953 (wilcox.test).
FIRST = (1.83, 0.50, 1.62, 2.48, 1.68, 1.88, 1.55, 3.06, 1.30)
SECOND = (0.878, 0.647, 0.598, 2.05, 1.06, 1.29, 1.06, 3.14, 1.29)
# Pages 69 to 71: permeability of membranes at term and at 12 to 26 weeks; W = 35, p = 0.1272.
TERM = (0.80, 0.83, 1.89, 1.04, 1.45, 1.38, 1.91, 1.64, 0.73, 1.46)
EARLY = (1.15, 0.88, 0.90, 0.74, 1.21)

ALTERNATIVES = {Direction.LESS: "less", Direction.GREATER: "greater", Direction.DIFFERENT: "two-sided"}

tied = st.lists(st.integers(-6, 6), min_size=1, max_size=9)


def test_the_depression_scales_of_hollander_and_wolfe():
    found = signed_rank(np.subtract(FIRST, SECOND), Direction.GREATER)
    assert (found.statistic, found.opposite, found.n, found.exact) == (40.0, 5.0, 9, True)
    assert found.p == pytest.approx(0.01953125, abs=1e-12)


def test_the_membranes_of_hollander_and_wolfe():
    found = mann_whitney(TERM, EARLY, Direction.GREATER)
    assert found.statistic == 35.0
    assert round(found.p, 4) == 0.1272


def test_wilcoxon_s_smallest_p_is_that_of_one_choice_of_signs():
    assert signed_rank(range(1, 13), Direction.GREATER).p == pytest.approx(2.0**-12)


@pytest.mark.parametrize("direction", list(Direction))
@pytest.mark.parametrize("n", [5, 18, 40])
def test_without_ties_the_signed_rank_test_is_scipy_s_exact_one(n, direction):
    d = np.random.default_rng(n).normal(0.3, 1.0, n)
    assert signed_rank(d, direction).p == pytest.approx(
        stats.wilcoxon(d, alternative=ALTERNATIVES[direction], method="exact").pvalue, rel=1e-9
    )


@pytest.mark.parametrize("direction", list(Direction))
def test_many_differences_are_approximated_as_scipy_does_with_its_correction_for_ties(direction):
    d = np.random.default_rng(1).integers(-9, 12, 108)
    found = signed_rank(d, direction)
    assert not found.exact
    expected = stats.wilcoxon(d[d != 0], alternative=ALTERNATIVES[direction], method="asymptotic", correction=False)
    assert found.p == pytest.approx(expected.pvalue, rel=1e-9)


@given(tied)
def test_with_ties_every_choice_of_signs_is_counted(d):
    found = signed_rank(d, Direction.LESS)
    kept = [one for one in d if one]
    ranks = stats.rankdata(np.abs(kept))
    sums = [
        sum(r for r, s in zip(ranks, signs, strict=True) if s) for signs in itertools.product((0, 1), repeat=len(kept))
    ]
    assert found.p == pytest.approx(np.mean([total <= found.statistic + 1e-9 for total in sums]))
    assert found.zeros == len(d) - len(kept)


@given(st.lists(st.integers(0, 4), min_size=1, max_size=5), st.lists(st.integers(0, 4), min_size=1, max_size=5))
def test_with_ties_every_choice_of_a_group_is_counted(x, y):
    found = mann_whitney(x, y, Direction.GREATER)
    ranks = stats.rankdata([*x, *y])
    sums = [sum(chosen) for chosen in itertools.combinations(ranks, len(x))]
    assert found.p == pytest.approx(np.mean([total >= sum(ranks[: len(x)]) - 1e-9 for total in sums]))


@pytest.mark.parametrize("direction", list(Direction))
def test_the_rank_sum_test_is_scipy_s(direction):
    rng = np.random.default_rng(3)
    x, y = rng.normal(0.0, 1.0, 7), rng.normal(0.4, 1.0, 11)
    expected = stats.mannwhitneyu(x, y, alternative=ALTERNATIVES[direction], method="exact")
    assert mann_whitney(x, y, direction).p == pytest.approx(expected.pvalue, rel=1e-9)
    a, b = rng.integers(0, 20, 60), rng.integers(2, 22, 70)
    large = stats.mannwhitneyu(a, b, alternative=ALTERNATIVES[direction], method="asymptotic", use_continuity=False)
    assert mann_whitney(a, b, direction).p == pytest.approx(large.pvalue, rel=1e-9)


@given(tied)
def test_swapping_the_sides_swaps_the_tails(d):
    there, back = signed_rank(d, Direction.LESS), signed_rank(np.negative(d), Direction.GREATER)
    assert there.p == pytest.approx(back.p)
    assert (there.statistic, there.opposite) == (back.opposite, back.statistic)


def test_what_rounding_has_added_makes_no_difference():
    plain = signed_rank([0.3, 0.3, -0.3, 0.0], Direction.GREATER)
    assert signed_rank([0.1 + 0.2, 0.3, -0.3, 0.1 + 0.2 - 0.3], Direction.GREATER) == plain


def test_nobody_differs_and_nothing_is_shown():
    assert signed_rank([0.0, 0.0], Direction.DIFFERENT).p == 1.0


def test_kruskal_and_wallis_statistic_is_scipy_s_and_its_p_near_the_approximation():
    rng = np.random.default_rng(4)
    groups = [rng.integers(0, 12, 15), rng.integers(1, 13, 12), rng.integers(2, 14, 14)]
    found, expected = kruskal_wallis(groups, rng), stats.kruskal(*groups)
    assert found.statistic == pytest.approx(expected.statistic)
    assert found.p == pytest.approx(expected.pvalue, abs=0.02)


def test_holm_s_own_steps():
    # Holm (1979), by hand: 4 x 0.01, then 3 x 0.015 is raised to what 4 x 0.0125 has reached, and so on.
    assert holm([0.01, 0.04, 0.03, 0.005]) == pytest.approx([0.03, 0.06, 0.06, 0.02])


@given(st.lists(st.floats(0.0, 1.0), min_size=1, max_size=8))
def test_holm_keeps_the_order_and_never_makes_smaller(p):
    adjusted = holm(p)
    assert all(one <= raised <= 1.0 for one, raised in zip(p, adjusted, strict=True))
    order = sorted(range(len(p)), key=p.__getitem__)
    assert all(adjusted[a] <= adjusted[b] for a, b in itertools.pairwise(order))
    assert min(adjusted) == pytest.approx(min(1.0, len(p) * min(p)))
