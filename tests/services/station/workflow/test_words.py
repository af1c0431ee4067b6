"""What the operator reads: what is so, what to do, and no names of processes."""

from dataclasses import replace

import msgspec
import pytest

from protocol.messages import ExecutionState, Light, Mode, Outcome, Part, RobotState, SafetyState, Unmet, Verdict, Way
from services.robot.hold import ANOTHER_AUTHORITY, TOO_LONG
from services.robot.safety import Watchdog
from services.station.words.table import speech
from services.station.workflow.action import Action
from services.station.workflow.closure import Closure
from services.station.workflow.state import Episode, Phase, Taught, Workflow
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
        (REFINING, {"robot": robot(EXECUTE)}, Light.GREEN, "Steer around it. Space when done."),
        (REFINING, {"robot": robot(RAMP)}, Light.AMBER, "The robot goes to where the motion begins."),
        (REFINING, {"robot": robot(IDLE)}, Light.AMBER, "The motion has ended."),
        (REFINING, {"robot": None}, Light.AMBER, "The robot is not heard."),
        (
            replace(REFINING, let_go=True),
            {"robot": robot(EXECUTE)},
            Light.AMBER,
            "Let go of the keys: they count from then on.",
        ),
        (ALONE, {"robot": robot(EXECUTE)}, Light.RED, "The robot moves alone."),
        (ALONE, {"robot": robot(RAMP)}, Light.RED, "The robot goes to where the motion begins."),
        (Workflow(phase=Phase.DECIDING), {}, Light.GREEN, "Ready. Watch what the robot does alone."),
        (
            Workflow(phase=Phase.DECIDING, last=REACHED),
            {},
            Light.GREEN,
            "Reached, nothing touched. Go on to the next object.",
        ),
        (
            Workflow(phase=Phase.DECIDING, last=REACHED, taught=TAUGHT),
            {},
            Light.GREEN,
            "Reached, nothing touched. Teach it?",
        ),
        (Workflow(phase=Phase.DECIDING, taught=TAUGHT), {}, Light.GREEN, "Teach it?"),
        (
            Workflow(phase=Phase.DECIDING, last=COLLIDED, taught=replace(TAUGHT, part=Part(0.0, 0.5), whole=False)),
            {},
            Light.GREEN,
            "The robot touched something, missed the target. Teach what you showed before that, or correct it again.",
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
            "The robot moves alone (way 2 of 2, 80 %).",
        ),
        (Workflow(phase=Phase.LEARNING), {}, Light.AMBER, "The robot learns what you showed."),
        (Workflow(phase=Phase.FINISHED, reason="ended by hand"), {}, Light.AMBER, "Ended: ended by hand."),
        (
            Workflow(phase=Phase.FINISHED, closure=Closure(closed=True)),
            {},
            Light.AMBER,
            "Finished: the robot has learnt from the correction.",
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


def test_a_run_that_is_over_is_the_operator_s_turn_where_another_one_can_begin():
    over = Workflow(phase=Phase.FINISHED, closure=Closure(closed=True))
    assert told(over)[0] is Light.AMBER
    assert told(replace(over, offered=frozenset({Action.NEXT})))[0] is Light.GREEN


@pytest.mark.parametrize("state", [REFINING, ALONE])
def test_a_held_robot_has_a_light_of_its_own_and_never_green(state):
    light, text = told(state, robot=robot(HOLD, hold_reason="no hand is at the operator's keys or device"))
    assert light is Light.HOLD
    assert text == "No hand is at the keys or the device: click into the page, or take the device up."


def test_a_robot_that_waits_says_what_to_press_and_what_keeps_it():
    because = f"{ANOTHER_AUTHORITY} (nobody holds the authority)"
    _, text = told(ALONE, robot=robot(HOLD, waiting=True, hold_reason=because))
    assert text == "Nobody commanded the robot. Press Go on, or Done."
    _, text = told(ALONE, robot=robot(HOLD, waiting=True))
    assert text == "Press Go on, or Done."


@pytest.mark.parametrize("pace", [1.0, -1.0])
def test_after_a_collision_nobody_is_asked_to_correct_but_to_end_it(pace):
    """It is the operator's turn: the sentence asks for something, and steps back would not help."""
    back = ExecutionState(episode=1, mode=Mode.REFINE, prediction=1, progress=0.5, pace=pace)
    light, text = told(REFINING, robot=robot(EXECUTE), verdict=HIT, execution=back)
    assert light is Light.GREEN
    assert "Correct" not in text
    assert "step back does not change that. Press Done" in text
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


def test_what_happened_and_what_does_not_work_are_told_beside_the_sentence():
    state = Workflow(phase=Phase.LEARNING, event="It happened.", notice="It does not work.")
    teaching = teaching_state(state, View(now_s=1.0, number=1), BY_HAND)
    assert (teaching.text, teaching.event) == (
        "The robot learns what you showed.",
        "It happened. It does not work.",
    )
    assert teaching.told == f"{teaching.text} {teaching.event}"


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
    assert teaching.actions == ("confidence", "execute", "refine")
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
        (REACHED, "Reached, nothing touched."),
        (COLLIDED, "The robot touched something, missed the target."),
        (Outcome(reached=True, kicked_over=True, collision=False), "The robot knocked the object over."),
    ],
)
def test_a_verdict_as_a_sentence(outcome, text):
    assert outcome_text(outcome, View(now_s=1.0, number=1)) == text


