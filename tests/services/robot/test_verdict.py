import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.rotations import exp_map, multiply, rotate
from protocol.messages import Unmet
from services.robot.backends.backend import Touch
from services.robot.verdict import ReachingCriteria, ReachingJudge, ellipsoid_value, tilt_of
from sim.pose import Pose
from sim.region import Region
from sim.tasks.success import Success

RADII = np.array([0.05, 0.065, 0.05])
CRITERIA = ReachingCriteria(RADII, np.array([0.15, 0.1, 0.05]), tipping_angle=0.4)
UPRIGHT = Pose(np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))
VECTORS = st.tuples(*[st.floats(-3.0, 3.0)] * 3).map(np.array)


def standing(position):
    return Pose(position, UPRIGHT.orientation)


@given(VECTORS, VECTORS, st.floats(0.0, 3.1), st.floats(0.0, 6.2))
def test_the_ellipsoid_equation_is_one_on_its_boundary_in_any_pose(position, turn, polar, azimuth):
    orientation = exp_map(turn)
    unit = np.array([np.sin(polar) * np.cos(azimuth), np.sin(polar) * np.sin(azimuth), np.cos(polar)])
    on_boundary = position + rotate(orientation, RADII * unit)
    assert ellipsoid_value(Pose(position, orientation), on_boundary, RADII) == pytest.approx(1.0, rel=1e-9)


@pytest.mark.parametrize("axis", range(3))
def test_the_boundary_counts_as_reached(axis):
    judge = ReachingJudge(CRITERIA, np.zeros(3))
    on, outside = np.zeros(3), np.zeros(3)
    on[axis], outside[axis] = RADII[axis], RADII[axis] * 1.001
    assert judge.judge(UPRIGHT, standing(on), None).reached
    assert not judge.judge(UPRIGHT, standing(outside), None).reached
    assert judge.judge(UPRIGHT, standing(outside), None).missed == pytest.approx(RADII[axis] * 1.001)


@pytest.mark.parametrize("axis", range(3))
@pytest.mark.parametrize("sign", [-1.0, 1.0])
def test_kicked_over_is_more_than_the_threshold_on_any_axis(axis, sign):
    placed = np.array([0.8, 0.0, 0.5])
    judge = ReachingJudge(CRITERIA, placed)
    moved = placed.copy()
    moved[axis] += sign * CRITERIA.thresholds[axis] * 0.999
    assert not judge.judge(UPRIGHT, standing(moved), None).kicked_over
    moved[axis] += sign * CRITERIA.thresholds[axis] * 0.002
    assert judge.judge(UPRIGHT, standing(moved), None).kicked_over


@given(st.floats(0.0, 3.14), st.floats(0.0, 6.28), st.floats(-3.0, 3.0))
def test_a_tilt_is_the_angle_of_the_upright_axis_whatever_the_turn_about_it(tilt, azimuth, turn):
    lean = exp_map(tilt * np.array([np.cos(azimuth), np.sin(azimuth), 0.0]))
    assert tilt_of(multiply(lean, exp_map(np.array([0.0, 0.0, turn])))) == pytest.approx(tilt, abs=1e-7)


@pytest.mark.parametrize("axis", [(1.0, 0.0, 0.0), (0.0, -1.0, 0.0), (0.6, 0.8, 0.0)])
def test_an_object_that_has_toppled_is_kicked_over_wherever_its_centre_is(axis):
    judge = ReachingJudge(CRITERIA, np.zeros(3))
    just, beyond = (
        Pose(np.zeros(3), exp_map(share * CRITERIA.tipping_angle * np.array(axis))) for share in (0.99, 1.01)
    )
    assert judge.judge(UPRIGHT, just, None).success
    verdict = judge.judge(UPRIGHT, beyond, None)
    assert verdict.reached
    assert verdict.kicked_over
    assert not verdict.success


def test_the_first_collision_stays_with_its_place():
    judge = ReachingJudge(CRITERIA, np.zeros(3))
    first, second = (Touch(np.full(3, x), 10.0 * x, ("finger", "basket")) for x in (1.0, 2.0))
    assert judge.judge(UPRIGHT, UPRIGHT, None).success
    judge.judge(UPRIGHT, UPRIGHT, first)
    judge.judge(UPRIGHT, UPRIGHT, second)
    verdict = judge.judge(UPRIGHT, UPRIGHT, None)
    assert verdict.collision is first
    assert not verdict.success


