"""What the operator showed becomes a motion to see and to execute: through waypoints, or as it was led."""

from __future__ import annotations

from protocol import queries
from protocol.messages import Motion, Origin, SceneState, Waypoint
from protocol.queries import Plan
from services.station.workflow.action import Action
from services.station.workflow.asking import ask, not_done, to
from services.station.workflow.episode import ORIGIN
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Workflow
from services.station.workflow.view import Step, View


def preview(state: Workflow, view: View, origin: Origin, offered: frozenset[Action] = frozenset()) -> Workflow:
    """Show the motion of an origin; nothing moves.

    Args:
        state: of the workflow.
        view: what is seen.
        origin: of the motion.
        offered: what the operator may do meanwhile all the same, see `is_previewed`.
    """
    phase = Phase.PREDICTING if origin is Origin.MODEL else Phase.PLANNING
    kept = {"event": state.event, "taught": state.taught, "offered": offered}
    return to(state, phase, view, origin=origin, pressed=False, refusals=0, **kept)


def is_previewed(state: Workflow) -> bool:
    """What the operator decides upon is about to be shown, while they may decide: no button goes away for a moment."""
    return state.phase in (Phase.PREDICTING, Phase.PLANNING) and not state.pressed and bool(state.offered)


def planning(state: Workflow, view: View, settings: Settings) -> Step:
    """Have the model process announce the motion; then it is executed, where that was pressed for, or only shown."""
    if state.looked is None and state.pressed:
        return Step(to(state, Phase.LOOKING, view))
    reply = ask(state, view, queries.PLAN, lambda intent: _plan(state, view, settings))
    match reply:
        case Step():
            return reply
        case queries.Refused(reason):
            # Another time is no better: what was shown has to be another.
            event = f"{state.event} {not_done(queries.PLAN, reason)}".strip()
            return Step(to(state, Phase.DECIDING, view, pressed=False, event=event, offered=state.offered))
        case _:
            onward = Phase.STARTING if state.pressed else Phase.DECIDING
            shown = {"prediction": reply.prediction, "event": state.event}
            return Step(to(state, onward, view, **shown, offered=frozenset() if state.pressed else state.offered))


def _plan(state: Workflow, view: View, settings: Settings) -> Plan:
    scene = view.scene
    through = state.origin is Origin.WAYPOINTS
    return Plan(
        state.origin,
        state.looked or ORIGIN,
        scene.name if scene is not None else "",
        settings.duration_s(state.mode),
        start=_start(scene) if scene is not None and through else None,
        waypoints=state.approach.waypoints if through else (),
        motion=_motion(state),
    )


def _start(scene: SceneState) -> Waypoint:
    """Where motions start, with the gripper wide open where it takes part."""
    return Waypoint(scene.start.position, scene.start.orientation, scene.wide_open or None)


def _motion(state: Workflow) -> Motion | None:
    if state.origin is Origin.REFINEMENT:
        return state.approach.previous
    return state.approach.shown if state.origin is Origin.DEMONSTRATION else None
