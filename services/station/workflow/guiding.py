"""An empty skill is shown its first motions: a place, a motion there, seen as the robot does it alone, kept or not."""

from __future__ import annotations

from dataclasses import replace

from protocol.messages import Method, Mode, ModelState, Showing, ShowStep
from services.station.words.table import say
from services.station.workflow import editing
from services.station.workflow.action import Action
from services.station.workflow.approach import Approach
from services.station.workflow.asking import to
from services.station.workflow.episode import look
from services.station.workflow.leading import lead
from services.station.workflow.proposals import places
from services.station.workflow.settings import Settings
from services.station.workflow.state import Changed, Phase, Workflow
from services.station.workflow.view import View

TRIES = 2
"""Of a script at a place."""

STALE_S = 3.0
"""For so long a state of the model may come that was true before it was changed."""


def heard(state: Workflow, view: View, settings: Settings) -> Workflow:
    """With what the model says that it holds; one that is not heard for a moment holds what it held."""
    if view.model is None or _is_older(state, view.model, view):
        return state
    return _holding(state, view.model, view, settings)


def told_by(state: Workflow, model: ModelState, view: View, settings: Settings) -> Workflow:
    """With what the model has answered that it holds now; what was kept is shown at another place next."""
    changed = Changed(model.skill, model.version, view.now_s + STALE_S)
    return _holding(replace(state, changed=changed), model, view, settings)


def _is_older(state: Workflow, model: ModelState, view: View) -> bool:
    changed = state.changed
    if changed is None or view.now_s >= changed.until_s:
        return False
    return model.skill != changed.skill or model.version < changed.version


def _holding(state: Workflow, model: ModelState, view: View, settings: Settings) -> Workflow:
    shown_at = places(view.scene) if view.scene is not None and settings.guides else 0
    guide = state.guide.holding(model, shown_at)
    if guide == state.guide:
        return state if model.empty is state.empty else replace(state, empty=model.empty)
    known = replace(state, empty=model.empty, guide=guide)
    if guide.open and not guide.put:
        method = state.approach.method if state.guide.open else Method.WAYPOINTS
        return replace(known, placed=None, last=None, learnt=(), approach=Approach(method))
    return replace(known, approach=Approach()) if state.guide.open and not guide.open else known


def step(state: Workflow) -> ShowStep:
    """What is next at this place, or under way."""
    if state.mode is Mode.TEACH and (state.pressed or state.phase is Phase.EXECUTING):
        return ShowStep.SHOW
    seen_alone = state.taught is not None and state.mode is not Mode.TEACH
    if seen_alone:
        return ShowStep.KEEP
    if state.approach.replays is not None:
        return ShowStep.REPLAY
    return ShowStep.SHOW if state.guide.put else ShowStep.PLACE


def told(state: Workflow, view: View) -> Showing | None:
    """How far it is; None where nothing has to be shown."""
    if not state.guide.open or view.scene is None:
        return None
    return Showing(step(state), state.guide.kept + 1, places(view.scene))


def offered(state: Workflow, view: View) -> frozenset[Action]:
    """What the operator may do beside what is always theirs."""
    edits = editing.offered(state, view)
    by_waypoints = frozenset({Action.LEAD} if state.approach.method is Method.WAYPOINTS else ())
    match step(state):
        case ShowStep.PLACE:
            enough = {Action.ENOUGH} if state.guide.kept else set()
            return frozenset({Action.METHOD, Action.PUT, Action.OTHER_PLACE} | enough)
        case ShowStep.SHOW:
            return frozenset({Action.METHOD, Action.LEAD, Action.OTHER_PLACE}) | edits
        case ShowStep.REPLAY:
            return frozenset({Action.EXECUTE, Action.REPEAT}) | by_waypoints | edits
        case ShowStep.KEEP:
            return frozenset({Action.TEACH, Action.EXECUTE, Action.REPEAT}) | by_waypoints | edits


def recommended(state: Workflow) -> Action:
    """What brings it on: what has failed is shown again."""
    failed = state.last is not None and not state.last.success
    match step(state):
        case ShowStep.PLACE:
            return Action.PUT
        case ShowStep.SHOW:
            return Action.LEAD
        case ShowStep.REPLAY:
            return Action.REPEAT if failed else Action.EXECUTE
        case ShowStep.KEEP:
            return Action.REPEAT if failed else Action.TEACH


def take(state: Workflow, view: View, chosen: Action) -> Workflow:
    """What comes of a press of the guide's."""
    guide = state.guide
    match chosen:
        case Action.PUT:
            return look(replace(state, placed=None), view)
        case Action.OTHER_PLACE:
            passed = replace(guide, passed=guide.passed + 1, put=False, tries=0)
            return look(replace(_shown_anew(state), guide=passed, placed=None), view)
        case Action.REPEAT:
            return _shown_anew(state)
        case _:
            closed = replace(guide, open=False, enough=True)
            return replace(state, guide=closed, approach=Approach(), event="")


def led(state: Workflow, view: View) -> Workflow:
    """A script leads as often as makes sense at a place, then at another one, and gives up where that is none."""
    guide = state.guide
    if guide.tries < TRIES:
        return lead(replace(state, guide=replace(guide, tries=guide.tries + 1)), view)
    if view.scene is not None and guide.passed < len(view.scene.training_places):
        return take(state, view, Action.OTHER_PLACE)
    return to(state, Phase.FINISHED, view, reason=say("event.no_first_motion"))


def edited(state: Workflow, before: Workflow) -> Workflow:
    """What was seen of other waypoints says nothing of these."""
    if state.approach.waypoints == before.approach.waypoints or not state.guide.open:
        return state
    return replace(state, taught=None, last=None)


def _shown_anew(state: Workflow) -> Workflow:
    """As if nothing had been shown at this place."""
    return replace(state, approach=state.approach.cleared(), taught=None, last=None, prediction=None, event="")
