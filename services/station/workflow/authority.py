"""The authority to command: waiting for it, getting it, losing it."""

from __future__ import annotations

from dataclasses import replace

from protocol import queries
from protocol.messages import AuthorityEvent, AuthorityState
from services.station.words.table import say
from services.station.workflow import unanswered
from services.station.workflow.action import Action
from services.station.workflow.asking import RETRY_S, ask, not_done, to
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Workflow
from services.station.workflow.view import Step, View

LINGERS_S = 2.0
"""The lease of a station that is no more runs out within this time; one that lasts longer is somebody's."""

CONFIRM_S = 2.0
"""Within this time after the authority was granted the robot's own state shows it."""

TOLD_S = 10.0
"""For so long it is told that the authority was lost, once it is back."""

UNHEARD_S = 1.0
"""A robot that was silent for longer waits for another press: what was asked before it may be wrong by now."""


_WITHOUT = frozenset({Phase.WAITING, Phase.ACQUIRING, Phase.WATCHING, Phase.STOPPED, Phase.RELEASING, Phase.FINISHED})


def missing(view: View, settings: Settings) -> str:
    """What there has to be before the authority is asked for; empty where all is there.

    A person shows an empty model the first motion; a script waits for whoever does, unless that is its part.
    """
    robot = view.robot and view.scene and view.authority
    absent = [say(f"waiting.{name}") for name, there in (("robot", robot), ("model", view.model)) if not there]
    if absent:
        return say("waiting.for", what=say("waiting.also").join(absent))
    if settings.scripted and view.empty and not settings.untaught:
        return say("waiting.demonstrations")
    return "" if view.present else say("waiting.operator")


def waiting(state: Workflow, view: View, settings: Settings) -> Step:
    """For robot, model and operator; the authority is asked for once all are there and nobody has it."""
    state = unanswered.heard(state, view)
    if missing(view, settings):
        return Step(state)
    taker = another(view, settings)
    lingers_until_s = state.retry_s or view.now_s + LINGERS_S
    if state.watches or is_revoked(view) or (taker and (state.epoch or view.now_s >= lingers_until_s)):
        return Step(to(state, Phase.WATCHING, view, watches=True, unanswered=None))
    if taker:
        return Step(replace(state, retry_s=lingers_until_s))
    return Step(to(state, Phase.ACQUIRING, view, offered=state.offered) if view.now_s >= state.retry_s else state)


def acquiring(state: Workflow, view: View, settings: Settings) -> Step:
    """Ask; where the robot waits in an episode of this station's, the operator is asked what becomes of it."""
    state = unanswered.heard(state, view)
    offered = frozenset({Action.TAKE_OVER}) if state.unanswered is None else unanswered.ANSWERS
    if Action.TAKE_OVER in view.actions and state.wants is not Action.TAKE_OVER:
        state = to(state, Phase.ACQUIRING, view, wants=Action.TAKE_OVER, why=view.argument(Action.TAKE_OVER))
    take_over = state.wants is Action.TAKE_OVER
    reply = ask(
        state,
        view,
        queries.ACQUIRE,
        lambda intent: queries.AcquireAuthority(
            settings.holder, settings.operator, take_over, state.why, request=intent
        ),
    )
    match reply:
        case Step(waits, asks):
            return Step(replace(waits, offered=offered), asks)
        case queries.Refused(reason):
            notice = not_done(queries.ACQUIRE, reason)
            if state.wants is not None:
                return Step(to(state, Phase.WATCHING, view, watches=True, notice=notice, retry_s=view.now_s + RETRY_S))
            asked = state.offered & unanswered.ANSWERS
            return Step(to(state, Phase.WAITING, view, notice=notice, retry_s=view.now_s + RETRY_S, offered=asked))
        case _:
            return Step(_granted(state, view, reply.epoch))


def _granted(state: Workflow, view: View, epoch: int) -> Workflow:
    granted = replace(
        state,
        epoch=epoch,
        holding=True,
        confirmed=False,
        granted_s=view.now_s,
        watches=False,
        warned=False,
        unanswered=None,
        event=_joined(say("event.back"), _news(state.event)) if _tells_of_a_loss(state.event) else state.event,
    )
    if _restarted(state, view):
        return to(replace(granted, episode=None, last=None, taught=None), Phase.LOOKING, view, event=gone(state, view))
    if not runs(state, view) or state.episode is None:
        return to(granted, Phase.LOOKING, view)
    number = state.episode.number or (view.robot.episode if view.robot is not None else 0)
    answer = state.unanswered.answer if state.unanswered is not None else None
    asked = state.offered & unanswered.ANSWERS
    return to(
        granted, Phase.EXECUTING, view, episode=replace(state.episode, number=number), wants=answer, offered=asked
    )


