"""What the operator reads: what is so, what to do, and no names of processes."""

from dataclasses import replace

import msgspec
import pytest

from protocol.messages import Light, Mode, Outcome, Part, RobotState, SafetyState, Verdict, Way
from services.station.workflow.closure import Closure
from services.station.workflow.state import Action, Episode, Phase, Taught, Workflow
from services.station.workflow.view import View
from services.station.workflow.words import outcome_text, teaching_state
from tests.services.predictions import prediction
from tests.services.station.workflow.site import (
    BY_HAND,
    COLLIDED,
    EXECUTE,
    HOLD,
    IDLE,
    MOTION,
    POSE,
    RAMP,
    REACHED,
    STOPPED,
    authority,
)

REFINING = Workflow(phase=Phase.EXECUTING, mode=Mode.REFINE, episode=Episode(1, 0, 1))
ALONE = replace(REFINING, mode=Mode.AUTONOMOUS)
TAUGHT = Taught(MOTION, (0.8, 0.0, 0.6))
HARDLY_KNOWN = msgspec.structs.replace(prediction(MOTION), known=0.2, way=Way(1, 2, 0.8))
HIT = Verdict(reached=False, kicked_over=False, collision=True)


def robot(phase, **changes):
    return msgspec.structs.replace(RobotState(measured=POSE, reference=POSE, phase=phase), **changes)


def told(state, **seen):
    teaching = teaching_state(state, View(now_s=1.0, number=1, **seen), BY_HAND)
    return teaching.light, teaching.text


@pytest.mark.parametrize(
    ("state", "seen", "light", "text"),
    [
        (REFINING, {"robot": robot(EXECUTE)}, Light.GREEN, "Correct the motion now."),
        (REFINING, {"robot": robot(RAMP)}, Light.AMBER, "Wait: the robot goes to where the motion goes on."),
        (REFINING, {"robot": robot(IDLE)}, Light.AMBER, "The motion has ended."),
        (REFINING, {"robot": None}, Light.AMBER, "The robot is not heard."),
        (
            replace(REFINING, let_go=True),
            {"robot": robot(EXECUTE)},
            Light.AMBER,
            "Let go of the keys: they count from then on.",
        ),
        (ALONE, {"robot": robot(EXECUTE)}, Light.RED, "The robot executes the prediction. Watch."),
        (ALONE, {"robot": robot(RAMP)}, Light.RED, "Wait: the robot goes to where the motion goes on."),
        (Workflow(phase=Phase.DECIDING), {}, Light.GREEN, "Ready. Press Execute."),
        (Workflow(phase=Phase.DECIDING, last=REACHED), {}, Light.GREEN, "The target was reached. What next?"),
        (
            Workflow(phase=Phase.DECIDING, last=REACHED, taught=TAUGHT),
            {},
            Light.GREEN,
            "The target was reached. Teach this, or discard it by going on.",
        ),
        (Workflow(phase=Phase.DECIDING, taught=TAUGHT), {}, Light.GREEN, "Teach this, or discard it by going on."),
        (
            Workflow(phase=Phase.DECIDING, last=COLLIDED, taught=replace(TAUGHT, part=Part(0.0, 0.5), whole=False)),
            {},
            Light.GREEN,
            "The robot collided, the target was not reached. Teach what you showed before, or discard it by going on.",
        ),
        (
            Workflow(phase=Phase.DECIDING, warned=True, prediction=HARDLY_KNOWN),
            {},
            Light.GREEN,
            "I don't know this place (20 % known, way 2 of 2, 80 %): show me the motion.",
        ),
        (
            replace(ALONE, prediction=HARDLY_KNOWN),
            {"robot": robot(EXECUTE)},
            Light.RED,
            "The robot executes the prediction (way 2 of 2, 80 %). Watch.",
        ),
        (Workflow(phase=Phase.LEARNING), {}, Light.AMBER, "The model learns from the correction."),
        (Workflow(phase=Phase.FINISHED, reason="ended by hand"), {}, Light.AMBER, "Ended: ended by hand."),
        (
            Workflow(phase=Phase.FINISHED, closure=Closure(closed=True)),
            {},
            Light.AMBER,
            "Finished: the model has learnt from the correction.",
        ),
        (
            Workflow(phase=Phase.WATCHING),
            {"authority": authority("b", 1, "bob")},
            Light.AMBER,
            "bob commands the robot. Ask, or take over.",
        ),
        (
            Workflow(phase=Phase.WATCHING),
            {"authority": authority("", 1)},
            Light.AMBER,
            "Nobody commands the robot. Ask to.",
        ),
    ],
)
def test_light_and_text(state, seen, light, text):
    assert told(state, **seen) == (light, text)


