"""The way to where motions start: looked through before, at limited speed, stopped by whoever stops a motion."""

import numpy as np
import pytest

from protocol import queries
from protocol.messages import Phase
from protocol.queries import Accepted, Refused
from services.robot.backends.backend import CONTROL_PERIOD
from services.robot.homing import SHARE, Homing, WayBlocked
from tests.services.robot.site import Site

SPEED = np.array([1.0, 0.5, 1.0])


def free(q):
    return ""


def walked(homing):
    way = []
    while homing.under_way:
        way.append(homing.advance())
    return np.array(way)


def test_it_ends_at_the_goal_at_rest_and_no_joint_is_faster_than_its_share_of_its_limit():
    homing, done = Homing(SPEED, free), []
    goal = np.array([0.4, -0.3, 0.1])
    homing.begin(np.zeros(3), goal, lambda: done.append(True))
    way = walked(homing)
    assert done == [True]
    np.testing.assert_allclose(way[-1], goal)
    speeds = np.abs(np.diff(way, axis=0)) / CONTROL_PERIOD
    assert np.all(speeds <= SHARE * SPEED * (1.0 + 1e-3))
    assert speeds.max() > 0.9 * SHARE * SPEED.min(), "nor slower than need be"
    np.testing.assert_allclose(speeds[[0, -1]], 0.0, atol=1e-3)


def test_a_way_through_something_is_not_begun():
    homing = Homing(SPEED, lambda q: "the robot's arm would touch the table" if 0.2 < q[0] < 0.3 else "")
    with pytest.raises(WayBlocked, match="the way there is blocked: the robot's arm would touch the table"):
        homing.begin(np.zeros(3), np.array([0.4, 0.0, 0.0]), lambda: None)
    assert not homing.under_way


def test_what_it_touches_where_it_is_it_may_leave_but_not_come_back_to():
    homing = Homing(SPEED, lambda q: "a wall" if q[0] < 0.05 else "")
    homing.begin(np.zeros(3), np.array([0.4, 0.0, 0.0]), lambda: None)
    assert homing.under_way
    homing.stop()
    again = Homing(SPEED, lambda q: "a wall" if q[0] < 0.05 or q[0] > 0.35 else "")
    with pytest.raises(WayBlocked):
        again.begin(np.zeros(3), np.array([0.4, 0.0, 0.0]), lambda: None)


@pytest.fixture
def site():
    """A robot that is led to its start, away from it."""
    site = Site()
    site.acquire()
    site.execute()
    site.run(3.0)
    assert site.result.completed
    site.arm.drive.homing = Homing(SPEED, free)
    return site


def reset(site):
    return site.ask(queries.RESET, queries.Reset(site.epoch))


def away(site):
    return float(np.linalg.norm(np.array(site.state.q)))


def test_a_reset_leads_the_arm_there_and_says_so(site):
    before = away(site)
    assert before > 0.3
    assert isinstance(reset(site), Accepted)
    site.run(0.8)
    assert site.state.phase is Phase.HOMING
    assert 0.01 < before - away(site) < before - 0.01
    refused = site.ask_to_execute()
    assert isinstance(refused, Refused)
    assert "on its way to the start" in refused.reason
    site.run(4.0)
    assert site.state.phase is Phase.IDLE
    assert away(site) < 1e-6
    assert site.arm.observation.time < 4.0, "everything was put back once it was there"
    site.execute()


def test_a_stop_stops_it_on_its_way(site):
    reset(site)
    site.run(0.5)
    site.press()
    stood = away(site)
    site.run(1.0)
    assert away(site) == pytest.approx(stood)
    site.release()
    site.run(1.0)
    assert away(site) == pytest.approx(stood), "it goes on only when it is asked to"
    site.acquire()
    assert isinstance(reset(site), Accepted)
    site.run(5.0)
    assert away(site) < 1e-6


def test_without_its_operator_it_goes_no_further_and_not_on_by_itself(site):
    reset(site)
    site.run(0.5)
    site.run(0.5, renew=False)
    stood = away(site)
    assert stood > 0.05
    site.run(1.0)
    assert away(site) == pytest.approx(stood)
    assert site.state.phase is Phase.IDLE


def test_a_way_that_is_blocked_is_refused_in_a_line(site):
    site.arm.drive.homing = Homing(SPEED, lambda q: "the robot's arm would touch the table" if q[0] < 0.2 else "")
    stood = away(site)
    refused = reset(site)
    assert isinstance(refused, Refused)
    assert "the way there is blocked: the robot's arm would touch the table" in refused.reason
    site.run(0.5)
    assert away(site) == pytest.approx(stood)
