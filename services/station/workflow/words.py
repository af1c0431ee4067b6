"""The workflow in words and light, for the operator."""

from __future__ import annotations

from protocol.messages import Light, Mode, Outcome, RobotState, TeachingState
from services.station.workflow.state import Phase, Settings, View, Workflow

_TEXTS = {
    Phase.WAITING: "Starting.",
    Phase.ACQUIRING: "Asking for the authority to command the robot.",
    Phase.RESETTING: "The robot returns to its start.",
    Phase.LOOKING: "Looking for the target.",
    Phase.PREDICTING: "The model predicts a motion.",
    Phase.STARTING: "The robot is told the motion.",
    Phase.LEARNING: "The model learns from the correction.",
    Phase.UNDOING: "The model takes its newest update back.",
    Phase.RELEASING: "Releasing the emergency stop.",
}


def teaching_state(state: Workflow, view: View, settings: Settings) -> TeachingState:
    """What the page shows of the workflow."""
    stopped = view.safety is not None and view.safety.emergency_stop
    text = (
        f"Emergency stop by {view.safety.by}: release it to go on." if stopped and view.safety else _text(state, view)
    )
    return TeachingState(
        phase=state.phase.value,
        text=f"{text} {state.notice}".strip(),
        light=Light.RED if stopped else _light(state),
        refinements=state.refinements,
        refinements_allowed=settings.refinements_allowed,
        updates=state.updates,
        updates_allowed=settings.updates_allowed,
        attempts=state.attempts,
        finished=state.phase is Phase.FINISHED,
        loop_closed=state.loop_closed,
        reason=state.reason,
        actions=tuple(sorted(action.value for action in state.offered)),
    )


def _light(state: Workflow) -> Light:
    if state.phase is Phase.DECIDING or (state.phase is Phase.EXECUTING and state.mode is Mode.REFINE):
        return Light.GREEN
    return Light.RED if state.phase is Phase.EXECUTING else Light.AMBER


def _text(state: Workflow, view: View) -> str:
    if state.phase is Phase.EXECUTING:
        return _executing(state.mode, view.robot)
    if state.phase is Phase.DECIDING:
        return f"{outcome_text(state.last)} What next?" if state.last else "Ready."
    if state.phase is Phase.FINISHED:
        return "Finished: the model has learnt from the correction." if state.loop_closed else f"Ended: {state.reason}."
    return _TEXTS[state.phase]


def _executing(mode: Mode, robot: RobotState | None) -> str:
    hold = f" Holding: {robot.hold_reason}." if robot is not None and robot.hold_reason else ""
    if mode is Mode.REFINE:
        return f"Correct the motion now.{hold}"
    return f"The robot executes the prediction. Watch.{hold}"


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
