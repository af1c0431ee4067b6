"""Under the emergency stop: the run stands until somebody has released it, wherever; then the operator is asked."""

from __future__ import annotations

from dataclasses import replace

from protocol import queries
from protocol.messages import SafetyState
from services.station.words.table import say
from services.station.workflow.action import Action
from services.station.workflow.asking import ask, not_done, to
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Workflow
from services.station.workflow.view import Step, View

RELEASED_S = 2.0
"""Within this time the robot's own state shows that the stop was released."""

_UNDER = frozenset({Phase.STOPPED, Phase.RELEASING})


def caught(state: Workflow, view: View) -> Workflow | None:
    """The state under a stop that was pressed or latched; None where there is none, or it stands there already.

    What the stop cut short is not learnt, whatever it looked like; what the model was already told is, and the part of
    a refinement before it failed where the operator says so afterwards.
    """
    if state.phase in _UNDER and not (state.phase is Phase.RELEASING and view.stopping):
        return None
    if not (view.latched or view.stopping):
        return None
    told = bool(state.intent) if state.phase is Phase.LEARNING else state.owed is not None
    kept = state.taught is not None and (told or not state.taught.whole)
    taught = state.taught if kept else None
    return to(state, Phase.STOPPED, view, pressed=False, taught=taught, event="", unanswered=None)


def stopped(state: Workflow, view: View, settings: Settings) -> Step:
    """Stand; a person releases, a script ends."""
    if settings.scripted and view.latched and view.safety is not None:
        reason = say("event.script_stopped", who=view.safety.by or say("stop.somebody"))
        return Step(to(state, Phase.FINISHED, view, reason="" if state.closure.closed else reason))
    if view.safety is not None and not view.latched and not view.stopping:
        return Step(_released(state, view, view.safety))
    if Action.RELEASE_STOP in view.actions and view.latched:
        return Step(to(state, Phase.RELEASING, view))
    return Step(replace(state, offered=frozenset({Action.RELEASE_STOP}) if view.latched else frozenset()))


def releasing(state: Workflow, view: View, settings: Settings) -> Step:
    """Ask the robot, once: what was pressed for this stop must not release another one, later."""
    if view.safety is not None and not view.latched:
        return Step(_released(state, view, view.safety))
    reply = ask(
        state, view, queries.RELEASE_STOP, lambda intent: queries.ReleaseStop(settings.operator, request=intent)
    )
    if isinstance(reply, queries.Refused):
        return Step(to(state, Phase.STOPPED, view, notice=not_done(queries.RELEASE_STOP, reply.reason)))
    if isinstance(reply, Step):
        failed = state.question and not reply.state.question
        return Step(to(state, Phase.STOPPED, view, notice=reply.state.notice)) if failed else reply
    # Accepted; where it stays latched all the same, somebody has stopped the robot again.
    again = view.now_s - state.since_s > RELEASED_S
    return Step(to(state, Phase.STOPPED, view) if again else state)


def _released(state: Workflow, view: View, safety: SafetyState) -> Workflow:
    """After a stop nothing moves by itself, and a new authority is needed."""
    event = say("event.released", who=safety.released_by or say("stop.somebody"))
    return to(replace(state, holding=False, last=None), Phase.WAITING, view, event=event)