def test_a_stopped_robot_that_is_not_heard_is_not_said_to_be_released():
    _, unheard = told(Workflow(phase=Phase.STOPPED))
    assert unheard == "The robot was stopped, and is not heard now."
    _, released = told(Workflow(phase=Phase.STOPPED), safety=SafetyState(emergency_stop=False))
    assert released == "The emergency stop is not latched any more."


def test_a_miss_is_told_in_millimetres_while_it_is_known():
    missed = Verdict(reached=False, kicked_over=False, collision=False, missed=0.0314)
    text = outcome_text(Outcome(reached=False, kicked_over=False, collision=False), View(1.0, 1, verdict=missed))
    assert text == "The robot missed the target by 31 mm."


def test_no_sentence_says_again_what_the_light_says():
    headings = [f"{speech.words[f'light.{light.value}']}{stop}" for light in Light for stop in ":."]
    texts = [words for name, words in speech.words.items() if name.partition(".")[0] in ("workflow", "hold", "showing")]
    assert not [text for text in texts if text.startswith(tuple(headings))]


@pytest.mark.parametrize("waiting", [True, False])
def test_where_a_key_was_down_before_it_counted_nobody_is_told_that_no_hand_is_there(waiting):
    reason = "no hand is at the operator's keys or device"
    held = robot(HOLD, hold_reason=f"{TOO_LONG} ({reason})" if waiting else reason, waiting=waiting)
    _, text = told(replace(REFINING, let_go=True), robot=held)
    assert text.startswith("Keys were down before they counted: let go of all keys.")
    _, text = told(REFINING, robot=held)
    assert text.startswith("No hand")


@pytest.mark.parametrize("waiting", [False, True])
def test_every_reason_of_the_robot_s_to_hold_has_words_for_whoever_stands_at_the_page(waiting):
    watchdog = Watchdog(hold_after_s=0.1, presence_after_s=0.2)
    causes = [
        watchdog.presence("", None),
        watchdog.presence("station", 9.0),
        watchdog.hand(None, engaged=True),
        watchdog.hand(9.0, engaged=True),
        watchdog.hand(0.0, engaged=False),
        watchdog.hand(0.0, engaged=True, way_s=9.0),
    ]
    why = (TOO_LONG, ANOTHER_AUTHORITY) if waiting else ()
    for reason in [*causes, *why, *(f"{waits} ({cause})" for waits in why for cause in causes)]:
        _, text = told(REFINING, robot=robot(HOLD, hold_reason=reason, waiting=waiting))
        assert text[0].isupper()
        assert text.endswith(". Press Go on, or Done.") is waiting
        assert reason not in text
        assert "held for more" not in text


def test_what_else_a_task_asks_for_is_told_where_it_is_not_so():
    fallen = Verdict(
        reached=False, kicked_over=False, collision=False, missed=0.01, unmet=(Unmet.GRASPED, Unmet.LIFTED)
    )
    text = outcome_text(Outcome(reached=False, kicked_over=False, collision=False), View(1.0, 1, verdict=fallen))
    assert text == "The robot did not grasp the object, did not lift it."
