"""The methods of teaching, stepped by hand: a demonstration, a refinement of the previous one."""

from dataclasses import replace

import numpy as np
import pytest

from protocol import queries
from protocol.messages import Cut, Method, Mode, Origin, Purpose
from services.bus.arrays import from_wire, motion_to_wire
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.person import EMPTY, Teaching, shown_way
from tests.services.station.workflow.site import (
    COLLIDED,
    HOLD,
    MISSED,
    REACHED,
    SCRIPTED,
    STOPPED,
    Site,
)


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
    assert site.told.text.endswith("Lead it by hand again, or teach the motion all the same.")


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
