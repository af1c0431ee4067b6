"""Effect sizes: published answers, closed forms, and how often their intervals hold what is true."""

import numpy as np
import pytest
from scipy import stats

from services.study.analysis.effects import cliffs_delta, rank_biserial, shift_between, shift_within
from tests.services.study.analysis.test_ranks import EARLY, FIRST, SECOND, TERM


def test_the_shift_and_interval_of_the_depression_scales():
    # R's wilcox.test(..., conf.int = TRUE): pseudomedian -0.46, 95 % interval -0.786 to -0.010.
    found = shift_within(np.subtract(SECOND, FIRST), 0.95)
    assert (found.value, found.low, found.high) == pytest.approx((-0.46, -0.786, -0.010))


def test_the_shift_and_interval_of_the_membranes():
    # R: difference in location 0.305, 95 % interval -0.15 to 0.76.
    found = shift_between(TERM, EARLY, 0.95)
    assert (found.value, found.low, found.high) == pytest.approx((0.305, -0.15, 0.76))


def test_five_pairs_bound_no_shift():
    found = shift_within([1.0, 2.0, 3.0, 4.0, 5.0], 0.95)
    assert (found.value, found.low, found.high) == (3.0, None, None)


def test_rank_biserial_in_closed_form():
    # Ranks 1 to 4, the first one negative: (9 - 1) / 10.
    assert rank_biserial([-1.0, 2.0, 3.0, 4.0], 0.95, 0).value == pytest.approx(0.8)


def test_where_all_have_one_sign_the_bootstrap_says_nothing():
    found = rank_biserial([1.0, 2.0, 3.0], 0.95, 0)
    assert (found.value, found.low, found.high) == (1.0, None, None)


def test_nobody_differs_and_there_is_no_effect():
    assert rank_biserial([0.0, 0.0], 0.95, 0).value is None


def test_cliff_s_delta_is_what_the_rank_sum_says():
    u = stats.mannwhitneyu(TERM, EARLY).statistic
    assert cliffs_delta(TERM, EARLY, 0.95, 0).value == pytest.approx(2.0 * u / (len(TERM) * len(EARLY)) - 1.0)


@pytest.mark.parametrize("effect", [lambda d: rank_biserial(d, 0.95, 3), lambda d: shift_within(d, 0.95)])
def test_the_order_of_the_people_is_no_matter(effect):
    rng = np.random.default_rng(5)
    d = rng.normal(0.5, 1.0, 15)
    assert effect(d) == effect(rng.permutation(d))


@pytest.mark.parametrize("n", [12, 60])
def test_intervals_of_the_shift_hold_the_true_one_as_often_as_they_say(n):
    rng = np.random.default_rng(6)
    held = [(e.low <= 1.0 <= e.high) for e in (shift_within(rng.normal(1.0, 2.0, n), 0.95) for _ in range(600))]
    assert 0.93 <= np.mean(held) <= 0.98
