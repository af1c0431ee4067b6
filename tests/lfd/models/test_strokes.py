"""What a gripper does, as numbers that can be averaged."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.models.strokes import SHARES, STROKES, bounds_of, opening_of, strokes_of

PHASES = np.linspace(0.0, 1.0, 101)
OPEN = 0.08


def step(at, before=OPEN, after=0.0):
    return np.where(at > PHASES, before, after)


def back(strokes, phases=PHASES):
    return opening_of(strokes, phases, 0.0, OPEN)


@given(st.lists(st.sampled_from([0.0, 0.02, 0.05, OPEN]), min_size=1, max_size=4), st.integers(0, 999))
def test_steps_come_back_when_they_were_and_what_is_steady_steady(levels, seed):
    """Where several close after each other, each by whole shares of all that closes: to within half a share."""
    at = np.sort(np.random.default_rng(seed).choice(np.arange(5, 95), len(levels) - 1, replace=False))
    opening = np.array(levels)[np.searchsorted(at, np.arange(101), side="right")]
    np.testing.assert_allclose(back(strokes_of(opening, PHASES)), opening, atol=3 * OPEN / SHARES)
    if len(levels) < 3:
        np.testing.assert_allclose(back(strokes_of(opening, PHASES)), opening, atol=1e-12)


def test_a_ramp_comes_back_to_half_a_share():
    ramp = np.interp(PHASES, [0.0, 0.5, 0.7, 1.0], [OPEN, OPEN, 0.01, 0.01])
    np.testing.assert_allclose(back(strokes_of(ramp, PHASES)), ramp, atol=0.5 * 0.07 / SHARES + 1e-12)


@given(st.floats(0.2, 0.8), st.floats(0.2, 0.8), st.floats(0.0, 1.0))
def test_between_two_that_close_lies_one_that_closes_whole_between_their_moments(one, other, share):
    mean = (1.0 - share) * strokes_of(step(one), PHASES) + share * strokes_of(step(other), PHASES)
    opening = back(mean)
    between = (opening > 1e-9) & (opening < OPEN - 1e-9)
    assert np.count_nonzero(between) <= 2
    assert PHASES[np.argmax(opening < OPEN / 2)] == pytest.approx((1.0 - share) * one + share * other, abs=0.02)


@given(st.integers(0, 999))
def test_no_numbers_lead_beyond_what_was_shown(seed):
    numbers = np.random.default_rng(seed).normal(scale=3.0, size=STROKES)
    opening = opening_of(numbers, PHASES, 0.01, 0.06)
    assert opening.min() >= 0.01
    assert opening.max() <= 0.06


def test_what_trembles_by_less_than_two_millimetres_is_steady(rng):
    noisy = np.abs(step(0.6, after=0.01) + rng.uniform(-0.0009, 0.0009, 101))
    opening = back(strokes_of(noisy, PHASES))
    assert np.ptp(opening[:59]) < 0.002
    assert np.ptp(opening[61:]) < 0.002
    np.testing.assert_allclose(opening[[0, -1]], [OPEN, 0.01], atol=0.001)


def test_what_is_moved_beyond_the_end_still_happens_at_the_end():
    late = strokes_of(step(0.5), PHASES)
    late[3:] += 2.0
    opening = back(late)
    assert opening[-1] == 0.0
    assert opening[-2] == OPEN


def test_the_bounds_are_those_of_what_was_shown():
    several = np.array([strokes_of(step(0.5, 0.05, 0.02), PHASES), strokes_of(step(0.3, 0.03, 0.07), PHASES)])
    assert bounds_of(several) == pytest.approx((0.02, 0.07))
