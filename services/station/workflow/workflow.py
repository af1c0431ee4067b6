"""The teaching workflow (thesis, Algorithm 1) as one pure function of state and view.

Look at the object, predict, execute; where that fails, execute again under correction; where that succeeds, learn;
predict again. Every motion, the first reset too, follows a press. After a stop, a take-over, a lost authority, link or
robot the robot stands, and the operator is asked: a motion that waits goes on or is finished, any other begins anew.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace

from services.station.workflow import authority, guiding
from services.station.workflow.asking import to
from services.station.workflow.authority import acquiring, waiting
from services.station.workflow.choosing import choosing
from services.station.workflow.deciding import deciding, finished
from services.station.workflow.episode import executing, looking, predicting, resetting, starting
from services.station.workflow.going import SETTING, set_for_next
from services.station.workflow.history import turning
from services.station.workflow.leading import taking_up
from services.station.workflow.learning import confided, learning
from services.station.workflow.planning import is_previewed, planning
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Workflow
from services.station.workflow.stop import caught, releasing, stopped
from services.station.workflow.verdict import judged
from services.station.workflow.view import Step, View
from services.station.workflow.watching import watching


def advance(state: Workflow, view: View, settings: Settings) -> Step:
    """One step of the workflow; what is not the operator's choice is neither heard nor offered."""
    settled = settings.settled
    step = _advanced(guiding.heard(state, view, settings), view.without(settled), settings)
    return replace(step, state=replace(step.state, offered=step.state.offered - settled)) if settled else step


def _advanced(state: Workflow, view: View, settings: Settings) -> Step:
    """What has happened to it first, then what it does where it stands."""
    if state.phase is Phase.FINISHED and settings.scripted:
        return Step(state)
    known = authority.heard(judged(confided(state, view), view, settings), view, settings)
    moved = caught(known, view) or authority.lost(known, view, settings)
    if moved is not None:
        return Step(moved)
    if known.phase is not state.phase:
        return Step(known)
    if is_previewed(known):
        known = _decided(known, view)
    return _PHASES[known.phase](known, view, settings)


def _decided(state: Workflow, view: View) -> Workflow:
    """A press is not kept waiting by what is about to be shown: that is left, unless the press only sets something."""
    set_ = set_for_next(state, view)
    if not view.actions & state.offered - SETTING:
        return set_
    return to(set_, Phase.DECIDING, view, event=state.event, offered=state.offered)


_PHASES: dict[Phase, Callable[[Workflow, View, Settings], Step]] = {
    Phase.WAITING: waiting,
    Phase.ACQUIRING: acquiring,
    Phase.WATCHING: watching,
    Phase.RESETTING: resetting,
    Phase.LOOKING: looking,
    Phase.PREDICTING: predicting,
    Phase.PLANNING: planning,
    Phase.TAKING_UP: taking_up,
    Phase.STARTING: starting,
    Phase.EXECUTING: executing,
    Phase.LEARNING: learning,
    Phase.TURNING: turning,
    Phase.CHOOSING: choosing,
    Phase.DECIDING: deciding,
    Phase.STOPPED: stopped,
    Phase.RELEASING: releasing,
    Phase.FINISHED: finished,
}
