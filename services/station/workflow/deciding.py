"""The robot stands, and the operator says what is next; a script takes what is recommended."""

from __future__ import annotations

from dataclasses import replace

from protocol.messages import Method, Mode, Origin
from services.station.words.table import say
from services.station.workflow import editing, guiding
from services.station.workflow.action import Action
from services.station.workflow.approach import Approach
from services.station.workflow.asking import to
from services.station.workflow.choosing import choices, choose
from services.station.workflow.closure import Closure
from services.station.workflow.editing import EDITING
from services.station.workflow.episode import is_seen, look, press
from services.station.workflow.going import SETTING, set_for_next
from services.station.workflow.history import turn, turns
from services.station.workflow.leading import lead
from services.station.workflow.planning import preview
from services.station.workflow.settings import Settings
from services.station.workflow.state import WHOLE, Phase, Workflow
from services.station.workflow.view import Step, View

_CHOOSING = frozenset({Action.METHOD, Action.BASIS})
"""What says how to teach, and moves nothing."""

_TOWARDS = frozenset({Action.EXECUTE, Action.REFINE, Action.BASIS, Action.LEAD})
"""What leads to a target: one that is not seen is looked for first."""


def deciding(state: Workflow, view: View, settings: Settings) -> Step:
    """Wait for a press; what the model was told and has not answered comes first."""
    if state.owed is not None:
        return Step(to(state, state.owed.phase, view, intent=state.owed.intent, owed=None))
    unseen = state.unseen and not is_seen(state, view)
    state = set_for_next(replace(state, approach=_usable(state, settings), unseen=unseen), view)
    offered = _offered(state, view) - settings.settled
    if view.actions & offered & (EDITING | _CHOOSING):
        return Step(_shown(state, view, offered))
    pressed = [action for action in Action if action in view.actions & offered - SETTING]
    chosen = recommended(state, settings) if settings.scripted else next(iter(pressed), None)
    if chosen is None:
        return Step(replace(state, offered=frozenset(offered)))
    return _take(state, view, settings, chosen)


def _usable(state: Workflow, settings: Settings) -> Approach:
    """As far as it is set; an empty model has no motion to correct: it is shown one."""
    approach = state.approach
    if settings.method is not Method.UNKNOWN:
        approach = approach.chosen(settings.method.value)
    if settings.basis:
        approach = approach.based(settings.basis)
    corrects = approach.method is Method.REFINE
    nothing = state.empty or state.guide.open
    return replace(approach, method=Method.WAYPOINTS) if corrects and nothing else approach


def _offered(state: Workflow, view: View) -> frozenset[Action]:
    """What the operator may do, by the method: an empty model is shown its first motion before anything else.

    A model that is not heard for a moment changes nothing: it is not known to be empty, nor to be another one.
    """
    if view.model is None and state.offered:
        return state.offered
    always = {Action.END} | SETTING | turns(view) | choices(view)
    offered = always | (guiding.offered(state, view) if state.guide.open else _taught_by(state, view))
    return frozenset(offered - _TOWARDS | {Action.LOOK}) if is_unseen(state) else frozenset(offered)


def _taught_by(state: Workflow, view: View) -> set[Action]:
    """By the method."""
    approach = state.approach
    offered = {Action.METHOD} | editing.offered(state, view)
    if not state.empty:
        offered |= {Action.EXECUTE, Action.NEXT}
    if approach.method is not Method.REFINE:
        offered.add(Action.LEAD)
    elif not state.empty:
        offered |= {Action.REFINE, Action.BASIS} if approach.previous is not None else {Action.REFINE}
    if approach.replays is not None:
        offered.add(Action.EXECUTE)
    if state.taught is not None:
        offered.add(Action.TEACH)
    return offered


def is_unseen(state: Workflow) -> bool:
    """The target is to be looked for first; a guide that has put it nowhere yet puts it first."""
    return state.unseen and not (state.guide.open and state.placed is None)


def _shown(state: Workflow, view: View, offered: frozenset[Action]) -> Workflow:
    """With another method, basis or waypoints, and what that comes to in the view; nothing moves."""
    state = guiding.edited(editing.heard(state, view), state)
    approach = state.approach
    if Action.METHOD in view.actions:
        approach = approach.chosen(view.argument(Action.METHOD))
    if Action.BASIS in view.actions & offered:
        based = approach.based(view.argument(Action.BASIS))
        return preview(replace(state, approach=based, event=""), view, based.basis, offered)
    state = replace(state, approach=approach, event="")
    return state if approach.replays is None else preview(state, view, approach.replays, offered)


