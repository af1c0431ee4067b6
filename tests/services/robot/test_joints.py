"""The joints of every robot that ships keep their limits, and the arm its way, where a motion asks for too much."""

from functools import cache

import numpy as np
import pytest

from services.robot.backends.backend import NativeLimits
from services.robot.joints import BEHIND, Joints, combined
from services.robot.kinematics import Kinematics
from sim.pose import Pose
from sim.robots.catalogue import NAMES, robot
from sim.robots.description import prepare

pytestmark = pytest.mark.sim
EACH = pytest.mark.parametrize("name", NAMES)
PERIOD = 0.01  # [s]
SCALE = 0.5  # of the speeds
SLACK = 1.0 + 1e-6  # of differences of positions, which are rounded
JUMP = 0.2  # [m/s] with which a motion begins
UP = np.array([0.0, 0.0, 1.0])


@cache
def kinematics(name):
    arm = robot(name)
    return Kinematics(prepare(robot=arm).urdf, np.array(arm.home), arm)


def joints(name):
    arm = robot(name)
    home = np.array(arm.home)
    unlimited = np.full_like(home, np.inf)
    native = NativeLimits(-unlimited, unlimited, unlimited, unlimited, unlimited)
    dynamics = combined(kinematics(name), native, SCALE)
    return Joints(arm.joint_names, kinematics(name), dynamics, home, velocity_scale=SCALE, self_distance_stop=0.005)


def led(joints, arm, way, length, speed):
    """The commands, shape (n, m), while a motion from where the joints are goes a length straight on, then stands."""
    start = arm.forward(joints.q)
    commands, gone, further = [joints.q] * 3, 0.0, 100
    while further:
        gone = min(length, gone + joints.share * speed * PERIOD)
        further -= gone == length
        joints.follow(Pose(start.position + gone * way, start.orientation))
        commands.append(joints.q)
        assert len(commands) < 2000
    return np.array(commands)


def assert_within_limits(commands, arm):
    limits = (SCALE * arm.velocity_limit, arm.acceleration_limit, arm.jerk_limit)
    for order, most in enumerate(limits, start=1):
        assert np.all(np.abs(np.diff(commands, order, axis=0)) / PERIOD**order <= most * SLACK + 1e-8)


@EACH
def test_a_motion_that_begins_at_speed_is_followed_within_the_limits_and_on_its_way(name):
    arm, moved = kinematics(name), joints(name)
    start, way = arm.forward(moved.q), np.array([0.0, 0.6, 0.8])
    commands = led(moved, arm, way, 0.05, JUMP)
    assert_within_limits(commands, arm)
    passed = np.array([arm.forward(q).position for q in commands]) - start.position
    beside = passed - np.outer(passed @ way, way)
    assert np.max(np.linalg.norm(beside, axis=1)) < 2.0 * BEHIND
    assert np.linalg.norm(passed[-1] - 0.05 * way) < 2e-4


@EACH
def test_a_hold_comes_to_rest_within_the_limits(name):
    arm, moved = kinematics(name), joints(name)
    start = arm.forward(moved.q)
    commands = [moved.q] * 3
    for k in range(1, 40):
        moved.follow(Pose(start.position + 0.1 * PERIOD * k * UP, start.orientation))
        commands.append(moved.q)
    for k in range(60):
        moved.hold(moved.q, begins=k == 0)
        commands.append(moved.q)
    assert_within_limits(np.array(commands), arm)
    np.testing.assert_array_equal(commands[-1], commands[-10])


def test_a_blocked_arm_is_not_led_on_while_it_holds():
    moved = joints("ur5")
    measured = moved.q - 0.05
    moved.hold(measured, begins=True)
    np.testing.assert_array_equal(moved.q, measured)


def test_what_cannot_be_followed_is_named():
    arm, moved = kinematics("tiago"), joints("tiago")
    start = arm.forward(moved.q)
    said = set()
    for k in range(1, 30):
        said |= set(moved.follow(Pose(start.position + 0.6 * PERIOD * k * UP, start.orientation)))
    assert any(word.startswith("acceleration ") for word in said)
    assert moved.share < 1.0
