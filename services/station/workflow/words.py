"""The workflow in words and light, for the operator."""

from __future__ import annotations

import math

from protocol.messages import Light, Mode, Outcome, RobotState, SafetyState, TeachingState
from protocol.messages import Phase as RobotPhase
from services.bus.predictions import certainty, way_taken
from services.station.workflow.authority import another, missing
from services.station.workflow.deciding import recommended
from services.station.workflow.going import elsewhere, paused
from services.station.workflow.learning import confidence
from services.station.workflow.state import Action, Phase, Settings, Workflow
from services.station.workflow.view import View

_TEXTS = {
    Phase.ACQUIRING: "Asking the robot for the authority to command it.",
    Phase.RESETTING: "The robot returns to its start.",
    Phase.LOOKING: "Looking for the target.",
    Phase.PREDICTING: "The model predicts a motion.",
    Phase.STARTING: "The robot is told the motion.",
    Phase.LEARNING: "The model learns from the correction.",
    Phase.TURNING: "The model changes what it is made of.",
    Phase.RELEASING: "Releasing the emergency stop.",
}


def teaching_state(state: Workflow, view: View, settings: Settings) -> TeachingState:
    """What the page shows of the workflow."""
    stop = _stop(view)
    light, text = (Light.RED, stop) if stop else (_light(state, view), _text(state, view, settings))
    return TeachingState(
        phase=state.phase.value,
        text=" ".join(part for part in (text, state.event, state.notice) if part),
        light=light,
        refinements=state.refinements,
        refinements_allowed=settings.refinements_allowed,
        updates=state.updates,
        updates_allowed=settings.updates_allowed,
        attempts=state.attempts,
        finished=state.phase is Phase.FINISHED,
        loop_closed=state.closure.closed,
        reason=state.reason,
        actions=tuple(sorted(action.value for action in state.offered)),
        recommended=recommended(state, settings).value if state.phase is Phase.DECIDING and state.offered else "",
        pace=state.pace,
        part=state.episode.part if state.episode is not None else state.part,
        confidence=confidence(state, settings),
    )


def _stop(view: View) -> str:
    """What is known of a stop; empty where there is none."""
    safety = view.safety
    if safety is not None and safety.emergency_stop:
        stopped = f"Emergency stop by {_who(safety)}: release it to go on."
        return f"{stopped} The robot is not known to stand still yet." if view.stopping else stopped
    return "STOP sent, not confirmed yet." if view.stopping else ""


def _who(safety: SafetyState) -> str:
    """Who stopped, and why; when, the page's stop says, by the clock of whoever reads it."""
    return f"{safety.by or 'somebody'} ({safety.reason})" if safety.reason else safety.by or "somebody"


def _light(state: Workflow, view: View) -> Light:
    if state.phase is Phase.DECIDING:
        return Light.GREEN
    if state.phase is not Phase.EXECUTING:
        return Light.AMBER
    if view.robot is not None and (view.robot.phase is RobotPhase.HOLD or paused(view)):
        return Light.HOLD
    if state.mode is Mode.AUTONOMOUS:
        return Light.RED
    return Light.GREEN if _may_correct(state, view) else Light.AMBER


def _may_correct(state: Workflow, view: View) -> bool:
    under_way = view.robot is not None and view.robot.phase is RobotPhase.EXECUTE
    return under_way and not state.let_go and not _collided(view) and not elsewhere(view)


def _text(state: Workflow, view: View, settings: Settings) -> str:
    match state.phase:
        case Phase.WAITING | Phase.WATCHING:
            return _without(state, view, another(view, settings))
        case Phase.STOPPED:
            return _stopped(view)
        case Phase.EXECUTING:
            return _executing(state, view)
        case Phase.DECIDING:
            return _deciding(state)
        case Phase.FINISHED:
            return _finished(state)
        case phase:
            return _TEXTS[phase]


def _without(state: Workflow, view: View, taker: str) -> str:
    """Without the authority: what is waited for, or who has it and what can be done."""
    if state.phase is Phase.WAITING:
        return missing(view) or (f"{taker} commands the robot." if taker else "")
    authority = view.authority
    if authority is not None and state.asks and authority.asked == state.asks:
        return f"{taker} is asked for the robot, and gives it by silence in {math.ceil(authority.asked_left)} s."
    return f"{taker} commands the robot. Ask, or take over." if taker else "Nobody commands the robot. Ask to."


def _stopped(view: View) -> str:
    """Where no stop is seen: it was released in this moment, or the robot says nothing of it."""
    released = "The emergency stop is not latched any more."
    return released if view.safety is not None else "The robot was stopped, and is not heard now."


def _finished(state: Workflow) -> str:
    learnt = "Finished: the model has learnt from the correction."
    ended = learnt if state.closure.closed else f"Ended: {state.reason}."
    return f"{ended} Press Next object to begin again." if Action.NEXT in state.offered else ended


def _deciding(state: Workflow) -> str:
    if state.taught is not None:
        shown = "this" if state.taught.whole else "what you showed before"
        outcome = f"{outcome_text(state.last)} " if state.last else ""
        return f"{outcome}Teach {shown}, or discard it by going on."
    if state.last:
        return f"{outcome_text(state.last)} What next?"
    if state.warned and state.prediction is not None:
        return f"I don't know this place ({certainty(state.prediction)}): show me the motion."
    return "Ready. Press Execute."


def _executing(state: Workflow, view: View) -> str:
    robot = view.robot
    if robot is None:
        return "The robot is not heard."
    if robot.phase is RobotPhase.HOLD:
        return _holding(robot)
    if robot.phase is not RobotPhase.EXECUTE:
        ramps = robot.phase is RobotPhase.RAMP
        return "Wait: the robot goes to where the motion goes on." if ramps else "The motion has ended."
    if paused(view):
        return "Paused. Play goes on, a step goes back or on."
    return _watching(state) if state.mode is Mode.AUTONOMOUS else _correcting(state, view)


def _watching(state: Workflow) -> str:
    way = way_taken(state.prediction.way) if state.prediction is not None else ""
    return f"The robot executes the prediction{f' ({way})' if way else ''}. Watch."


def _correcting(state: Workflow, view: View) -> str:
    if _collided(view):
        return "The robot has touched something: this attempt has failed. Finish it, or let it end."
    if elsewhere(view):
        return elsewhere(view)
    return "Let go of the keys: they count from then on." if state.let_go else "Correct the motion now."


def _holding(robot: RobotState) -> str:
    """Whether it goes on by itself, and what keeps it."""
    holds = "The robot waits: press Go on, or Finish." if robot.waiting else "The robot holds."
    return f"{holds} ({robot.hold_reason})" if robot.hold_reason else holds


def _collided(view: View) -> bool:
    return view.verdict is not None and view.verdict.collision


def outcome_text(outcome: Outcome) -> str:
    """A verdict as a sentence."""
    if outcome.success:
        return "The target was reached."
    faults = [
        fault
        for fault, happened in (
            ("the robot collided", outcome.collision),
            ("the object was kicked over", outcome.kicked_over),
            ("the target was not reached", not outcome.reached),
        )
        if happened
    ]
    sentence = ", ".join(faults)
    return f"{sentence[0].upper()}{sentence[1:]}."