def _take(state: Workflow, view: View, settings: Settings, chosen: Action) -> Step:
    match chosen:
        case Action.EXECUTE:
            taken = press(state, view, Mode.AUTONOMOUS, state.approach.replays or Origin.MODEL)
        case Action.REFINE:
            taken = _refine(state, view, settings)
        case Action.LOOK:
            taken = look(state, view)
        case Action.LEAD:
            taken = _lead(state, view, settings)
        case Action.TEACH:
            taken = to(state, Phase.LEARNING, view)
        case Action.NEXT:
            taken = press(_elsewhere(state), view, Mode.AUTONOMOUS)
        case Action.UNDO | Action.TAKE_BACK | Action.USE_AGAIN:
            return turn(state, view, chosen)
        case Action.PUT | Action.OTHER_PLACE | Action.REPEAT | Action.ENOUGH:
            taken = guiding.take(state, view, chosen)
        case Action.SKILL | Action.NEW_SKILL:
            return choose(state, view, chosen)
        case _:
            taken = _end(state, view, say("event.executed" if settings.executions else "event.ended_before"))
    return Step(taken)


def finished(state: Workflow, view: View, settings: Settings) -> Step:
    """A person's run is over: s/he may begin another one, with another place. A script's stays over."""
    del settings
    if Action.NEXT not in view.actions:
        return Step(replace(state, offered=frozenset({Action.NEXT})))
    fresh = replace(_elsewhere(state), reason="", closure=Closure())
    return Step(to(fresh, Phase.WAITING, view, holding=False, taught=None, event=""))


def _elsewhere(state: Workflow) -> Workflow:
    return replace(
        state,
        placed=None,
        part=WHOLE,
        last=None,
        refinements=0,
        learnt=(),
        warned=False,
        approach=state.approach.elsewhere(),
    )


def recommended(state: Workflow, settings: Settings) -> Action:
    """What brings the run on, by the method, by the verdict of the newest episode here, and by what is known here.

    A part of a failed refinement is learnt where a person says so, and is never what is recommended.
    """
    if is_unseen(state):
        return Action.LOOK
    if settings.executions:
        return _recommended_alone(state, settings)
    if state.guide.open:
        return guiding.recommended(state)
    if state.taught is not None and state.taught.whole:
        return Action.TEACH
    online = state.approach.method is Method.REFINE
    return (_recommended_online if online else _recommended_offline)(state, settings)


def _recommended_alone(state: Workflow, settings: Settings) -> Action:
    """As often as was asked for, each time at another place, whatever comes of it."""
    if state.attempts and state.attempts[-1].number >= settings.executions:
        return Action.END
    return Action.EXECUTE if state.last is None else Action.NEXT


def _recommended_online(state: Workflow, settings: Settings) -> Action:
    """See what the robot does alone, and correct it while it moves."""
    if state.last is None:
        return Action.REFINE if state.warned else Action.EXECUTE
    return _after(settings) if state.last.success else Action.REFINE


def _after(settings: Settings) -> Action:
    if settings.place:
        return Action.EXECUTE
    return Action.END if settings.once else Action.NEXT


def _recommended_offline(state: Workflow, settings: Settings) -> Action:
    """Lead, execute what was stored, and see what was learnt."""
    if state.last is not None:
        return _after(settings) if state.last.success else Action.LEAD
    learnt = state.updates > 0 and not state.approach.waypoints
    return Action.EXECUTE if state.approach.replays is not None or learnt else Action.LEAD


def _lead(state: Workflow, view: View, settings: Settings) -> Workflow:
    """A script leads anew what failed, as often as it may."""
    if not settings.scripted:
        return lead(state, view)
    anew = replace(state, approach=state.approach.cleared())
    if state.guide.open:
        return guiding.led(anew, view)
    if len(state.attempts) >= settings.refinements_allowed:
        return _end(state, view, say("event.no_refinement", count=len(state.attempts)))
    return lead(anew, view)


def _refine(state: Workflow, view: View, settings: Settings) -> Workflow:
    if state.refinements >= settings.refinements_allowed:
        return _end(state, view, say("event.no_refinement", count=state.refinements))
    if state.updates >= settings.updates_allowed:
        return _end(state, view, say("event.no_update", count=state.updates))
    return press(state, view, Mode.REFINE, state.approach.basis)


def _end(state: Workflow, view: View, reason: str) -> Workflow:
    return to(state, Phase.FINISHED, view, reason="" if state.closure.closed else reason)
