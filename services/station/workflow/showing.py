"""What the operator who shows a motion reads: what to do next, in one sentence."""

from __future__ import annotations

from protocol.messages import Method, Mode, RobotState
from services.station.words.table import say
from services.station.workflow.action import Action
from services.station.workflow.editing import lacking
from services.station.workflow.state import Workflow


def deciding(state: Workflow) -> str:
    """While the robot stands; empty where the other words say it."""
    count = len(state.approach.waypoints)
    shown = count == 0 and not state.led and state.updates > 0
    if state.approach.method is Method.REFINE or state.taught is not None or state.last is not None or shown:
        return ""
    if count == 0:
        then = _to_begin(state)
        return say("showing.empty", then=then) if state.empty else then
    return say("showing.lacking" if lacking(state) else "showing.through", count=count, missing=lacking(state))


def _to_begin(state: Workflow) -> str:
    if state.approach.method is Method.DEMONSTRATE:
        return say("showing.to_lead")
    return say("showing.none_stored" if state.led else "showing.to_store")


def leading(state: Workflow, robot: RobotState) -> str:
    """While the hand leads."""
    if state.let_go:
        return say("workflow.let_go")
    if any(name.startswith("reach") for name in robot.clamped):
        return say("showing.reach")
    if state.approach.method is Method.DEMONSTRATE:
        return say("showing.lead")
    count, missing = len(state.approach.waypoints), lacking(state)
    return say("showing.store" if missing else "showing.store_more", count=count, missing=missing)


def first(state: Workflow) -> Action | None:
    """What is to be pressed first while the hand leads; None where nothing is."""
    storing = state.mode is Mode.TEACH and state.approach.method is Method.WAYPOINTS
    return Action.STORE if storing and lacking(state) else None
