import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.rotations import exp_map
from services.process.config import LONGEST_SILENCE_S
from services.robot import safety
from services.robot.correction import Correction
from services.robot.execution import angle_between
from services.robot.safety import JointLimits, Watchdog
from sim.pose import Pose

IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
LIMITS = JointLimits(("lift", "elbow"), np.array([0.0, -1.0]), np.array([0.3, 1.0]), np.array([0.1, 1.0]))
PERIOD = 0.01


@pytest.mark.parametrize(
    ("holder", "silence", "expected"),
    [
        ("ann", 0.0, ""),
        ("ann", 0.2, ""),
        ("ann", 0.2001, "no operator was present for more than 200 ms"),
        ("ann", None, "no operator was present"),
        ("ann", math.nan, "no operator was present"),
        ("", None, "nobody holds the authority"),
        ("", 0.0, "nobody holds the authority"),
    ],
)
def test_no_motion_goes_on_without_an_operator(holder, silence, expected):
    reason = Watchdog(hold_after_s=0.1, presence_after_s=0.2).presence(holder, silence)
    assert expected in reason
    assert bool(reason) == bool(expected)


@pytest.mark.parametrize(
    ("silence", "engaged", "expected"),
    [
        (0.1, True, ""),
        (0.1, False, "no hand is at the operator's keys"),
        (0.1001, True, "not heard for more than 100 ms"),
        (math.nan, True, "not heard"),
        (None, False, "nothing was heard"),
    ],
)
def test_no_refinement_goes_on_without_a_hand(silence, engaged, expected):
    reason = Watchdog(hold_after_s=0.1, presence_after_s=0.2).hand(silence, engaged=engaged)
    assert expected in reason
    assert bool(reason) == bool(expected)


@pytest.mark.parametrize(("silence", "way", "late"), [(0.05, 0.2, False), (0.05, 0.2001, True), (0.0, 9.0, True)])
def test_no_refinement_goes_on_by_what_was_too_long_on_its_way(silence, way, late):
    reason = Watchdog(hold_after_s=0.1, presence_after_s=0.2).hand(silence, engaged=True, way_s=way)
    assert ("more than 250 ms late" in reason) is late


@pytest.mark.parametrize("setting", [LONGEST_SILENCE_S + 0.001, 10.0, math.inf, math.nan])
def test_no_setting_lets_a_robot_move_on_for_longer_than_the_bound(setting):
    watchdog = Watchdog(hold_after_s=setting, presence_after_s=setting)
    assert watchdog.presence("ann", LONGEST_SILENCE_S + 1e-6) != ""
    assert watchdog.hand(LONGEST_SILENCE_S + 1e-6, engaged=True) != ""
    assert watchdog.presence("ann", LONGEST_SILENCE_S) == ""


@given(st.tuples(*[st.floats(-2.0, 2.0)] * 2), st.tuples(st.floats(0.0, 0.3), st.floats(-1.0, 1.0)))
def test_no_step_leaves_the_joint_limits_and_each_clamp_is_named(wanted, q):
    q, wanted = np.array(q), np.array(wanted)
    result, names = LIMITS.clamp(q, wanted, PERIOD)
    assert np.all(result >= LIMITS.lower - 1e-12)
    assert np.all(result <= LIMITS.upper + 1e-12)
    assert np.all(np.abs(result - q) <= LIMITS.speed * PERIOD * (1 + 1e-9))
    assert bool(names) == bool(np.max(np.abs(result - wanted)) > 1e-9)


def test_a_step_that_is_too_fast_keeps_its_direction():
    result, names = LIMITS.clamp(np.array([0.1, 0.0]), np.array([0.102, 0.01]), PERIOD)
    np.testing.assert_allclose(result, [0.101, 0.005])
    assert names == ("speed lift",)


def test_the_reference_cannot_jump():
    far = Pose(np.array([1.0, 0.0, 0.0]), IDENTITY)
    near, clamped = safety.clamp_reference(Pose(np.zeros(3), IDENTITY), far, PERIOD)
    assert clamped == ("reference speed",)
    np.testing.assert_allclose(near.position, [safety.REFERENCE_SPEED * PERIOD, 0.0, 0.0])
    assert safety.clamp_reference(near, near, PERIOD) == (near, ())


@pytest.mark.parametrize("sign", [1.0, -1.0])
def test_the_reference_cannot_spin_whatever_the_sign_of_its_quaternion(sign):
    widest = safety.REFERENCE_TURN_SPEED * PERIOD
    pose, turned = Pose(np.zeros(3), IDENTITY), Pose(np.zeros(3), sign * exp_map(np.array([0.0, 10.5 * widest, 0.0])))
    for _ in range(10):
        before = pose
        pose, clamped = safety.clamp_reference(before, turned, PERIOD)
        assert clamped == ("reference turn speed",)
        assert angle_between(before.orientation, pose.orientation) == pytest.approx(widest)
    assert safety.clamp_reference(pose, turned, PERIOD) == (turned, ())


@given(st.tuples(*[st.floats(-2.0, 2.0)] * 3), st.tuples(*[st.floats(-4.0, 4.0)] * 3))
def test_a_correction_keeps_to_its_reach_and_its_direction_and_each_clamp_is_named(offset, turn):
    wanted = Correction(np.array(offset), np.array(turn))
    within, names = safety.clamp_correction(wanted)
    for vector, clamped, reach, name in (
        (wanted.offset, within.offset, safety.DISPLACEMENT_REACH, "displacement"),
        (wanted.turn, within.turn, safety.ROTATION_REACH, "rotation"),
    ):
        assert np.linalg.norm(clamped) <= reach * (1.0 + 1e-9)
        assert (name in names) == (np.linalg.norm(vector) > reach * (1.0 + 1e-9))
        np.testing.assert_allclose(np.cross(vector, clamped), 0.0, atol=1e-12)