def gone(state: Workflow, view: View) -> str:
    """Why nothing comes any more of the episode that the robot was told to run."""
    return say("event.restarted") if _restarted(state, view) else say("event.another_episode")


def _restarted(state: Workflow, view: View) -> bool:
    return view.robot is not None and state.episode is not None and view.robot.publisher != state.episode.robot


def runs(state: Workflow, view: View) -> bool:
    """The robot may still be at the episode that it was told to run, or its result is still to come."""
    episode, robot = state.episode, view.robot
    if episode is None or robot is None:
        return episode is not None
    if robot.publisher != episode.robot:
        return False
    return robot.episode <= episode.number if episode.number else robot.phase.running


def heard(state: Workflow, view: View, settings: Settings) -> Workflow:
    """With what the robot says of itself and of the authority."""
    authority = view.authority
    mine = authority is not None and (authority.holder, authority.epoch) == (settings.holder, state.epoch)
    old = _tells_of_a_loss(state.event) and state.holding and view.now_s - state.granted_s > TOLD_S
    return replace(
        state,
        event=_news(state.event) if old else state.event,
        heard_s=view.now_s if view.robot is not None else state.heard_s,
        confirmed=state.confirmed or (state.holding and mine),
    )


def lost(state: Workflow, view: View, settings: Settings) -> Workflow | None:
    """Where to wait for the authority that was lost; None where it was not."""
    if state.phase in _WITHOUT:
        return None
    reason = _loss(state, view, settings)
    if reason:
        watches = bool(another(view, settings)) or is_revoked(view)
        dropped = replace(state, holding=False, pressed=False, watches=watches)
        if watches:
            return to(dropped, Phase.WATCHING, view, event=reason)
        asked = unanswered.kept(state, view)
        offered = state.offered & unanswered.ANSWERS if asked is not None else frozenset()
        event = _joined(reason, _news(state.event)) if reason == say("event.lost") else reason
        return to(dropped, Phase.WAITING, view, event=event, unanswered=asked, offered=offered)
    if state.pressed and view.now_s - state.heard_s > UNHEARD_S:
        return to(state, Phase.DECIDING, view, pressed=False, event=say("event.unheard"))
    return None


def _tells_of_a_loss(event: str) -> bool:
    return event.startswith((say("event.lost"), say("event.back")))


def _news(event: str) -> str:
    """What was told besides a loss of the authority, which may come and go while it is news."""
    for told in (say("event.back"), say("event.lost")):
        event = event.removeprefix(told).strip()
    return event


def _joined(loss: str, news: str) -> str:
    return f"{loss} {news}".strip()


def _loss(state: Workflow, view: View, settings: Settings) -> str:
    """What the robot said before it granted the lease, of an earlier epoch, does not count; after it, it does."""
    authority = view.authority
    if authority is None:
        return ""
    if authority.epoch < state.epoch:
        if not state.confirmed and view.now_s - state.granted_s <= CONFIRM_S:
            return ""
        return say("event.forgotten")
    taker = another(view, settings)
    if taker or is_revoked(view):
        return passed(authority, taker)
    if view.present and authority.operator not in ("", settings.operator):
        return say("event.input", who=settings.operator)
    return say("event.lost") if authority.epoch > state.epoch or not authority.holder else ""


def is_revoked(view: View) -> bool:
    """Somebody did not want that anybody commands: nobody does without a press."""
    return view.authority is not None and view.authority.event is AuthorityEvent.REVOKED


def passed(authority: AuthorityState, who: str = "") -> str:
    """How the authority went to who has it now: who caused it, and why."""
    why = say("event.why", why=authority.reason) if authority.reason else say("event.no_why")
    match authority.event:
        case AuthorityEvent.TAKEN_OVER:
            return say("event.taken_over", who=who, why=why)
        case AuthorityEvent.REVOKED:
            return say("event.revoked", who=authority.by, why=why)
        case AuthorityEvent.GIVEN:
            return say("event.given", who=who)
        case AuthorityEvent.GIVEN_BY_SILENCE:
            return say("event.given_by_silence", who=who)
        case _:
            return say("event.passed", who=who)


def another(view: View, settings: Settings) -> str:
    """Who else holds the authority; empty where nobody does."""
    authority = view.authority
    if authority is None or authority.holder in ("", settings.holder):
        return ""
    return authority.operator if authority.operator not in ("", settings.operator) else say("event.another")
