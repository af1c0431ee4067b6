"""Waypoints at which the gripper opens or closes."""

import numpy as np
import pytest

from lfd.exceptions import OutOfRange, WrongShape
from lfd.motion.standing import STANDS_S
from lfd.motion.waypoints import Passing, passed_at, through_waypoints

OPEN = 0.08
POSITIONS = np.array([[0.5, 0.0, 0.5], [0.7, 0.1, 0.4], [0.8, 0.2, 0.3], [0.8, 0.2, 0.5], [0.6, 0.3, 0.5]])
TURNS = np.tile([1.0, 0.0, 0.0, 0.0], (5, 1))
N = 401
DURATION = 10.0

both = pytest.mark.parametrize("passing", Passing)


def motion(opening, passing=Passing.CENTRIPETAL, n=N):
    return through_waypoints(POSITIONS, TURNS, DURATION, n, passing, opening=opening)


def reached(opening, passing=Passing.CENTRIPETAL):
    return passed_at(POSITIONS, TURNS, passing, opening=opening, duration=DURATION)


@both
@pytest.mark.parametrize("opening", [[OPEN] * 5, [OPEN, OPEN, 0.0, 0.0, 0.0], [OPEN, OPEN, 0.0, 0.0, OPEN]])
def test_each_waypoint_is_passed_and_the_opening_is_its_own_from_there_on(opening, passing):
    made, at = motion(opening, passing), reached(opening, passing)
    assert at[0] == 0.0
    for place, phase, grasp in zip(POSITIONS, at, opening, strict=True):
        i = np.searchsorted(made.phases, phase + 1e-9).clip(max=N - 1)
        np.testing.assert_allclose(made.positions[i], place, atol=0.015)  # one of 400 steps is as long
        assert made.opening[i] == grasp
    assert set(made.opening) <= set(opening)


@both
def test_it_stands_where_the_gripper_closes_while_the_fingers_move(passing):
    opening = [OPEN, OPEN, 0.0, 0.0, 0.0]
    made, phase = motion(opening, passing), reached(opening, passing)[2]
    stands = (made.phases >= phase) & (made.phases <= phase + STANDS_S / DURATION)
    np.testing.assert_allclose(made.positions[stands], POSITIONS[2][None].repeat(stands.sum(), axis=0), atol=1e-6)
    assert np.count_nonzero(np.diff(made.opening)) == 1


@both
def test_it_slows_down_before_it_stands_and_goes_on_from_rest(passing):
    made = motion([OPEN, OPEN, 0.0, 0.0, 0.0], passing)
    speeds = np.linalg.norm(np.diff(made.positions, axis=0), axis=1)
    assert np.abs(np.diff(speeds)).max() < 0.1 * speeds.max()


def test_one_that_ends_with_closing_stands_at_its_end():
    opening = [OPEN] * 4 + [0.0]
    made = motion(opening)
    assert made.opening[-1] == 0.0
    assert reached(opening)[-1] == pytest.approx(1.0 - STANDS_S / DURATION)


@both
def test_where_nothing_closes_it_is_the_motion_without_a_gripper(passing):
    plain = through_waypoints(POSITIONS, TURNS, DURATION, N, passing)
    np.testing.assert_allclose(motion([OPEN] * 5, passing).positions, plain.positions, atol=1e-12)
    np.testing.assert_allclose(reached([OPEN] * 5, passing), passed_at(POSITIONS, TURNS, passing), atol=1e-9)


def test_waypoints_that_coincide_may_open_and_close():
    place = POSITIONS[[0, 1, 1, 1, 2]]
    made = through_waypoints(place, TURNS, 4.0, N, Passing.CENTRIPETAL, opening=[OPEN, OPEN, 0.0, OPEN, OPEN])
    assert np.count_nonzero(np.diff(made.opening)) == 2
    assert np.isfinite(made.positions).all()


@pytest.mark.parametrize(("opening", "error"), [([0.0] * 4, WrongShape), ([0.1, 0.1, -0.1, 0.1, 0.1], OutOfRange)])
def test_what_is_no_opening_of_each_is_refused(opening, error):
    with pytest.raises(error):
        motion(opening)