@pytest.mark.parametrize("state", [REFINING, ALONE])
def test_a_held_robot_has_a_light_of_its_own_and_never_green(state):
    light, text = told(state, robot=robot(HOLD, hold_reason="no hand is at the operator's keys"))
    assert light is Light.HOLD
    assert text == "The robot holds. (no hand is at the operator's keys)"


def test_a_robot_that_waits_says_what_to_press_and_what_keeps_it():
    _, text = told(ALONE, robot=robot(HOLD, waiting=True, hold_reason="nobody holds the authority"))
    assert text == "The robot waits: press Go on, or Finish. (nobody holds the authority)"
    _, text = told(ALONE, robot=robot(HOLD, waiting=True))
    assert text == "The robot waits: press Go on, or Finish."


def test_after_a_collision_nobody_is_asked_to_correct():
    light, text = told(REFINING, robot=robot(EXECUTE), verdict=HIT)
    assert light is Light.AMBER
    assert "Correct" not in text
    assert "touched" in text


def test_a_stop_that_is_not_confirmed_is_said_before_everything():
    assert told(REFINING, robot=robot(EXECUTE), stopping=True) == (Light.RED, "STOP sent, not confirmed yet.")


def test_a_latched_stop_says_who_why_and_when():
    light, text = told(REFINING, safety=STOPPED)
    assert light is Light.RED
    assert text == "Emergency stop by bob (it burns): release it to go on."
    _, text = told(REFINING, safety=SafetyState(emergency_stop=True))
    assert text == "Emergency stop by somebody: release it to go on."


def test_a_latched_stop_whose_robot_still_moves_says_so():
    _, text = told(REFINING, safety=STOPPED, stopping=True)
    assert "not known to stand still" in text


def test_what_happened_and_what_does_not_work_stand_behind_what_is():
    state = Workflow(phase=Phase.LEARNING, event="It happened.", notice="It does not work.")
    assert told(state)[1] == "The model learns from the correction. It happened. It does not work."


def test_the_state_tells_counts_offers_and_the_end():
    state = Workflow(
        phase=Phase.FINISHED,
        refinements=2,
        learnt=(4, 5, 8),
        reason="so",
        offered=frozenset({Action.REFINE, Action.EXECUTE}),
    )
    teaching = teaching_state(state, View(now_s=1.0, number=1), BY_HAND)
    assert (teaching.phase, teaching.finished, teaching.loop_closed, teaching.reason) == ("finished", True, False, "so")
    assert (teaching.refinements, teaching.refinements_allowed) == (2, BY_HAND.refinements_allowed)
    assert (teaching.updates, teaching.updates_allowed) == (3, BY_HAND.updates_allowed)
    assert teaching.actions == ("execute", "refine")
    assert teaching.recommended == ""


@pytest.mark.parametrize(
    ("state", "action"),
    [
        (Workflow(), "execute"),
        (Workflow(warned=True), "refine"),
        (Workflow(last=COLLIDED), "refine"),
        (Workflow(last=REACHED), "next"),
        (Workflow(last=REACHED, taught=TAUGHT), "teach"),
        (Workflow(last=COLLIDED, taught=replace(TAUGHT, part=Part(0.0, 0.5), whole=False)), "refine"),
    ],
)
def test_what_is_recommended_is_told_while_there_is_a_choice(state, action):
    asked = replace(state, phase=Phase.DECIDING, offered=frozenset({Action.EXECUTE, Action.REFINE}))
    assert teaching_state(asked, View(now_s=1.0, number=1), BY_HAND).recommended == action
    assert teaching_state(replace(asked, offered=frozenset()), View(now_s=1.0, number=1), BY_HAND).recommended == ""


@pytest.mark.parametrize("phase", Phase)
def test_every_phase_has_words(phase):
    assert told(Workflow(phase=phase))[1] != ""


@pytest.mark.parametrize(
    ("outcome", "text"),
    [
        (REACHED, "The target was reached."),
        (COLLIDED, "The robot collided, the target was not reached."),
        (Outcome(reached=True, kicked_over=True, collision=False), "The object was kicked over."),
    ],
)
def test_a_verdict_as_a_sentence(outcome, text):
    assert outcome_text(outcome) == text


def test_a_stopped_robot_that_is_not_heard_is_not_said_to_be_released():
    _, unheard = told(Workflow(phase=Phase.STOPPED))
    assert unheard == "The robot was stopped, and is not heard now."
    _, released = told(Workflow(phase=Phase.STOPPED), safety=SafetyState(emergency_stop=False))
    assert released == "The emergency stop is not latched any more."
