"""What an operator showed becomes a motion that can be executed like a prediction, with an empty model too."""

import math
import re
from dataclasses import replace

import numpy as np
import pytest

from protocol import queries, topics
from protocol.messages import Origin, Pose, Purpose, Waypoint
from protocol.queries import Plan, Predicted, Refused
from services.bus.arrays import from_wire, motion_from_wire, motion_to_wire
from services.model.planning import planned as planned_in
from services.model.skill import OpeningUnfit
from sim.tasks import DISHWASHER
from tests.services.model.rig import OBJECT, START, positions

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
TURNED = (math.sqrt(0.5), 0.0, 0.0, math.sqrt(0.5))
WAYPOINTS = (Pose((0.55, 0.0, 0.6), UPRIGHT), Pose((0.7, 0.1, 0.65), TURNED), Pose(OBJECT, TURNED))


def plan(rig, origin=Origin.WAYPOINTS, **more):
    given = {"object_position": OBJECT, "scene": "dishwasher", "duration": 10.0, **more}
    return rig.ask(queries.PLAN, Plan(origin, **given))


def motion(n=600):
    path = np.linspace(START.position, OBJECT, n)
    return motion_to_wire(path, np.tile(UPRIGHT, (n, 1)), 20.0)


def test_a_plan_leads_from_the_start_through_the_waypoints_at_the_phases_that_it_says(rig):
    planned = plan(rig, waypoints=WAYPOINTS, start=START).prediction
    path, orientations, duration, _ = motion_from_wire(planned.motion)
    assert duration == 10.0
    np.testing.assert_allclose(path[[0, -1]], [START.position, OBJECT], atol=1e-9)
    assert len(planned.waypoints) == 3
    assert 0.0 < planned.waypoints[0] < planned.waypoints[1] < planned.waypoints[2] == 1.0
    for phase, waypoint in zip(planned.waypoints, WAYPOINTS, strict=True):
        nearest = round(phase * (len(path) - 1))
        np.testing.assert_allclose(path[nearest], waypoint.position, atol=0.01)
        assert abs(orientations[nearest] @ waypoint.orientation) > 0.999


GRASPING = replace(DISHWASHER, success=replace(DISHWASHER.success, grasped=True))
OPEN_AT_START = Waypoint(START.position, START.orientation, 0.08)


def grasping(*openings):
    return tuple(Waypoint(one.position, one.orientation, o) for one, o in zip(WAYPOINTS, openings, strict=True))


def through(waypoints, start=OPEN_AT_START, scene=GRASPING):
    return planned_in(scene, Plan(Origin.WAYPOINTS, OBJECT, "dishwasher", 10.0, start=start, waypoints=waypoints))


def test_the_gripper_closes_where_its_waypoint_is_reached_and_the_motion_stands_there():
    made = through(grasping(0.08, 0.0, 0.0))
    phases, opening = made.motion.phases, made.motion.opening
    closes = phases[np.argmax(opening < 0.04)]
    assert closes == pytest.approx(made.waypoints[1], abs=1.0 / 74)
    assert set(opening) == {0.0, 0.08}
    stands = (phases > closes) & (phases < closes + 0.08)
    there = np.tile(WAYPOINTS[1].position, (stands.sum(), 1))
    np.testing.assert_allclose(made.motion.positions[stands], there, atol=1e-4)


def test_a_first_waypoint_that_closes_is_reached_open():
    assert through(grasping(0.0, 0.0, 0.0)).motion.opening[0] == 0.08


@pytest.mark.parametrize(
    ("scene", "openings", "start"),
    [(GRASPING, (None,) * 3, None), (DISHWASHER, (0.08, 0.08, 0.0), OPEN_AT_START)],
)
def test_what_says_nothing_of_a_gripper_that_takes_part_is_no_plan_nor_what_does_of_one_that_does_not(
    scene, openings, start
):
    with pytest.raises(OpeningUnfit):
        through(grasping(*openings), start, scene)


def test_waypoints_of_which_some_have_an_opening_make_no_motion(rig):
    refused = plan(rig, waypoints=grasping(0.08, None, 0.0))
    assert isinstance(refused, Refused)
    assert "give it to all" in refused.reason


@pytest.mark.parametrize("start", [None, Pose((0.551, 0.0, 0.6), UPRIGHT)])
def test_it_begins_at_the_first_waypoint_where_that_is_the_start(rig, start):
    planned = plan(rig, waypoints=WAYPOINTS, start=start).prediction
    np.testing.assert_allclose(positions(Predicted(planned))[0], WAYPOINTS[0].position)
    assert planned.waypoints[0] == 0.0


@pytest.mark.parametrize("origin", [Origin.REFINEMENT, Origin.DEMONSTRATION])
def test_a_motion_that_was_shown_is_the_plan_in_the_time_that_is_asked_for(rig, origin):
    planned = plan(rig, origin, motion=motion(100)).prediction
    np.testing.assert_allclose(positions(Predicted(planned)), from_wire(motion(100).positions))
    assert (planned.origin, planned.motion.duration, planned.waypoints) == (origin, 10.0, ())


def test_a_plan_is_announced_under_an_id_of_its_own_and_certain(rig):
    heard = rig.network.bus().subscribe(topics.PREDICTION)
    first, second = (plan(rig, waypoints=WAYPOINTS).prediction for _ in range(2))
    assert heard.latest().message.id == second.id != first.id
    assert second.known == 1.0
    assert not from_wire(second.deviations).any()


def test_a_plan_changes_nothing_that_is_learnt(rig):
    before = rig.described()
    plan(rig, waypoints=WAYPOINTS)
    assert rig.described() == before


def test_where_something_is_learnt_a_prediction_comes_after_a_plan_as_before(rig):
    rig.teach(Purpose.INITIAL)
    before = positions(rig.predict())
    plan(rig, waypoints=WAYPOINTS)
    np.testing.assert_array_equal(positions(rig.predict()), before)


FAR = Pose((0.7, 3.0, 0.6), UPRIGHT)


@pytest.mark.parametrize(
    ("given", "reason"),
    [
        ({"waypoints": WAYPOINTS[:2]}, r"2 waypoint\(s\).*at least 3"),
        ({"waypoints": (*WAYPOINTS[:2], FAR)}, "waypoint 3 at"),
        ({"waypoints": WAYPOINTS, "motion": motion()}, "the one or the other"),
        ({"origin": Origin.REFINEMENT}, "takes a motion"),
        ({"origin": Origin.MODEL, "motion": motion()}, "origin model"),
        ({"waypoints": WAYPOINTS, "scene": "table"}, "--scene table"),
        ({"waypoints": WAYPOINTS, "duration": 0.01}, "duration"),
        ({"waypoints": WAYPOINTS, "object_position": (9.0, 0.0, 0.0)}, "target"),
    ],
)
def test_what_is_no_plan_is_refused_in_a_line_that_names_it(rig, given, reason):
    refused = plan(rig, **given)
    assert isinstance(refused, Refused)
    assert "\n" not in refused.reason
    assert re.search(reason, refused.reason), refused.reason


def test_numbers_that_are_none_are_refused(rig):
    nowhere = motion_to_wire(np.full((2, 3), np.nan), np.tile(UPRIGHT, (2, 1)), 1.0)
    assert isinstance(plan(rig, Origin.REFINEMENT, motion=nowhere), Refused)
