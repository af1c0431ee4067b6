"""The joints' command keeps every limit whatever is wanted, and follows exactly what can be followed."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from services.robot.limiter import Dynamics, Limiter, braking_speed

PERIOD = 0.01  # [s]
SLACK, ROUNDING = 1.0 + 1e-6, 2e-15  # third differences of positions are rounded

joints = st.tuples(st.floats(0.03, 3.0), st.floats(0.2, 20.0), st.floats(2.0, 8000.0))  # speed, acceleration, jerk
ways = st.lists(st.lists(st.floats(-1.2, 1.2), min_size=2, max_size=2), min_size=5, max_size=60)


def dynamics(*each):
    speed, acceleration, jerk = np.array(each).T
    return Dynamics(-np.ones(len(each)), np.ones(len(each)), speed, acceleration, jerk)


def followed(limits, start, wanted):
    """The command, shape (n, m), and its differences from rest at the start: speed, acceleration, jerk."""
    limiter, commands = Limiter(limits, PERIOD, start), [start, start, start]
    for one in wanted:
        limiter.follow(np.array(one))
        commands.append(limiter.q)
    differences = [np.diff(commands, k, axis=0) / PERIOD**k for k in (1, 2, 3)]
    return np.array(commands[3:]), differences


def assert_within(limits, commands, differences):
    for difference, most in zip(differences, (limits.speed, limits.acceleration, limits.jerk), strict=True):
        assert np.all(np.abs(difference) <= most * SLACK + ROUNDING / PERIOD**3)
    assert np.all((commands >= limits.lower) & (commands <= limits.upper))


@settings(max_examples=25, deadline=None)
@given(one=joints, other=joints, start=st.tuples(*[st.floats(-1.0, 1.0)] * 2), wanted=ways, held=st.integers(1, 40))
def test_whatever_is_wanted_every_limit_is_kept(one, other, start, wanted, held):
    """Each position is wanted for some periods, so that the joints come into their stride."""
    limits = dynamics(one, other)
    wanted = np.repeat(np.clip(wanted, -1.0, 1.0), held, axis=0)[:300]
    assert_within(limits, *followed(limits, np.array(start), wanted))


@settings(max_examples=20, deadline=None)
@given(limit=joints, span=st.floats(0.01, 1.0), share=st.floats(0.1, 0.9))
def test_what_the_limits_allow_is_followed_exactly(limit, span, share):
    """Forth and back by half a cosine, as fast as a share of the limits lets it; it begins with its greatest jerk."""
    limits = dynamics(limit)
    speed, acceleration, jerk = (share * float(most) for most in limit)
    # a step from rest into the greatest acceleration of a cosine has to be allowed by the jerk in one period
    rate = min(speed / span, np.sqrt(min(acceleration, jerk * PERIOD) / span), np.cbrt(jerk / span)) / 2.0
    time = PERIOD * np.arange(1, 400)
    wanted = (-0.5 * span + 0.5 * span * (1.0 - np.cos(rate * time)))[:, None]
    commands, _ = followed(limits, np.array([-0.5 * span]), wanted)
    np.testing.assert_array_equal(commands, wanted)


@settings(max_examples=10, deadline=None)
@given(limit=joints, start=st.floats(-0.9, 0.9), end=st.floats(-0.9, 0.9))
def test_a_place_is_reached_and_hardly_passed(limit, start, end):
    limits = dynamics(limit)
    speed, acceleration, jerk = limit
    periods = round((abs(end - start) / speed * 2.0 + 8.0 * speed / acceleration + 8.0 * acceleration / jerk + 6) * 100)
    commands, _ = followed(limits, np.array([start]), np.full((periods, 1), end))
    assert commands[-1, 0] == pytest.approx(end, abs=1e-6)
    passed = np.max(np.sign(end - start) * (commands[:, 0] - end))
    assert passed <= 0.02 * abs(end - start) + acceleration * PERIOD**2


def test_joints_that_are_behind_catch_up_while_the_motion_goes_on():
    limits = dynamics((1.0, 5.0, 50.0))
    wanted = 0.2 * PERIOD * np.arange(1, 200)[:, None]
    commands, _ = followed(limits, np.zeros(1), wanted)
    assert np.max(np.abs(commands - wanted)) < 0.011
    np.testing.assert_array_equal(commands[60:], wanted[60:])


@settings(max_examples=15, deadline=None)
@given(limit=joints, wanted=st.lists(st.floats(-1.0, 1.0), min_size=1, max_size=60))
def test_braking_comes_to_rest_within_the_limits(limit, wanted):
    limits = dynamics(limit)
    limiter, commands = Limiter(limits, PERIOD, np.zeros(1)), [np.zeros(1)] * 3
    for one in wanted:
        limiter.follow(np.array([one]))
        commands.append(limiter.q)
    speed, acceleration, jerk = limit
    takes = 2.0 * (speed / acceleration + acceleration / jerk + np.sqrt(speed / jerk))
    for _ in range(round(takes / PERIOD) + 5):
        limiter.brake()
        commands.append(limiter.q)
    assert limiter.q == pytest.approx(commands[-2], abs=1e-9)
    differences = [np.diff(commands, k, axis=0) / PERIOD**k for k in (1, 2, 3)]
    assert_within(limits, np.array(commands), differences)


@given(way=st.floats(1e-6, 3.0), acceleration=st.floats(0.1, 20.0), jerk=st.floats(1.0, 1000.0))
def test_the_braking_speed_is_lost_on_its_way(way, acceleration, jerk):
    """From it back to rest, in continuous time: the ramp of the deceleration, its top, and the ramp back."""
    v = float(braking_speed(np.array([way]), np.array([acceleration]), np.array([jerk]))[0])
    takes = 2.0 * np.sqrt(v / jerk) if v <= acceleration**2 / jerk else v / acceleration + acceleration / jerk
    assert 0.5 * v * takes == pytest.approx(way, rel=1e-6)
