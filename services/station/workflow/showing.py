"""What the operator who shows a motion reads: what to do next, in one sentence."""

from __future__ import annotations

from protocol.messages import Method, Mode, RobotState, ShowStep, Vector3
from services.station.words.table import say
from services.station.workflow.action import Action
from services.station.workflow.editing import lacking
from services.station.workflow.guiding import step
from services.station.workflow.proposals import proposed
from services.station.workflow.state import Workflow
from services.station.workflow.view import View


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


def guided(state: Workflow, view: View) -> str:
    """While an empty skill is shown its first motions and the robot stands."""
    failed = state.last is not None and not state.last.success
    count = len(state.approach.waypoints)
    match step(state):
        case ShowStep.PLACE:
            return _to_put(state, view)
        case ShowStep.SHOW:
            return say("showing.lacking", count=count, missing=lacking(state)) if count else _to_begin(state)
        case ShowStep.REPLAY if failed:
            return say("showing.again")
        case ShowStep.REPLAY:
            return say(
                "showing.through_alone" if state.approach.method is Method.WAYPOINTS else "showing.led", count=count
            )
        case ShowStep.KEEP:
            return say("showing.keep_all_the_same" if failed else "showing.keep")


def _to_put(state: Workflow, view: View) -> str:
    place = proposed(view.scene, state.guide, view.kept_at) if view.scene is not None else None
    order = "next" if state.guide.kept else "first"
    if place is None or place.object_position is None:
        return say(f"showing.{order}")
    return say(f"showing.{order}_place", where=_where(place.object_position))


def _where(position: Vector3) -> str:
    ahead, aside = (round(100.0 * value) for value in position[:2])
    side = f"_{'left' if aside > 0 else 'right'}" if aside else ""
    return say(f"showing.where{side}", ahead=ahead, aside=abs(aside))


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