def test_what_nobody_has_seen_is_not_reached_and_is_judged_from_where_it_is_seen_first():
    judge = ReachingJudge(CRITERIA, None)
    unseen = judge.judge(UPRIGHT, None, None)
    assert (unseen.reached, unseen.success, unseen.kicked_over) == (False, False, False)
    assert unseen.missed < 0.0, "nobody knows by how much"
    place = np.array([0.02, 0.0, 0.0])
    seen = judge.judge(UPRIGHT, standing(place), None)
    assert seen.success
    np.testing.assert_array_equal(seen.displacement, 0.0)
    assert judge.judge(UPRIGHT, standing(place + np.array([0.2, 0.0, 0.0])), None).kicked_over


HELD = ReachingCriteria(RADII, np.full(3, 0.1), 0.4, Success((0.05,) * 3, (0.1,) * 3, grasped=True, lifted=0.05))
REGION = Region((0.2, -0.1, -0.01), (0.4, 0.1, 0.03))
PUT = ReachingCriteria(RADII, np.full(3, 0.1), 0.4, Success((0.05,) * 3, (0.1,) * 3, placed=REGION))


def at(*position):
    return Pose(np.array(position), UPRIGHT.orientation)


def test_an_object_is_lifted_when_it_is_held_so_far_above_where_it_stood():
    judge = ReachingJudge(HELD, np.zeros(3))
    assert judge.judge(at(0.0, 0.0, 0.0), at(0.0, 0.0, 0.0), None).unmet == (Unmet.GRASPED, Unmet.LIFTED)
    assert judge.judge(at(0.0, 0.0, 0.0), at(0.0, 0.0, 0.0), None, grasped=True).unmet == (Unmet.LIFTED,)
    lifted = judge.judge(at(0.0, 0.0, 0.12), at(0.0, 0.0, 0.12), None, grasped=True)
    assert lifted.success
    assert not lifted.kicked_over, "further than one that is not held may move"
    dropped = judge.judge(at(0.0, 0.0, 0.12), at(0.0, 0.0, 0.0), None)
    assert (dropped.success, dropped.unmet) == (False, (Unmet.GRASPED, Unmet.LIFTED))


def test_what_was_never_held_is_kicked_over_by_being_moved():
    assert ReachingJudge(HELD, np.zeros(3)).judge(at(0.0, 0.0, 0.0), at(0.11, 0.0, 0.0), None).kicked_over


def test_an_object_is_placed_when_it_was_carried_there_and_let_go_of_wherever_the_hand_is_then():
    judge = ReachingJudge(PUT, np.zeros(3))
    assert judge.judge(at(0.3, 0.0, 0.0), at(0.3, 0.0, 0.0), None).unmet == (Unmet.PLACED,), "nobody carried it"
    assert judge.judge(at(0.3, 0.0, 0.0), at(0.3, 0.0, 0.0), None, grasped=True).unmet == (Unmet.PLACED,)
    assert judge.judge(at(0.0, 0.0, 0.4), at(0.3, 0.0, 0.0), None).success
    assert not judge.judge(at(0.0, 0.0, 0.4), at(0.5, 0.0, 0.0), None).success


def test_what_takes_longer_than_it_may_is_no_success():
    criteria = ReachingCriteria(RADII, np.full(3, 0.1), 0.4, Success((0.05,) * 3, (0.1,) * 3, time=8.0))
    judge = ReachingJudge(criteria, np.zeros(3))
    assert judge.judge(UPRIGHT, UPRIGHT, None, time=8.0).success
    assert judge.judge(UPRIGHT, UPRIGHT, None, time=8.1).unmet == (Unmet.IN_TIME,)


def test_some_things_may_be_touched_but_not_too_hard():
    success = Success((0.05,) * 3, (0.1,) * 3, may_touch=("rack",), force=20.0)
    assert success.allows("rack", 20.0)
    assert not success.allows("rack", 21.0)
    assert not success.allows("table", 1.0)
