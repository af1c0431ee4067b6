"""How far an arm is behind in time is told by its motion, whatever its speed; standing tells nothing."""

import numpy as np
import pytest

from services.robot.following import FEWEST, KEPT, LONGEST_S, Following

PERIOD_S = 0.01


def path(t):
    """A way that turns, with varying speed [m]."""
    return np.array([0.3 * np.sin(0.8 * t), 0.2 * np.cos(1.1 * t), 0.1 * t])


def followed(lag_s, periods=200, way=path, noise=0.0):
    """An arm that is always so far behind."""
    rng, following = np.random.default_rng(3), Following(PERIOD_S)
    for i in range(periods):
        t = i * PERIOD_S
        following.see(way(t), way(t - lag_s) + noise * rng.standard_normal(3))
    return following


@pytest.mark.parametrize("lag_s", [0.0, 0.02, 0.05, 0.1])
def test_the_lag_is_what_the_arm_is_behind_and_the_period_in_which_a_command_acts(lag_s):
    assert followed(lag_s).lag_s == pytest.approx(PERIOD_S + lag_s, rel=0.05)


def test_a_first_order_servo_is_its_time_constant_behind():
    constant_s, following, measured = 0.04, Following(PERIOD_S), path(0.0)
    for i in range(300):
        reference = path(i * PERIOD_S)
        measured = measured + (reference - measured) * (1.0 - np.exp(-PERIOD_S / constant_s))
        following.see(reference, measured)
    assert following.lag_s == pytest.approx(PERIOD_S + constant_s, abs=PERIOD_S)


def test_noise_of_a_sensor_does_not_move_it_far():
    assert followed(0.03, noise=2e-4).lag_s == pytest.approx(PERIOD_S + 0.03, abs=0.01)


def test_an_arm_that_stands_or_has_hardly_moved_tells_nothing():
    assert followed(0.03, way=lambda t: np.zeros(3)).lag_s is None
    assert followed(0.03, periods=FEWEST).lag_s is None
    assert followed(0.03, periods=FEWEST + 1).lag_s is not None


def test_after_a_rest_it_is_learnt_anew():
    following = followed(0.1)
    following.rest()
    assert following.lag_s is None
    for i in range(KEPT):
        following.see(path(i * PERIOD_S), path(i * PERIOD_S))
    assert following.lag_s == pytest.approx(PERIOD_S)


def test_an_arm_that_is_blocked_is_ever_farther_behind():
    following, before = Following(PERIOD_S), 0.0
    for i in range(KEPT):
        following.see(np.array([0.1 * i * PERIOD_S, 0.0, 0.0]), np.zeros(3))
        if i >= 2 * FEWEST and i % FEWEST == 0:
            assert following.lag_s > before
            before = following.lag_s


def test_an_arm_that_something_holds_tells_no_delay():
    following = Following(PERIOD_S)
    for i in range(round(LONGEST_S / PERIOD_S) + KEPT):
        following.see(np.array([0.1 * i * PERIOD_S, 0.0, 0.0]), np.zeros(3))
    assert following.lag_s is None
