"""Where another station commands: this one's operator asks for the authority, or takes it over and says why."""

from __future__ import annotations

from dataclasses import replace

from protocol.messages import AuthorityEvent
from services.station.words.table import say
from services.station.workflow.action import Action
from services.station.workflow.asking import to
from services.station.workflow.authority import another, passed
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Workflow
from services.station.workflow.view import Step, View


def watching(state: Workflow, view: View, settings: Settings) -> Step:
    """Another station commands, or nobody does: this one gets the authority when its operator says so, not by itself.

    Who is asked answers, or gives it by silence; the request is said on while the operator is present.
    """
    if settings.scripted:
        return _by_script(state, view)
    authority, taker = view.authority, another(view, settings)
    if authority is not None and state.asks and authority.kept_from == state.asks:
        return Step(replace(state, asks=0, notice=say("event.keeps", who=taker or say("event.whoever"))))
    offered = frozenset({Action.TAKE_OVER} if state.asks else {Action.ASK, Action.TAKE_OVER})
    if not view.present:  # what would be pressed now would not count
        return Step(replace(state, offered=frozenset()))
    return Step(_wanted(state, view, taker) or replace(state, offered=offered))


def _wanted(state: Workflow, view: View, taker: str) -> Workflow | None:
    """What comes of what the operator asks for; None where nothing does yet."""
    if Action.TAKE_OVER in view.actions:
        why = view.argument(Action.TAKE_OVER)
        return to(state, Phase.ACQUIRING, view, wants=Action.TAKE_OVER, why=why)
    if taker:
        return replace(state, asks=view.number, notice="") if Action.ASK in view.actions else None
    free = state.asks and view.authority is not None
    return to(state, Phase.ACQUIRING, view, wants=Action.ASK) if free or Action.ASK in view.actions else None


def _by_script(state: Workflow, view: View) -> Step:
    """A script asks again once nobody commands, unless somebody did not want it to."""
    authority = view.authority
    if authority is None or authority.holder or view.now_s < state.retry_s:
        return Step(state)
    if authority.event is AuthorityEvent.REVOKED:
        return Step(to(state, Phase.FINISHED, view, reason=passed(authority)))
    return Step(to(state, Phase.ACQUIRING, view, wants=Action.ASK))
