"""A person corrects when the gripper closes, and closes it where they lead the robot."""

import numpy as np
import pytest

from sim.person.intention import plan
from sim.person.itinerary import GRASPS, Itinerary
from sim.person.steering import steer
from sim.tasks.scene import Corridor

WIDE = 0.1
WAY = np.array([[0.0, 0.0, 0.0], [0.2, 0.1, 0.0], [0.3, 0.1, 0.0], [0.3, 0.1, 0.16]])
PICK = Corridor(WAY, np.tile([1.0, 0.0, 0.0, 0.0], (4, 1)), np.array([WIDE, WIDE, 0.0, 0.0]))
N = 75


def corrected(shift=0):
    """What a person means of a prediction that closes the gripper by so many points later than it should."""
    motion = steer(PICK, None, N)
    opening = np.roll(motion.opening, shift)
    opening[: max(shift, 0)] = WIDE
    opening[N + min(shift, 0) :] = 0.0
    return plan(motion.positions, motion.orientations, PICK, [PICK], opening=opening), opening


@pytest.mark.parametrize("shift", [0, 2, -2])
def test_a_gripper_that_closes_in_time_is_left_to_the_robot(shift):
    intention, _ = corrected(shift)
    assert intention.openings is None
    assert intention.opening(0.5) is None


def test_one_that_would_close_too_late_is_closed_where_it_should():
    intention, opening = corrected(15)
    due = np.flatnonzero(np.diff(steer(PICK, None, N).opening))[0] / (N - 1)
    assert intention.opening(due - 0.1) is None
    assert intention.opening(due + 0.05) == 0.0
    assert opening[round((due + 0.05) * N)] == WIDE


def test_one_that_would_close_too_early_is_kept_open_until_it_should():
    intention, _ = corrected(-15)
    due = np.flatnonzero(np.diff(steer(PICK, None, N).opening))[0] / (N - 1)
    assert intention.opening(due - 0.1) == WIDE
    assert intention.opening(due + 0.05) == 0.0


def test_without_a_gripper_nothing_is_asked_of_it():
    motion = steer(PICK, None, N)
    assert plan(motion.positions, motion.orientations, PICK, [PICK]).openings is None


def led(stops):
    """Where the robot was, and what was asked of the gripper, of one that follows at once."""
    itinerary = Itinerary(PICK, stops=stops)
    asked, arrived = [], []
    for tick in range(6000):
        aim = itinerary.aim.position
        if itinerary.over:
            break
        if itinerary.arrived(0.01 * tick, np.zeros(6)):
            arrived.append(itinerary.opening)
        asked.append((*aim, itinerary.opening))
    assert itinerary.over
    return np.array(asked), arrived


@pytest.mark.parametrize("stops", [True, False], ids=["waypoints", "in one go"])
def test_who_leads_stands_where_they_grasp_until_it_is_closed(stops):
    asked, _ = led(stops)
    closed = np.flatnonzero(asked[:, 3] == 0.0)
    np.testing.assert_allclose(asked[closed[0], :3], WAY[2], atol=1e-6)
    standing = np.linalg.norm(asked[:, :3] - WAY[2], axis=1) < 1e-6
    assert np.count_nonzero(standing[closed[0] :]) * 0.01 == pytest.approx(GRASPS, abs=0.4)
    assert asked[0, 3] == WIDE
    np.testing.assert_allclose(asked[-1, :3], WAY[-1], atol=1e-6)


def test_a_waypoint_is_said_to_be_there_when_the_gripper_has_closed():
    _, arrived = led(stops=True)
    assert arrived == [WIDE, 0.0, 0.0]
