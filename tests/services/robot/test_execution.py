import math

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from lfd.motion.rotations import exp_map, multiply
from lfd.motion.trajectory import Trajectory
from services.robot.correction import UNCORRECTED, Correction
from services.robot.easing import EASE_S
from services.robot.execution import (
    RAMP_MIN_S,
    RAMP_SPEED,
    STILL_THERE,
    STILL_TURNED,
    Execution,
    Ramp,
    angle_between,
    look_ahead,
)
from sim.pose import Pose

PERIOD = 0.01
IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])


def cubic(t):
    """A motion that a cubic spline reproduces exactly."""
    return np.stack([0.5 + 0.02 * t, 0.01 * t**2, 0.8 - 0.001 * t**3], axis=-1)


def turn(t):
    return exp_map(np.multiply.outer(t, np.array([0.0, 0.05, 0.0])))


def prediction(n=75, duration=7.4):
    t = np.linspace(0.0, duration, n)
    return Trajectory(cubic(t), turn(t), duration)


def moved(*offset):
    return Correction(np.array(offset), np.zeros(3))


def rotated(*turn):
    return Correction(np.zeros(3), np.array(turn))


def at_start(motion):
    return Pose(motion.positions[0], motion.orientations[0])


def past_the_ramp(motion, after=None):
    execution = Execution(at_start(motion), motion, look_ahead(motion) if after is None else after, PERIOD)
    while execution.ramping:
        execution.advance(UNCORRECTED)
    return execution


def test_without_input_the_prediction_is_tracked_exactly_between_way_points_too():
    execution = past_the_ramp(prediction())
    for k in range(1, 741):
        reference = execution.advance(UNCORRECTED)
        np.testing.assert_allclose(reference.position, cubic(k * PERIOD), atol=1e-12)
        np.testing.assert_allclose(reference.orientation, turn(k * PERIOD), atol=1e-12)
    assert execution.finished


def test_the_correction_is_one_minus_one_over_e_of_the_operators_after_one_look_ahead():
    motion = prediction()  # a look-ahead of ten control periods
    wanted = Correction(np.array([0.1, -0.05, 0.02]), np.array([0.3, 0.0, -0.4]))
    execution = past_the_ramp(motion)
    for _ in range(10):
        execution.advance(wanted)
    np.testing.assert_allclose(execution.correction.offset, (1.0 - math.exp(-1.0)) * wanted.offset, rtol=1e-12)
    np.testing.assert_allclose(execution.correction.turn, (1.0 - math.exp(-1.0)) * wanted.turn, rtol=1e-12)


def test_the_discretisation_is_exact_for_any_period():
    motion, wanted = prediction(), Correction(np.array([0.1, 0.0, 0.0]), np.array([0.0, 0.5, 0.0]))
    corrections = []
    for period in (0.01, 0.005):
        execution = Execution(at_start(motion), motion, look_ahead(motion), period)
        while execution.ramping:
            execution.advance(UNCORRECTED)
        while execution.time < 1.0 - 1e-9:
            execution.advance(wanted)
        corrections.append(execution.correction)
    np.testing.assert_allclose(corrections[0].offset, corrections[1].offset, rtol=1e-12)
    np.testing.assert_allclose(corrections[0].turn, corrections[1].turn, rtol=1e-12)


def test_a_correction_acts_in_the_very_next_period_and_is_released_in_the_same_manner():
    execution = past_the_ramp(prediction())
    wanted = Correction(np.array([0.0, 0.0, 0.1]), np.array([0.2, 0.0, 0.0]))
    first = execution.advance(wanted)
    assert first.position[2] > cubic(PERIOD)[2]
    assert angle_between(first.orientation, turn(PERIOD)) > 0.0
    for _ in range(200):
        execution.advance(wanted)
    pushed = execution.correction
    execution.advance(UNCORRECTED)
    np.testing.assert_allclose(execution.correction.offset, math.exp(-0.1) * pushed.offset, rtol=1e-9)
    np.testing.assert_allclose(execution.correction.turn, math.exp(-0.1) * pushed.turn, rtol=1e-9)


def test_adapting_the_current_way_point_adds_the_displacement_at_once():
    execution = past_the_ramp(prediction(), after=0.0)
    reference = execution.advance(moved(0.1, 0.0, 0.0))
    np.testing.assert_allclose(reference.position - cubic(PERIOD), [0.1, 0.0, 0.0], atol=1e-12)


