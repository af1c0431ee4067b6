"""What an operator showed is tried by inverse kinematics before the arm moves: out of reach it is named by waypoint."""

import numpy as np
import pytest

from lfd.motion.trajectory import Trajectory
from lfd.motion.waypoints import Passing, passed_at, through_waypoints
from services.robot.kinematics import Kinematics
from services.robot.reach import check_reach
from services.robot.refusal import Refusal
from sim.robots.description import prepare
from sim.tasks import TABLE

pytestmark = pytest.mark.sim

AWAY = (1.1, 0.9, 1.8)
"""A place in the box round all that the arm reaches, and none of them [m]."""


@pytest.fixture(scope="module")
def kinematics():
    return Kinematics(prepare().urdf, TABLE.posture)


def through(*places):
    """From the table's start through places, oriented as there."""
    positions = np.array([TABLE.start.position, *places])
    orientations = np.tile(TABLE.start.orientation, (len(positions), 1))
    motion = through_waypoints(positions, orientations, 10.0, 75, Passing.CENTRIPETAL)
    return motion, tuple(passed_at(positions, orientations, Passing.CENTRIPETAL)[1:].tolist())


def near(*offset):
    return TABLE.start.position + np.array(offset)


def check(kinematics, motion, waypoints):
    check_reach(kinematics, TABLE.posture, motion, waypoints)


def test_what_a_person_would_lead_through_is_let_pass(kinematics):
    way = TABLE.corridor(TABLE.variants[-1], np.array(TABLE.training_positions[0]))[:2]
    motion = through_waypoints(*way, 10.0, 75, Passing.CENTRIPETAL)
    check(kinematics, motion, tuple(passed_at(*way, Passing.CENTRIPETAL).tolist()))


def test_a_waypoint_out_of_reach_is_named_with_what_to_do(kinematics):
    with pytest.raises(Refusal, match=r"waypoint 3.*out of reach.*(nearer|between them)") as refused:
        check(kinematics, *through(near(0.0, 0.0, 0.05), near(0.0, 0.1, 0.05), AWAY))
    assert refused.value.lasting, "asking again does not bring it nearer"


def test_a_way_that_swings_out_of_reach_is_named_by_the_waypoints_between(kinematics):
    motion, waypoints = through(near(0.0, 0.0, 0.05), near(0.0, 0.1, 0.05), near(0.0, 0.1, 0.1))
    between = 0.5 * (waypoints[0] + waypoints[1])
    swung = motion.positions + np.exp(-(((motion.phases - between) / 0.02) ** 2))[:, None] * [2.0, 0.0, 0.0]
    with pytest.raises(Refusal, match="from waypoint 1 to waypoint 2 is out of reach"):
        check(kinematics, Trajectory(swung, motion.orientations, 10.0), waypoints)
