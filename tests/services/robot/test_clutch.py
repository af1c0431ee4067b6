"""A hand that takes the master up moves the robot by what it does from then on, and nothing jumps."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from services.robot.clutch import FADE, FADE_TURN, NEUTRAL, NEUTRAL_TURN, Clutch
from services.robot.correction import UNCORRECTED, Correction

PERIOD = 0.01
vectors = st.tuples(*[st.floats(-0.2, 0.2)] * 3).map(np.array)


def along(offset, turn=0.0):
    return Correction(np.array([offset, 0.0, 0.0]), np.array([0.0, turn, 0.0]))


def step(clutch, asked, applied=UNCORRECTED):
    return clutch.correction(asked, asked, applied)


def taken_up():
    """A clutch of a hand that rested when the motion began."""
    clutch = Clutch(PERIOD)
    step(clutch, UNCORRECTED)
    return clutch


def test_a_hand_that_rested_is_followed_exactly():
    clutch = taken_up()
    for offset in (0.001, 0.05, 0.3, 0.0):
        wanted = step(clutch, along(offset, offset), along(0.02))
        np.testing.assert_array_equal(wanted.offset, [offset, 0.0, 0.0])
        np.testing.assert_array_equal(wanted.turn, [0.0, offset, 0.0])


@pytest.mark.parametrize("asked", [along(1.01 * NEUTRAL), along(0.0, 1.01 * NEUTRAL_TURN)])
def test_a_hand_that_was_never_neutral_does_not_count(asked):
    assert step(Clutch(PERIOD), asked) is UNCORRECTED


@pytest.mark.parametrize("asked", [along(1.01 * NEUTRAL), along(0.0, 1.01 * NEUTRAL_TURN)])
def test_a_key_that_was_held_on_the_ramp_does_not_act_at_its_end(asked):
    clutch = taken_up()
    clutch.rest()
    for _ in range(100):
        assert step(clutch, asked) is UNCORRECTED
    step(clutch, UNCORRECTED)
    np.testing.assert_array_equal(step(clutch, along(0.05)).offset, [0.05, 0.0, 0.0])


@pytest.mark.parametrize("asked", [along(NEUTRAL), along(0.0, NEUTRAL_TURN)])
def test_a_hand_that_trembles_on_the_ramp_counts_and_does_not_jump(asked):
    clutch = Clutch(PERIOD)
    wanted = step(clutch, asked)
    np.testing.assert_array_equal(wanted.offset, np.zeros(3))
    np.testing.assert_array_equal(wanted.turn, np.zeros(3))
    moved = step(clutch, Correction(2.0 * asked.offset, 2.0 * asked.turn))
    assert np.any(moved.offset) or np.any(moved.turn)


def test_after_a_ramp_a_hand_counts_that_agrees_with_what_is_applied():
    clutch = taken_up()
    clutch.rest()
    np.testing.assert_array_equal(step(clutch, along(0.2), along(0.1)).offset, along(0.1).offset)
    np.testing.assert_allclose(step(clutch, along(0.105), along(0.1)).offset[0], 0.1)
    np.testing.assert_allclose(step(clutch, along(0.155), along(0.1)).offset[0], 0.15, atol=FADE * PERIOD)


def test_after_a_ramp_a_hand_counts_that_was_neutral_wherever_the_robot_is():
    clutch = taken_up()
    clutch.rest()
    step(clutch, along(0.2), along(0.1))
    np.testing.assert_array_equal(step(clutch, UNCORRECTED, along(0.1)).offset, along(0.1).offset)
    np.testing.assert_allclose(step(clutch, along(0.05), along(0.1)).offset[0], 0.15, atol=FADE * PERIOD)


@given(vectors, vectors)
def test_a_hand_that_takes_the_master_up_again_starts_from_what_is_applied(asked, applied):
    clutch = taken_up()
    clutch.let_go()
    wanted = step(clutch, Correction(asked, asked), Correction(applied, applied))
    np.testing.assert_allclose(wanted.offset, applied, atol=1e-15)
    np.testing.assert_allclose(wanted.turn, applied, atol=1e-15)


@given(vectors, vectors)
def test_a_difference_fades_at_the_pace_of_an_unhurried_hand(asked, applied):
    clutch = taken_up()
    clutch.let_go()
    corrections = [step(clutch, Correction(asked, asked), Correction(applied, applied)) for _ in range(1500)]
    offsets = np.array([wanted.offset for wanted in corrections])
    turns = np.array([wanted.turn for wanted in corrections])
    assert np.max(np.linalg.norm(np.diff(offsets, axis=0), axis=1)) <= FADE * PERIOD * (1.0 + 1e-9)
    assert np.max(np.linalg.norm(np.diff(turns, axis=0), axis=1)) <= FADE_TURN * PERIOD * (1.0 + 1e-9)
    np.testing.assert_array_equal(offsets[-1], asked)
    np.testing.assert_array_equal(turns[-1], asked)


def test_a_hand_that_stays_on_the_master_keeps_no_difference():
    clutch = taken_up()
    np.testing.assert_array_equal(step(clutch, along(0.1), along(0.02)).offset, [0.1, 0.0, 0.0])


def test_what_the_robot_cannot_follow_does_not_keep_a_hand_from_counting():
    clutch = Clutch(PERIOD)
    sideways = along(0.3)
    wanted = clutch.correction(sideways, UNCORRECTED, UNCORRECTED)
    np.testing.assert_array_equal(wanted.offset, sideways.offset)
