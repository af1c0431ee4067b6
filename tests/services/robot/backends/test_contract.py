"""What every backend promises, whatever moves behind it."""

import time

import numpy as np
import pytest

from services.robot.backends.backend import CONTROL_PERIOD, SILENCE_S, Jump, NotReady, State
from tests.services.robot.backends import rigs
from tests.services.robot.backends.franka_arm import FrankaArm

JOINT = 1  # that is led
STEP = 0.001  # [rad, or m] of it in a control period
STANDING = 0.02  # [rad/s, or m/s]


@pytest.fixture(scope="module")
def franka_arm():
    arm = FrankaArm()
    yield arm
    arm.close()


def franka(request):
    return rigs.Franka(request.getfixturevalue("franka_arm"))


@pytest.fixture(
    params=[
        pytest.param(lambda request: rigs.simulation(), id="simulation", marks=pytest.mark.sim),
        pytest.param(lambda request: rigs.particle(), id="particle"),
        pytest.param(lambda request: rigs.faked_ur(), id="ur, its library faked"),
        pytest.param(lambda request: rigs.faked_xarm(), id="xarm, its library faked"),
        pytest.param(franka, id="franka", marks=[pytest.mark.sim, pytest.mark.system]),
    ]
)
def bare(request):
    """A backend that is not connected yet."""
    rig = request.param(request)
    yield rig
    rig.close()


@pytest.fixture
def rig(bare):
    bare.backend.connect()
    return bare


def along(q, distance):
    """Where that joint is further on."""
    return q + distance * np.eye(len(q))[JOINT]


def lead(rig, periods):
    """Lead the joint on from where it stands; how long the calls took [s], and where it was led to."""
    q, taken = rig.backend.observe().q, []
    for _ in range(periods):
        q = along(q, STEP)
        begun = time.perf_counter()
        rig.backend.command(q, along(np.zeros_like(q), STEP / CONTROL_PERIOD), 0.0)
        taken.append(time.perf_counter() - begun)
        rig.period()
    return taken, q


def stands_after(rig, seconds):
    """Whether no joint moves any more."""
    rig.rest(seconds)
    before = rig.backend.observe()
    rig.rest(0.05)
    after = rig.backend.observe()
    return np.abs(after.qd).max() < STANDING and np.abs(after.q - before.q).max() < STANDING * 0.05


def test_it_names_its_joints_and_says_what_it_keeps_to(rig):
    backend, seen = rig.backend, rig.backend.observe()
    n, limits = len(backend.joint_names), backend.limits
    of_joints = [seen.q, seen.qd, limits.lower, limits.upper, limits.speed, limits.acceleration, limits.jerk]
    assert [one.shape for one in of_joints] == [(n,)] * 7
    assert np.all(limits.lower < limits.upper)
    assert np.all(np.array([limits.speed, limits.acceleration, limits.jerk]) > 0.0)
    assert limits.rate_hz >= 1.0 / CONTROL_PERIOD


def test_before_it_is_connected_and_after_it_is_closed_nothing_passes(bare):
    assert bare.backend.status().state is State.NOT_CONNECTED
    bare.backend.connect()
    q = bare.backend.observe().q
    bare.backend.close()
    assert bare.backend.status().state is State.NOT_CONNECTED
    with pytest.raises(NotReady):
        bare.backend.command(q, np.zeros_like(q), 0.0)


def test_it_holds_until_it_is_commanded_then_it_follows_and_says_so(rig):
    assert rig.backend.status().state is State.HOLDING
    before = rig.backend.observe().q
    _, commanded = lead(rig, 50)
    status = rig.backend.status()
    assert (status.state, status.reason) == (State.READY, "")
    assert status.age < 0.1
    measured = rig.backend.observe().q
    assert np.abs(measured - commanded).max() < 0.02
    assert measured[JOINT] - before[JOINT] > 0.03


def test_a_first_command_that_is_not_where_the_arm_stands_is_refused_and_moves_nothing(rig):
    before = rig.backend.observe().q
    with pytest.raises(Jump, match=rig.backend.joint_names[JOINT]):
        rig.backend.command(along(before, 0.1), np.zeros_like(before), 0.0)
    rig.rest(0.05)
    assert np.abs(rig.backend.observe().q - before).max() < 1e-3


def test_no_number_is_no_first_command(rig):
    q = rig.backend.observe().q
    with pytest.raises(Jump):
        rig.backend.command(q * np.nan, np.zeros_like(q), 0.0)


def test_commands_do_not_wait(rig):
    taken, _ = lead(rig, 50)
    assert np.median(taken) < 0.001


def test_without_a_command_for_fifty_milliseconds_it_holds_by_itself(rig):
    _, commanded = lead(rig, 30)
    rig.rest(SILENCE_S + CONTROL_PERIOD)
    assert rig.backend.status().state is State.HOLDING
    assert stands_after(rig, 0.1)
    with pytest.raises(Jump):
        rig.backend.command(along(commanded, 0.1), np.zeros_like(commanded), 0.0)
    lead(rig, 10)
    assert rig.backend.status().state is State.READY


def test_after_a_hold_it_stands_and_begins_where_it_is(rig):
    lead(rig, 30)
    rig.backend.hold()
    assert rig.backend.status().state is State.HOLDING
    assert stands_after(rig, 0.1)
    q = rig.backend.observe().q
    with pytest.raises(Jump):
        rig.backend.command(along(q, 0.1), np.zeros_like(q), 0.0)
    lead(rig, 10)


def test_what_is_stopped_stands_within_a_tenth_of_a_second_says_why_and_follows_nothing_until_it_recovers(rig):
    lead(rig, 30)
    rig.backend.stop("smoke")
    assert stands_after(rig, 0.1)
    status = rig.backend.status()
    assert (status.state, status.reason) == (State.HOLDING, "smoke")
    q = rig.backend.observe().q
    with pytest.raises(NotReady, match="smoke"):
        rig.backend.command(q, np.zeros_like(q), 0.0)
    rig.backend.recover()
    assert stands_after(rig, 0.0), "recovery moves nothing"
    lead(rig, 10)
    assert rig.backend.status().state is State.READY


def test_a_command_is_taken_as_it_was_given(rig):
    q = rig.backend.observe().q
    given, speed = q.copy(), np.zeros_like(q)
    rig.backend.command(given, speed, 0.0)
    given += 1.0
    speed += 1.0
    rig.period()
    assert np.abs(rig.backend.observe().q - q).max() < 1e-3
