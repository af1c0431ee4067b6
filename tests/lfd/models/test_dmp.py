"""Dynamic movement primitives: the laws that the thesis' appendix B claims for them."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.exceptions import (
    InvalidDuration,
    LfdError,
    NotFinite,
    NotUnitQuaternion,
    OutOfRange,
    TooFewPoints,
    WrongShape,
)
from lfd.models.dmp import DMP, DmpOptions, Scaling
from lfd.motion.rotations import conjugate, exp_map, log_map, multiply, rotate
from lfd.motion.trajectory import Trajectory

FADED = 5.1e-5  # (1 + 12.5) exp(-12.5): what is left at the end of a new start or goal

Y = np.array([0.0, 1.0, 0.0])
IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
ROUGH = DmpOptions(count=20)  # fast, where closeness is not what is tested

coordinates = st.floats(-0.6, 0.6)
vectors = st.tuples(coordinates, coordinates, coordinates).map(np.array)


def ends(trajectory):
    first, last = ((trajectory.positions[i], trajectory.orientations[i]) for i in (0, -1))
    return first, last


def again(primitive, trajectory, n=None):
    return primitive.reproduce(*ends(trajectory), trajectory.duration, n or trajectory.n_points)


def position_error(a, b):
    return np.sqrt(np.mean(np.sum((a.positions - b.positions) ** 2, axis=1)))


def angles(p, q):
    return np.linalg.norm(log_map(multiply(p, conjugate(q))), axis=-1)


def orientation_error(a, b):
    return np.sqrt(np.mean(angles(a.orientations, b.orientations) ** 2))


def assert_same(a, b, atol):
    np.testing.assert_allclose(a.positions, b.positions, rtol=0.0, atol=atol)
    np.testing.assert_allclose(angles(a.orientations, b.orientations), 0.0, atol=max(atol, 1e-7))


@pytest.fixture
def motion(reach):
    return reach([0.9, 0.2, 0.6], bend=0.1).trajectory


@pytest.fixture
def primitive(motion):
    return DMP.fit(motion)


@pytest.mark.parametrize(("n", "bend"), [(10, 0.1), (60, 0.0), (300, -0.2)])
def test_a_smooth_motion_is_reproduced(reach, n, bend):
    motion = reach([0.9, 0.2, 0.6], bend=bend, n=n).trajectory
    reproduced = again(DMP.fit(motion), motion)
    assert position_error(reproduced, motion) < 1e-4
    assert orientation_error(reproduced, motion) < 2e-4


@pytest.mark.data
@pytest.mark.parametrize(
    "name", ["one_plane", "constant_initial_pose", "dishwasher", "dishwasher_moved_backwards", "dishwasher_experiment"]
)
def test_a_recorded_motion_is_reproduced_to_a_millimetre(recordings, name):
    for demonstration in recordings(name):
        motion = demonstration.trajectory
        reproduced = again(DMP.fit(motion), motion)
        assert position_error(reproduced, motion) < 1e-3
        assert orientation_error(reproduced, motion) < 1e-2  # they turn in steps of up to 0.1 rad


@pytest.mark.parametrize("options", [DmpOptions(), DmpOptions(count=20, alpha_y=40.0, alpha_x=3.0)])
def test_it_solves_equations_b9_to_b12(motion, options):
    from scipy.integrate import solve_ivp

    primitive = DMP.fit(motion, options)
    c = np.exp(-options.alpha_x * np.linspace(0.0, 1.0, options.count))
    h = 1.0 / np.append(c[:-1] - c[1:], c[-2] - c[-1]) ** 2
    y_0, g = motion.positions[0], motion.positions[-1]

    def right_side(_, state):
        y, yd, x = state[:3], state[3:6], state[6]
        psi = np.exp(-h * (x - c) ** 2)
        f = x * psi @ primitive.weights[:, :3] / psi.sum()
        ydd = options.alpha_y * (options.alpha_y / 4.0 * (g - y) - yd) + f
        return np.concatenate([yd, ydd, [-options.alpha_x * x]])

    initial = np.concatenate([y_0, np.zeros(3), [1.0]])
    times = np.linspace(0.0, 1.0, 41)
    solved = solve_ivp(right_side, (0.0, 1.0), initial, "DOP853", times, rtol=1e-9, atol=1e-11, max_step=0.005)
    np.testing.assert_allclose(again(primitive, motion, n=41).positions, solved.y[:3].T, rtol=0.0, atol=2e-6)


@pytest.mark.parametrize("n", [2, 3, 11, 100])
def test_a_point_lies_where_its_time_is_at_any_number_of_points(primitive, motion, n):
    fine = again(primitive, motion, n=10 * (n - 1) + 1)
    np.testing.assert_allclose(again(primitive, motion, n).positions, fine.positions[::10], atol=1e-6)


@given(duration=st.floats(1e-2, 1e3))
def test_the_path_is_the_same_at_any_duration(duration):
    motion = arc()
    reproduced = DMP.fit(motion, ROUGH).reproduce(*ends(motion), duration, 40)
    assert reproduced.duration == duration
    assert_same(reproduced, again(DMP.fit(motion, ROUGH), motion, 40), atol=0.0)


@given(shift=vectors, turn=vectors)
def test_start_and_goal_moved_and_turned_together_move_and_turn_the_path(shift, turn):
    motion, q = arc(), exp_map(turn)
    primitive = DMP.fit(motion, ROUGH)
    (y_0, q_0), (g, q_g) = ends(motion)
    moved = primitive.reproduce((y_0 + shift, multiply(q_0, q)), (g + shift, multiply(q_g, q)), 5.0, 40)
    there = again(primitive, motion, 40)
    assert_same(moved, Trajectory(there.positions + shift, multiply(there.orientations, q), 5.0), atol=1e-9)


@given(factor=st.floats(0.1, 10.0), turn=vectors, tool=vectors, start=vectors, goal=vectors)
def test_another_unit_base_frame_and_tool_describe_the_same_motion(factor, turn, tool, start, goal):
    """Demonstration, start and goal described otherwise: so is the reproduction, and nothing else changes."""
    motion, base, tool = arc(), exp_map(turn), exp_map(tool)

    def otherwise(positions, orientations):
        return factor * rotate(base, positions), multiply(multiply(base, orientations), tool)

    def reproduced(motion, describe):
        primitive = DMP.fit(motion, ROUGH)
        return primitive.reproduce(describe(start, exp_map(0.5 * start)), describe(goal, exp_map(goal)), 5.0, 40)

    here = reproduced(motion, lambda *pose: pose)
    there = reproduced(Trajectory(*otherwise(motion.positions, motion.orientations), 5.0), otherwise)
    assert_same(there, Trajectory(*otherwise(here.positions, here.orientations), 5.0), atol=1e-7)


@given(factors=st.tuples(*[st.floats(-3.0, 3.0)] * 3).map(np.array))
def test_scaled_per_axis_the_path_stretches_with_the_distance_to_the_goal(factors):
    motion = arc()
    primitive = DMP.fit(motion, replace(ROUGH, scaling=Scaling.PER_AXIS))
    (y_0, q_0), (g, q_g) = ends(motion)
    stretched = primitive.reproduce((y_0, q_0), (y_0 + factors * (g - y_0), q_g), 5.0, 40)
    there = again(primitive, motion, 40)
    np.testing.assert_allclose(stretched.positions - y_0, factors * (there.positions - y_0), atol=1e-9)


def test_a_motion_that_ends_where_it_starts_on_an_axis_keeps_its_shape_without_scaling(reach):
    motion = reach([0.9, 0.0, 0.6], bend=0.1, start=(0.5, 0.0, 0.5)).trajectory
    primitive = DMP.fit(motion)
    (y_0, q_0), (g, q_g) = ends(motion)
    moved = primitive.reproduce((y_0, q_0), (g + 0.02 * Y, q_g), 5.0)
    assert 0.1 < moved.positions[:, 1].max() < 0.12
    with pytest.raises(OutOfRange, match="along y") as caught:
        DMP.fit(motion, DmpOptions(scaling=Scaling.PER_AXIS))
    assert caught.value.value < 1e-3


@given(start=vectors, goal=vectors, turns=st.tuples(vectors, vectors))
def test_it_begins_at_the_start_and_ends_at_the_goal(start, goal, turns):
    motion = arc()
    q_0, q_g = exp_map(turns[0]), exp_map(turns[1])
    reproduced = DMP.fit(motion, ROUGH).reproduce((start, q_0), (goal, q_g), 5.0)
    distances = np.linalg.norm(reproduced.positions[[0, -1]] - [start, goal], axis=1)
    assert distances[0] < 1e-12
    assert angles(reproduced.orientations[0], q_0) < 1e-7
    moved = np.linalg.norm(start - motion.positions[0]) + np.linalg.norm(goal - motion.positions[-1])
    assert distances[1] <= FADED * moved + 1e-9
    assert angles(reproduced.orientations[-1], q_g) < FADED * 2.0 * np.pi


@given(signs=st.tuples(*[st.sampled_from([-1.0, 1.0])] * 3), start=vectors, goal=vectors)
def test_a_quaternion_and_its_negative_give_the_same_motion(signs, start, goal):
    motion = arc()
    flipped = Trajectory(motion.positions, signs[0] * motion.orientations, motion.duration)
    poses = (start, exp_map(start)), (goal, exp_map(goal))
    expected = DMP.fit(motion, ROUGH).reproduce(*poses, 5.0)
    (y_0, q_0), (g, q_g) = poses
    reproduced = DMP.fit(flipped, ROUGH).reproduce((y_0, signs[1] * q_0), (g, signs[2] * q_g), 5.0)
    np.testing.assert_array_equal(reproduced.positions, expected.positions)
    np.testing.assert_array_equal(reproduced.orientations, expected.orientations)


@given(start=vectors, goal=vectors)
def test_orientations_have_unit_norm(start, goal):
    reproduced = DMP.fit(arc(), ROUGH).reproduce((start, exp_map(3 * start)), (goal, exp_map(goal)), 5.0)
    np.testing.assert_allclose(np.linalg.norm(reproduced.orientations, axis=1), 1.0, atol=1e-12)


def test_a_turn_of_more_than_half_a_circle_goes_the_demonstrated_way_round():
    s = np.linspace(0.0, 1.0, 200)[:, None]
    smooth = s**3 * (10.0 - 15.0 * s + 6.0 * s**2)
    motion = Trajectory(smooth * [0.3, 0.1, 0.2], exp_map(smooth * [0.0, 4.0, 0.0]), 5.0)
    reproduced = again(DMP.fit(motion), motion)
    assert orientation_error(reproduced, motion) < 1e-3


def test_a_full_turn_has_no_rotation_vector_and_is_refused():
    s = np.linspace(0.0, 1.0, 200)[:, None]
    motion = Trajectory(s * [0.3, 0.1, 0.2], exp_map(s * [0.0, 7.0, 0.0]), 5.0)
    with pytest.raises(OutOfRange, match="full turn"):
        DMP.fit(motion)


POSE = (np.zeros(3), IDENTITY)


@pytest.mark.parametrize(
    ("arguments", "error", "fact"),
    [
        (((np.zeros(2), IDENTITY), POSE, 1.0, 10), WrongShape, ("name", "start position")),
        ((POSE, (np.zeros(3), np.eye(4)), 1.0, 10), WrongShape, ("name", "goal orientation")),
        (((np.nan * Y, IDENTITY), POSE, 1.0, 10), NotFinite, ("index", (0,))),
        ((POSE, (np.zeros(3), 2.0 * IDENTITY), 1.0, 10), NotUnitQuaternion, ("norm", 2.0)),
        ((POSE, POSE, -1.0, 10), InvalidDuration, ("duration", -1.0)),
        ((POSE, POSE, float("nan"), 10), NotFinite, ("name", "duration")),
        ((POSE, POSE, 1.0, 1), TooFewPoints, ("count", 1)),
    ],
)
def test_what_is_no_pose_duration_or_number_of_points_is_refused(arguments, error, fact):
    with pytest.raises(error) as caught:
        DMP.fit(arc(), ROUGH).reproduce(*arguments)
    assert getattr(caught.value, fact[0]) == fact[1]
    assert isinstance(caught.value, LfdError)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("wrong", [{"count": 1}, {"alpha_y": 0.0}, {"alpha_y": float("nan")}, {"alpha_x": 1e3}])
def test_parameters_that_make_no_motion_are_refused(wrong):
    with pytest.raises(OutOfRange):
        DmpOptions(**wrong)


def arc():
    """A motion with an extent on every axis, for tests that hypothesis repeats."""
    s = np.linspace(0.0, 1.0, 50)[:, None]
    smooth = s * s * (3.0 - 2.0 * s)
    positions = [0.5, 0.0, 0.5] + smooth * [0.4, 0.2, -0.1] + np.sin(np.pi * s) ** 2 * [0.0, 0.1, 0.05]
    return Trajectory(positions, exp_map(smooth * [0.2, -0.3, 0.1] + [0.0, 0.4, 0.0]), 5.0)