@given(st.lists(st.tuples(*[st.floats(-0.3, 0.3)] * 3), min_size=1, max_size=50))
def test_the_offset_never_leaves_the_box_of_what_the_operator_gave(displacements):
    execution = past_the_ramp(prediction())
    for displacement in displacements:
        execution.advance(moved(*displacement))
    given_so_far = np.array([(0.0, 0.0, 0.0), *displacements])
    assert np.all(execution.correction.offset <= given_so_far.max(axis=0) + 1e-12)
    assert np.all(execution.correction.offset >= given_so_far.min(axis=0) - 1e-12)


@given(st.tuples(*[st.floats(-0.6, 0.6)] * 3))
def test_a_rotation_is_applied_in_base_axes_to_the_predicted_orientation_and_moves_nothing(vector):
    """As SciPy has it: exp(r) R; the grasping frame turns about its own origin."""
    execution = past_the_ramp(prediction(), after=0.0)
    reference = execution.advance(rotated(*vector))
    expected = Rotation.from_rotvec(vector) * Rotation.from_quat(turn(PERIOD), scalar_first=True)
    actual = Rotation.from_quat(reference.orientation, scalar_first=True)
    assert (actual * expected.inv()).magnitude() == pytest.approx(0.0, abs=1e-9)
    np.testing.assert_array_equal(reference.position, execution.nominal.position)


@given(st.lists(st.tuples(*[st.floats(-0.57, 0.57)] * 3), min_size=1, max_size=50), st.floats(0.0, 0.5))
def test_the_orientation_is_a_unit_quaternion_that_never_jumps_whatever_the_master_does(rotations, after):
    execution = past_the_ramp(prediction(), after)
    before = execution.reference.orientation
    longest = 2.0 * math.sqrt(3.0) * 0.57 * (1.0 if after == 0.0 else -math.expm1(-PERIOD / after))
    for vector in rotations:
        orientation = execution.advance(rotated(*vector)).orientation
        assert abs(np.linalg.norm(orientation) - 1.0) < 1e-12
        assert angle_between(before, orientation) <= longest + 0.06 * PERIOD
        before = orientation
    longest_given = max(np.linalg.norm(vector) for vector in rotations)
    assert np.linalg.norm(execution.correction.turn) <= longest_given + 1e-12


def test_without_a_rotation_the_predicted_orientation_is_the_reference_bit_by_bit():
    execution = past_the_ramp(prediction())
    for _ in range(100):
        reference = execution.advance(moved(0.1, 0.0, 0.0))
        assert reference.orientation.tobytes() == execution.nominal.orientation.tobytes()


def test_a_rotation_that_is_let_go_leads_back_to_the_prediction():
    execution = past_the_ramp(prediction())
    for _ in range(100):
        execution.advance(rotated(0.0, 0.0, 0.8))
    assert angle_between(execution.nominal.orientation, execution.reference.orientation) > 0.7
    for _ in range(100):
        execution.advance(UNCORRECTED)
    assert angle_between(execution.nominal.orientation, execution.reference.orientation) < 1e-4


def test_a_period_that_is_not_advanced_is_a_hold():
    execution = past_the_ramp(prediction())
    execution.advance(Correction(np.array([0.1, 0.0, 0.0]), np.array([0.0, 0.3, 0.0])))
    time, correction, reference = execution.time, execution.correction, execution.reference
    assert (execution.time, execution.ramping, execution.correction) == (time, False, correction)
    np.testing.assert_array_equal(execution.reference.position, reference.position)
    np.testing.assert_array_equal(execution.reference.orientation, reference.orientation)


def test_a_hold_is_left_from_the_measured_pose_and_ends_where_it_began():
    execution = past_the_ramp(prediction())
    execution.advance(Correction(np.array([0.1, 0.0, 0.0]), np.array([0.0, 0.3, 0.0])))
    before = execution.reference
    elsewhere = Pose(before.position + np.array([0.0, 0.0, 0.05]), IDENTITY)
    execution.rejoin(elsewhere, at_once=True)
    np.testing.assert_allclose(execution.reference.position, elsewhere.position)
    while execution.ramping:
        execution.advance(Correction(np.full(3, 0.3), np.full(3, 0.3)))
    np.testing.assert_allclose(execution.reference.position, before.position, atol=1e-12)
    np.testing.assert_allclose(execution.reference.orientation, before.orientation, atol=1e-12)


@pytest.mark.parametrize(
    ("aside", "turned", "at_once", "ramps"),
    [
        (0.0, 0.0, True, False),
        (0.99 * STILL_THERE, 0.0, True, False),
        (1.01 * STILL_THERE, 0.0, True, True),
        (0.0, 0.99 * STILL_TURNED, True, False),
        (0.0, 1.01 * STILL_TURNED, True, True),
        (0.0, 0.0, False, True),
    ],
)
def test_only_a_short_hold_of_an_arm_that_is_still_there_is_left_without_a_ramp(aside, turned, at_once, ramps):
    execution = past_the_ramp(prediction())
    before = execution.reference
    turn = multiply(exp_map(np.array([turned, 0.0, 0.0])), before.orientation)
    execution.rejoin(Pose(before.position + np.array([0.0, aside, 0.0]), turn), at_once=at_once)
    assert execution.ramping is ramps


