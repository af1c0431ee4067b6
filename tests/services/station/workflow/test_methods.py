"""The methods of teaching, stepped by hand: waypoints."""

from dataclasses import replace

import msgspec
import pytest

from protocol import queries
from protocol.messages import Method, Mode, Origin, Purpose, Waypoint
from services.station.press import Press
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.person import EMPTY, MOVING, Teaching, shown_way
from tests.services.station.workflow.site import (
    COLLIDED,
    MISSED,
    POSE,
    REACHED,
    SCRIPTED,
    Site,
)


def test_choosing_a_method_moves_nothing():
    site = Teaching(Method.WAYPOINTS)
    assert not MOVING & set(site.names())
    assert site.told.method is Method.WAYPOINTS
    assert Action.LEAD in site.state.offered
    assert Action.REFINE not in site.state.offered
    site.choose(Method.REFINE)
    assert Action.LEAD not in site.state.offered


def test_waypoints_are_stored_where_the_robot_was_measured():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.store(0.5, 0.6, 0.7)
    site.at(0.65)
    site.step(Action.STORE, argument="2")
    site.step(Action.LATER, argument="1")
    assert site.places == [0.65, 0.5, 0.7]
    site.step(Action.DELETE, argument="3")
    assert site.places == [0.65, 0.5]


def test_every_press_of_a_step_counts_in_its_order():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.at(0.6)
    site.step(presses=(Press("store"), Press("store"), Press("delete", "1")))
    assert site.places == [0.6]


def test_the_motion_through_the_waypoints_is_shown_before_anything_moves():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.store(0.5, 0.6, 0.7)
    before = set(site.names())
    site.finish()
    (plan,) = site.requests(queries.PLAN)
    start = Waypoint(POSE.position, POSE.orientation)
    assert (plan.origin, len(plan.waypoints), plan.start, plan.duration) == (Origin.WAYPOINTS, 3, start, 10.0)
    assert site.state.prediction.origin is Origin.WAYPOINTS
    assert site.names().count("cmd/execute") == 0
    assert "model/add_demonstration" not in before | set(site.names())
    assert site.told.recommended == "execute"
    assert "3 waypoints" in site.told.text


def test_where_the_gripper_takes_part_a_waypoint_is_stored_with_what_it_was_told_then():
    site = Teaching(Method.WAYPOINTS)
    site.sees(scene=msgspec.structs.replace(site.view.scene, wide_open=0.08))
    site.lead()
    for opening in (0.08, 0.0, 0.0):
        site.robot(opening_reference=opening, opening=0.04)
        site.store(0.5)
    site.finish()
    (plan,) = site.requests(queries.PLAN)
    assert [waypoint.opening for waypoint in plan.waypoints] == [0.08, 0.0, 0.0]
    assert plan.start.opening == 0.08
    assert [waypoint.opening for waypoint in site.told.waypoints] == [0.08, 0.0, 0.0]


def test_a_waypoint_out_of_reach_is_named_at_once_and_the_waypoints_can_be_changed():
    """Asking again would not bring it nearer."""
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.store(0.5, 0.6, 0.7)
    site.finish()
    why = "waypoint 3 is out of reach: the arm stays 80 mm away there; move it nearer to the robot"
    site.fail(queries.EXECUTE, queries.Refused(why, lasting=True))
    site.press(Action.EXECUTE, Phase.STARTING)
    site.decide()
    assert len(site.requests(queries.EXECUTE)) == 1
    assert why in site.told.event
    assert site.places == [0.5, 0.6, 0.7]
    assert {"delete", "earlier", "later", "lead"} <= set(site.told.actions)


def test_a_script_that_is_shown_nothing_yet_shows_the_first_motion_by_waypoints():
    site = Site(replace(SCRIPTED, untaught=True))
    site.sees(model=EMPTY)
    site.run_to(Phase.EXECUTING)
    assert (site.state.mode, site.state.approach.method) == (Mode.TEACH, Method.WAYPOINTS)


def test_a_change_of_the_waypoints_is_shown_again():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.store(0.5, 0.6, 0.7, 0.8)
    site.finish()
    site.step(Action.DELETE, argument="2")
    site.decide()
    assert [len(plan.waypoints) for plan in site.requests(queries.PLAN)] == [4, 3]
    site.step(Action.DELETE, argument="1")
    site.stay()
    assert len(site.requests(queries.PLAN)) == 2, "two make no motion"
    assert site.told.recommended == "lead"


def test_what_was_executed_through_waypoints_and_succeeded_is_learnt():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.store(0.5, 0.6, 0.7)
    site.finish()
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert site.requests(queries.EXECUTE)[0].mode is Mode.AUTONOMOUS
    assert site.requests(queries.PLAN)[-1].waypoints == site.state.approach.waypoints
    assert site.names()[-3:] == ["cmd/reset", "model/plan", "cmd/execute"]
    site.executed(REACHED)
    site.decide()
    (learnt,) = site.requests(queries.ADD_DEMONSTRATION)
    assert (learnt.method, learnt.purpose, learnt.motion.duration) == (Method.WAYPOINTS, Purpose.UPDATE, 10.0)
    assert site.places == []
    assert site.told.recommended == "execute", "to see it alone"
    assert site.state.attempts[-1].mode is Mode.TEACH


@pytest.mark.parametrize("outcome", [COLLIDED, MISSED])
def test_what_failed_through_waypoints_is_not_learnt_and_they_stay(outcome):
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.store(0.5, 0.6, 0.7)
    site.finish()
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.executed(outcome)
    site.decide()
    assert site.stay() == []
    assert site.requests(queries.ADD_DEMONSTRATION) == []
    assert site.places == [0.5, 0.6, 0.7]
    assert (Action.TEACH in site.state.offered) is (outcome is MISSED), "what collided is not even offered"


def test_whoever_goes_on_storing_goes_on_from_where_the_robot_stands():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.store(0.5)
    site.finish()
    assert Action.STORE in site.state.offered, "the last place may be stored yet"
    before = site.names().count("cmd/reset")
    site.lead()
    assert site.names().count("cmd/reset") == before
    site.store(0.6, 0.7)
    site.finish()
    assert site.places == [0.5, 0.6, 0.7]


def test_leading_without_a_waypoint_is_told_and_gets_no_verdict():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    assert site.told.led
    site.finish()
    assert site.told.led
    assert site.told.text.startswith("No waypoint is stored.")
    assert site.told.recommended == "lead"
    assert not site.state.attempts
    site.store(0.5, 0.6, 0.7)
    site.decide()
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert not site.told.led


def test_a_waypoint_is_stored_only_where_the_hand_has_led_for_it():
    site = Teaching(Method.DEMONSTRATE)
    site.lead()
    assert not site.told.led
    site.finish(REACHED, commanded=shown_way())
    site.choose(Method.WAYPOINTS)
    assert Action.STORE not in site.state.offered
    site.lead()
    site.step()
    assert Action.STORE in site.state.offered


def test_a_waypoint_out_of_reach_is_named_and_nothing_moves():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.store(0.5, 0.6, 0.7)
    site.fail(queries.PLAN, queries.Refused("waypoint 2 at (0.6, 0, 0.5) m is beyond the reach of tiago"))
    site.finish()
    assert "waypoint 2" in site.told.event
    assert site.stay() == []
