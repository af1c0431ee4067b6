"""The methods of teaching, stepped by hand: waypoints, a demonstration, a refinement of the previous one."""

from dataclasses import replace

import msgspec
import numpy as np
import pytest

from protocol import queries
from protocol.messages import Cut, Method, Mode, ModelState, Origin, Purpose
from services.bus.arrays import from_wire, motion_to_wire
from services.station.press import Press
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import (
    BY_HAND,
    COLLIDED,
    HOLD,
    MISSED,
    POSE,
    REACHED,
    SCRIPTED,
    STOPPED,
    Site,
)

EMPTY = ModelState(kind="adaptive", version=0, demonstrations=0, updates=0, scene="dishwasher")
MOVING = {"cmd/reset", "cmd/execute", "cmd/teleoperate", "cmd/resume"}
FINISHED = {"completed": False, "reason": "finished by ann", "cut": Cut.FINISHED}


def shown_way(n=300, lingering=200):
    """A way that was led by hand, with a long pause in its middle."""
    t = np.concatenate([np.linspace(0.0, 0.5, n // 2), np.full(lingering, 0.5), np.linspace(0.5, 1.0, n // 2)])[:, None]
    positions = np.array([0.5, 0.0, 0.5]) + t * [0.3, 0.0, 0.1]
    return motion_to_wire(positions, np.tile([1.0, 0.0, 0.0, 0.0], (len(t), 1)), 40.0)


class Teaching(Site):
    """A person who teaches by a method."""

    def __init__(self, method, *, empty=False):
        super().__init__(BY_HAND)
        if empty:
            self.sees(model=EMPTY)
        self.run_to(Phase.DECIDING)
        self.choose(method)

    def choose(self, method):
        self.step(Action.METHOD, argument=method.value)
        self.decide()

    def decide(self):
        """Until the operator is asked, and told what s/he may do."""
        self.run_to(Phase.DECIDING)
        self.step()

    def lead(self):
        self.press(Action.LEAD, Phase.EXECUTING)

    def at(self, x):
        self.robot(measured=msgspec.structs.replace(POSE, position=(x, 0.0, 0.5)))

    def store(self, *places):
        for x in places:
            self.at(x)
            self.step(Action.STORE)

    def finish(self, outcome=MISSED, **changes):
        self.step(Action.FINISH)
        self.step()
        self.end(outcome, operator_input=True, **{**FINISHED, **changes})
        self.step()
        self.decide()

    def executed(self, outcome, **changes):
        """The robot comes to the end of what it executes."""
        self.step()
        self.end(outcome, **changes)
        self.step()

    @property
    def told(self):
        return teaching_state(self.state, self.view, self.settings)

    @property
    def places(self):
        return [waypoint.position[0] for waypoint in self.told.waypoints]


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
    assert (plan.origin, len(plan.waypoints), plan.start, plan.duration) == (Origin.WAYPOINTS, 3, POSE, 10.0)
    assert site.state.prediction.origin is Origin.WAYPOINTS
    assert site.names().count("cmd/execute") == 0
    assert "model/add_demonstration" not in before | set(site.names())
    assert site.told.recommended == "execute"
    assert "3 waypoints" in site.told.text


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


def test_a_demonstration_is_learnt_once_its_operator_has_seen_it_and_says_so():
    site = Teaching(Method.DEMONSTRATE)
    site.lead()
    site.finish(REACHED, commanded=shown_way())
    assert site.requests(queries.ADD_DEMONSTRATION) == []
    (plan,) = site.requests(queries.PLAN)
    assert plan.origin is Origin.DEMONSTRATION
    assert site.state.prediction.motion == plan.motion
    assert site.told.recommended == "teach"
    site.press(Action.TEACH, Phase.LEARNING)
    site.decide()
    (learnt,) = site.requests(queries.ADD_DEMONSTRATION)
    assert learnt.method is Method.DEMONSTRATE
    np.testing.assert_array_equal(from_wire(learnt.motion.positions), from_wire(plan.motion.positions))


@pytest.mark.parametrize("points", [75, 200, 500])
def test_where_a_demonstration_lingered_it_makes_it_jump_nowhere(points):
    site = Teaching(Method.DEMONSTRATE)
    site.settings = replace(site.settings, points=points)
    site.lead()
    site.finish(REACHED, commanded=shown_way())
    positions = from_wire(site.state.taught.motion.positions)
    steps = np.linalg.norm(np.diff(positions, axis=0), axis=1)
    assert len(positions) == points
    assert np.max(steps) <= np.sum(steps) / (points - 1) * 1.01


def test_its_tempo_is_kept_where_that_matters():
    site = Teaching(Method.DEMONSTRATE)
    site.settings = replace(site.settings, keeps_tempo=True)
    site.lead()
    site.finish(REACHED, commanded=shown_way())
    steps = np.linalg.norm(np.diff(from_wire(site.state.taught.motion.positions), axis=0), axis=1)
    assert np.min(steps) == pytest.approx(0.0, abs=1e-9)


def test_a_demonstration_that_missed_is_learnt_only_where_its_operator_insists():
    site = Teaching(Method.DEMONSTRATE)
    site.lead()
    site.finish(MISSED, commanded=shown_way())
    assert Action.TEACH in site.state.offered
    assert site.told.recommended != "teach"


@pytest.mark.parametrize(
    "ending",
    [
        {"outcome": COLLIDED, "commanded": shown_way()},
        {"outcome": REACHED, "commanded": shown_way(), "cut": Cut.TAKEN_OVER},
        {"outcome": REACHED, "commanded": motion_to_wire([[0.5, 0.0, 0.5]] * 9, [[1.0, 0.0, 0.0, 0.0]] * 9, 9.0)},
    ],
    ids=["touched something", "taken over", "went nowhere"],
)
def test_what_is_no_demonstration_cannot_be_learnt(ending):
    site = Teaching(Method.DEMONSTRATE)
    site.lead()
    site.finish(**ending)
    assert Action.TEACH not in site.state.offered


def test_what_a_stop_cut_short_is_not_learnt():
    site = Teaching(Method.DEMONSTRATE)
    site.lead()
    site.sees(safety=STOPPED)
    site.step()
    assert site.state.phase is Phase.STOPPED
    site.end(REACHED, commanded=shown_way(), completed=False, cut=Cut.STOPPED, reason="emergency stop")
    site.step()
    assert site.state.taught is None


@pytest.mark.parametrize(("method", "led"), [(Method.WAYPOINTS, False), (Method.DEMONSTRATE, True)])
def test_an_empty_model_learns_its_first_demonstration(method, led):
    site = Teaching(method, empty=True)
    assert not {Action.EXECUTE, Action.REFINE, Action.NEXT} & site.state.offered
    assert site.told.recommended == "lead"
    site.lead()
    if not led:
        site.store(0.5, 0.6, 0.7)
    site.finish(REACHED, commanded=shown_way())
    if not led:
        assert Action.EXECUTE in site.state.offered
        site.press(Action.EXECUTE, Phase.EXECUTING)
        site.executed(REACHED)
    else:
        site.press(Action.TEACH, Phase.LEARNING)
    site.decide()
    assert site.requests(queries.ADD_DEMONSTRATION)[0].purpose is Purpose.INITIAL
    assert site.requests(queries.PREDICT) == []


def test_an_empty_model_is_taught_by_a_method_that_can_be_used_and_whoever_teaches_is_told_why():
    site = Teaching(Method.REFINE, empty=True)
    assert site.told.method is Method.WAYPOINTS
    assert "nothing to correct" in site.told.text
    assert site.told.recommended == "lead"
    site.choose(Method.DEMONSTRATE)
    assert site.told.method is Method.DEMONSTRATE
    assert "nothing to correct" in site.told.text


def test_a_script_waits_for_the_first_demonstrations():
    site = Site(SCRIPTED)
    site.sees(model=EMPTY)
    assert site.stay() == []
    assert site.state.phase is Phase.WAITING


def test_a_refinement_can_go_on_from_the_previous_one():
    site = Teaching(Method.REFINE)
    assert Action.BASIS not in site.state.offered
    site.press(Action.REFINE, Phase.EXECUTING)
    site.executed(MISSED)
    site.decide()
    assert Action.BASIS in site.state.offered
    site.step(Action.BASIS, argument="refinement")
    site.decide()
    assert site.state.prediction.origin is Origin.REFINEMENT, "it is shown"
    site.press(Action.REFINE, Phase.EXECUTING)
    first, second = site.requests(queries.PLAN)
    assert first.motion == second.motion == site.state.approach.previous
    assert site.requests(queries.EXECUTE)[-1].prediction == site.state.prediction.id
    assert site.requests(queries.EXECUTE)[-1].mode is Mode.REFINE


def test_the_prediction_can_be_seen_again_from_the_start_of_the_next_motion():
    site = Teaching(Method.REFINE)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.executed(MISSED)
    site.decide()
    site.at(0.9)
    site.step(Action.BASIS, argument="model")
    site.decide()
    assert site.requests(queries.PREDICT)[-1].start == site.view.scene.start
    assert site.names()[-1] == "model/predict"


def test_a_learnt_refinement_is_no_basis_any_more():
    site = Teaching(Method.REFINE)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.executed(MISSED)
    site.decide()
    site.step(Action.BASIS, argument="refinement")
    site.press(Action.REFINE, Phase.EXECUTING)
    site.executed(REACHED)
    site.decide()
    assert site.told.basis is Origin.MODEL


def test_while_the_hand_leads_there_is_no_pace_to_change():
    site = Teaching(Method.DEMONSTRATE)
    site.lead()
    site.step()
    assert site.state.offered == {Action.FINISH}


def test_while_the_hand_leads_the_words_say_what_to_do_next():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.step()
    assert "3 more to go" in site.told.text
    assert site.told.recommended == "store"
    site.store(0.5, 0.6, 0.7)
    assert "Done" in site.told.text
    assert site.told.recommended == ""
    site.robot(clamped=("reach: 30 mm short",))
    site.step()
    assert "turn back" in site.told.text


def test_a_motion_by_hand_that_waits_goes_on_when_it_is_asked():
    site = Teaching(Method.WAYPOINTS)
    site.lead()
    site.robot(phase=HOLD, waiting=True)
    site.step()
    assert Action.GO_ON in site.state.offered
    site.step(Action.GO_ON)
    assert site.names()[-1] == "cmd/resume"


def test_without_an_answer_it_is_asked_again_with_the_same_number():
    site = Teaching(Method.DEMONSTRATE)
    site.fail(queries.TELEOPERATE)
    site.lead()
    first, second = site.requests(queries.TELEOPERATE)
    assert first == second
    assert first.request