@given(st.tuples(*[st.floats(-1.0, 1.0)] * 3), st.tuples(*[st.floats(-1.0, 1.0)] * 3))
def test_the_reference_goes_towards_what_is_wanted_as_far_as_it_may(previous, wanted):
    previous, wanted = np.array(previous), np.array(wanted)
    pose, clamped = safety.clamp_reference(Pose(previous, IDENTITY), Pose(wanted, IDENTITY), PERIOD)
    farthest = safety.REFERENCE_SPEED * PERIOD
    way = np.linalg.norm(wanted - previous)
    assert np.linalg.norm(pose.position - previous) == pytest.approx(min(way, farthest), abs=1e-12)
    assert np.linalg.norm(wanted - pose.position) == pytest.approx(max(0.0, way - farthest), abs=1e-12)
    assert bool(clamped) == (way > farthest * (1.0 + 1e-9))


def test_a_reference_that_turns_too_fast_arrives_at_its_place_all_the_same():
    wanted = Pose(np.array([0.01, 0.0, 0.0]), exp_map(np.array([0.0, 0.5, 0.0])))
    pose, clamped = safety.clamp_reference(Pose(np.zeros(3), IDENTITY), wanted, PERIOD)
    np.testing.assert_array_equal(pose.position, wanted.position)
    assert clamped == ("reference turn speed",)
    assert angle_between(pose.orientation, wanted.orientation) == pytest.approx(0.5 - 0.015)


def test_a_reference_that_moves_and_turns_as_fast_as_it_may_is_not_clamped():
    wanted = Pose(np.array([0.012, 0.0, 0.0]), exp_map(np.array([0.0, 0.015, 0.0])))
    assert safety.clamp_reference(Pose(np.zeros(3), IDENTITY), wanted, PERIOD) == (wanted, ())


def test_a_joint_at_its_limits_or_its_speed_is_not_clamped():
    for q, wanted in (((0.299, 0.99), (0.3, 1.0)), ((0.001, -0.99), (0.0, -1.0))):
        result, names = LIMITS.clamp(np.array(q), np.array(wanted), PERIOD)
        np.testing.assert_allclose(result, wanted, atol=1e-15)
        assert names == ()


def test_every_joint_beyond_its_limits_or_its_speed_is_named():
    _, names = LIMITS.clamp(np.array([0.3, 1.0]), np.array([0.4, 1.001]), PERIOD)
    assert names == ("position lift", "position elbow")
    _, names = LIMITS.clamp(np.array([0.1, 0.0]), np.array([0.2, -1.0]), PERIOD)
    assert names == ("speed lift", "speed elbow")


def test_a_speed_that_is_a_little_too_fast_is_named():
    result, names = LIMITS.clamp(np.array([0.1, 0.0]), np.array([0.10101, 0.0]), PERIOD)
    np.testing.assert_allclose(result, [0.101, 0.0])
    assert names == ("speed lift",)


def test_what_exceeds_a_limit_by_no_more_than_rounding_is_not_clamped():
    more = 1.0 + safety.ROUNDING
    wide = JointLimits(("elbow",), np.array([0.0]), np.array([2.0]), np.array([1.0]))
    assert wide.clamp(np.zeros(1), np.array([-safety.ROUNDING]), 1.0)[1] == ()
    assert wide.clamp(np.zeros(1), np.array([more]), 1.0)[1] == ()
    vector = np.array([0.0, 0.3 * more, 0.0])
    assert safety.clamp_length(vector, 0.3) == (vector, False)
    half = 0.5 * safety.REFERENCE_TURN_SPEED * PERIOD * more
    turned = Pose(np.zeros(3), np.array([math.cos(half), 0.0, math.sin(half), 0.0]))
    assert safety.clamp_reference(Pose(np.zeros(3), IDENTITY), turned, PERIOD) == (turned, ())


@pytest.mark.parametrize(("force", "stops"), [(0.0, False), (300.0, False), (300.1, True), (600.0, True)])
def test_a_touch_that_pushes_harder_than_any_motion_should_stops_the_arm(force, stops):
    assert safety.too_forceful(force) is stops


@pytest.mark.parametrize("times", [0.5, 1.0, 1.0 + 1e-6, 1.5, 2.0, 1e9])
def test_a_vector_is_shortened_to_its_longest_and_no_further(times):
    vector, clamped = safety.clamp_length(np.array([0.0, -0.3 * times, 0.0]), 0.3)
    np.testing.assert_allclose(vector, [0.0, -0.3 * min(times, 1.0), 0.0])
    assert clamped is (times > 1.0)


def test_a_robot_too_close_to_itself_may_only_move_away():
    assert safety.self_collision(distance=0.004, previous=0.006, limit=0.005)
    assert not safety.self_collision(distance=0.004, previous=0.003, limit=0.005)
    assert not safety.self_collision(distance=0.006, previous=0.007, limit=0.005)
    assert not safety.self_collision(distance=0.005, previous=0.007, limit=0.005)
    assert not safety.self_collision(distance=0.004, previous=0.004, limit=0.005)


@pytest.mark.parametrize(
    ("speeds", "stands"), [((0.0, 0.0), True), ((0.01, -0.01), True), ((0.0, 0.0101), False), ((-0.0101, 0.0), False)]
)
def test_a_robot_stands_when_every_joint_does(speeds, stands):
    assert safety.standing(np.array(speeds)) is stands