def test_a_ramp_that_was_held_for_a_moment_goes_on_where_it_was():
    motion = prediction()
    start = Pose(motion.positions[0] + np.array([0.0, 0.2, 0.0]), motion.orientations[0])
    execution, ticks = Execution(start, motion, look_ahead(motion), PERIOD), 0
    while execution.ramping:
        execution.advance(UNCORRECTED)
        if ticks in (30, 70):
            execution.rejoin(execution.reference, at_once=True)
        ticks += 1
    assert ticks == pytest.approx((0.2 / RAMP_SPEED + 2 * 0.5 * EASE_S) / PERIOD, abs=2)


def test_a_long_hold_on_the_first_ramp_lets_it_begin_anew():
    motion = prediction()
    execution = Execution(at_start(motion), motion, look_ahead(motion), PERIOD)
    execution.advance(UNCORRECTED)
    execution.rejoin(at_start(motion), at_once=False)
    for _ in range(round(RAMP_MIN_S / PERIOD)):
        assert execution.ramping
        execution.advance(UNCORRECTED)
    assert (execution.ramping, execution.time) == (False, 0.0)


def test_a_duration_that_is_no_multiple_of_the_period_ends_at_the_last_way_point():
    motion = prediction(duration=1.003)
    execution = past_the_ramp(motion)
    while not execution.finished:
        execution.advance(UNCORRECTED)
    assert (execution.time, execution.progress) == (1.003, 1.0)
    np.testing.assert_allclose(execution.reference.position, motion.positions[-1], atol=1e-12)


@pytest.mark.parametrize(
    ("distance", "angle", "seconds"), [(0.0, 0.0, RAMP_MIN_S), (0.3, 0.0, 0.3 / RAMP_SPEED), (0.0, 1.0, 2.0)]
)
def test_the_ramp_takes_as_long_as_its_longest_way(distance, angle, seconds):
    goal = Pose(np.array([distance, 0.0, 0.0]), exp_map(np.array([0.0, angle, 0.0])))
    ramp = Ramp(Pose(np.zeros(3), IDENTITY), goal, PERIOD)
    ticks = 0
    while not ramp.finished:
        ramp.advance()
        ticks += 1
    assert ticks * PERIOD == pytest.approx(seconds)
    np.testing.assert_allclose(ramp.pose.position, goal.position)
    assert angle_between(ramp.pose.orientation, goal.orientation) == pytest.approx(0.0, abs=1e-9)


def test_the_ramp_begins_at_the_measured_pose_and_is_smooth():
    ramp = Ramp(Pose(np.zeros(3), IDENTITY), Pose(np.array([0.3, 0.0, 0.0]), IDENTITY), PERIOD)
    positions = [ramp.pose.position[0]]
    while not ramp.finished:
        ramp.advance()
        positions.append(ramp.pose.position[0])
    speeds = np.diff(positions) / PERIOD
    assert positions[0] == 0.0
    assert max(speeds[0], speeds[-1]) < 1e-3
    assert np.max(speeds) == pytest.approx(1.875 * RAMP_SPEED, rel=1e-3)


def test_what_needs_time_to_gain_its_speed_begins_from_rest_and_comes_to_rest():
    motion = prediction()  # it begins slowly, and would end at speed
    execution = Execution(at_start(motion), motion, look_ahead(motion), PERIOD, inert=True)
    while execution.ramping:
        execution.advance(UNCORRECTED)
    steps, before = [], execution.reference
    while not execution.finished:
        reference = execution.advance(UNCORRECTED)
        steps.append(np.linalg.norm(reference.position - before.position))
        before = reference
        assert len(steps) < 1000
    np.testing.assert_allclose(before.position, motion.positions[-1], atol=1e-12)
    assert max(steps[0], steps[-1]) < 0.1 * max(steps)


def test_a_share_of_the_pace_slows_the_motion_down_and_leads_the_same_way():
    motion = prediction()
    whole, half = past_the_ramp(motion), past_the_ramp(motion)
    for _ in range(100):
        one = whole.advance(UNCORRECTED)
        half.advance(UNCORRECTED, share=0.5)
        other = half.advance(UNCORRECTED, share=0.5)
        np.testing.assert_allclose(other.position, one.position, atol=1e-9)
