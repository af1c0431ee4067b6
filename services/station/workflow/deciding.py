"""The robot stands, and the operator says what is next; a script takes what is recommended."""

from __future__ import annotations

from dataclasses import replace

from protocol.messages import Mode
from services.station.words.table import say
from services.station.workflow.asking import to
from services.station.workflow.closure import Closure
from services.station.workflow.episode import press
from services.station.workflow.going import SETTING, set_for_next
from services.station.workflow.history import turn, turns
from services.station.workflow.state import WHOLE, Action, Phase, Settings, Workflow
from services.station.workflow.view import Step, View


def deciding(state: Workflow, view: View, settings: Settings) -> Step:
    """Wait for a press; what the model was told and has not answered comes first."""
    if state.owed is not None:
        return Step(to(state, state.owed.phase, view, intent=state.owed.intent, owed=None))
    state = set_for_next(state, view)
    offered = {Action.EXECUTE, Action.REFINE, Action.NEXT, Action.END} | SETTING | turns(view)
    if state.taught is not None:
        offered.add(Action.TEACH)
    pressed = [action for action in Action if action in view.actions & offered - SETTING]
    chosen = recommended(state, settings) if settings.scripted else next(iter(pressed), None)
    if chosen is None:
        return Step(replace(state, offered=frozenset(offered)))
    return _take(state, view, settings, chosen)


def _take(state: Workflow, view: View, settings: Settings, chosen: Action) -> Step:
    match chosen:
        case Action.EXECUTE:
            return Step(press(state, view, Mode.AUTONOMOUS))
        case Action.REFINE:
            return _refine(state, view, settings)
        case Action.TEACH:
            return Step(to(state, Phase.LEARNING, view))
        case Action.NEXT:
            return Step(press(_elsewhere(state), view, Mode.AUTONOMOUS))
        case Action.UNDO | Action.TAKE_BACK | Action.USE_AGAIN:
            return turn(state, view, chosen)
        case _:
            return _end(state, view, say("event.ended_before"))


def finished(state: Workflow, view: View, settings: Settings) -> Step:
    """A person's run is over: s/he may begin another one, with another place. A script's stays over."""
    del settings
    if Action.NEXT not in view.actions:
        return Step(replace(state, offered=frozenset({Action.NEXT})))
    fresh = replace(_elsewhere(state), reason="", closure=Closure())
    return Step(to(fresh, Phase.WAITING, view, holding=False, taught=None, event=""))


def _elsewhere(state: Workflow) -> Workflow:
    return replace(state, placed=None, part=WHOLE, last=None, refinements=0, learnt=(), warned=False)


def recommended(state: Workflow, settings: Settings) -> Action:
    """What brings the run on, by the verdict of the newest episode at this place, and by what is known there.

    A part of a failed refinement is learnt where a person says so, and is never what is recommended.
    """
    if state.taught is not None and state.taught.whole:
        return Action.TEACH
    if state.last is None:
        return Action.REFINE if state.warned else Action.EXECUTE
    if not state.last.success:
        return Action.REFINE
    return Action.END if settings.once else Action.NEXT


def _refine(state: Workflow, view: View, settings: Settings) -> Step:
    if state.refinements >= settings.refinements_allowed:
        return _end(state, view, say("event.no_refinement", count=state.refinements))
    if state.updates >= settings.updates_allowed:
        return _end(state, view, say("event.no_update", count=state.updates))
    return Step(press(state, view, Mode.REFINE))


def _end(state: Workflow, view: View, reason: str) -> Step:
    return Step(to(state, Phase.FINISHED, view, reason="" if state.closure.closed else reason))
