"""What the operator showed becomes a motion to see and to execute: through waypoints, or as it was led."""

from __future__ import annotations

from protocol import queries
from protocol.messages import Motion, Origin
from protocol.queries import Plan
from services.station.workflow.asking import ask, not_done, to
from services.station.workflow.episode import ORIGIN
from services.station.workflow.state import Phase, Settings, Workflow
from services.station.workflow.view import Step, View


def preview(state: Workflow, view: View, origin: Origin) -> Workflow:
    """Show the motion of an origin; nothing moves."""
    phase = Phase.PREDICTING if origin is Origin.MODEL else Phase.PLANNING
    return to(state, phase, view, origin=origin, pressed=False, refusals=0, event=state.event, taught=state.taught)


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
            return Step(to(state, Phase.DECIDING, view, pressed=False, event=event))
        case _:
            onward = Phase.STARTING if state.pressed else Phase.DECIDING
            return Step(to(state, onward, view, prediction=reply.prediction, event=state.event))


def _plan(state: Workflow, view: View, settings: Settings) -> Plan:
    scene = view.scene
    through = state.origin is Origin.WAYPOINTS
    return Plan(
        state.origin,
        state.looked or ORIGIN,
        scene.name if scene is not None else "",
        settings.duration_s(state.mode),
        start=scene.start if scene is not None and through else None,
        waypoints=state.approach.waypoints if through else (),
        motion=_motion(state),
    )


def _motion(state: Workflow) -> Motion | None:
    if state.origin is Origin.REFINEMENT:
        return state.approach.previous
    return state.taught.motion if state.taught is not None and state.origin is Origin.DEMONSTRATION else None
