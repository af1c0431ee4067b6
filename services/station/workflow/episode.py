"""One episode, from the press that asked for it to its verdict: reset, look, predict, start, execute."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Any

import msgspec

from protocol import queries
from protocol.messages import Mode, Origin, Prediction, Vector3
from protocol.messages import Phase as RobotPhase
from protocol.queries import Query
from services.bus.predictions import LITTLE
from services.station.words.table import say
from services.station.workflow import editing, going
from services.station.workflow.action import Action
from services.station.workflow.asking import RETRY_S, ask, not_done, to
from services.station.workflow.authority import gone, runs
from services.station.workflow.proposals import proposed
from services.station.workflow.settings import Settings
from services.station.workflow.state import WHOLE, Episode, Phase, Place, Workflow
from services.station.workflow.view import Ask, Step, View

LOOK_S = 0.8
"""A sighting counts once all its pictures were taken after the reset: nine at 15 Hz, and their way here."""

UNSEEN_S = 3.0
"""Without a press the operator is asked all the same where nothing was seen within this time: the arm may hide it."""

UNSEEN_AFTER_RESET_S = 15.0
"""After a press so much patience is had with slow pictures."""

PICTURES_NEEDED = 5
EPISODE_GRACE_S = 45.0
"""How much longer than its motion a scripted episode may take (ramp, holds) before it counts as lost."""

REFUSALS_SUFFERED = 5
"""So often is asked again on one press, in case the reason passes."""

ORIGIN: Vector3 = (0.0, 0.0, 0.0)
"""What motions are relative to where there is no object."""


def press(state: Workflow, view: View, mode: Mode, origin: Origin = Origin.MODEL) -> Workflow:
    """The operator asked for an episode: it begins with a reset and a look, since what was seen may no longer be so."""
    return to(state, Phase.RESETTING, view, mode=mode, origin=origin, pressed=True, refusals=0, taught=None, event="")


def look(state: Workflow, view: View) -> Workflow:
    """The operator asked for a look at the target: the arm goes back to its start, out of the way, and nothing else."""
    return to(state, Phase.RESETTING, view, wants=Action.LOOK, pressed=True, refusals=0, event="", taught=state.taught)


def resetting(state: Workflow, view: View, settings: Settings) -> Step:
    """Put the robot back to its start and the target to its place."""
    if not state.question and view.robot is not None and view.robot.phase.running:
        # Of an episode that was lost; its result is nobody's.
        if view.now_s < state.retry_s:
            return Step(state)
        finish = queries.Finish(state.epoch, request=view.number)
        return Step(replace(state, retry_s=view.now_s + RETRY_S), Ask(queries.FINISH, finish, view.number))
    state = replace(state, placed=state.placed or _next_place(state, view))
    reply = ask(state, view, queries.RESET, lambda intent: _reset(state, view, settings, intent))
    if isinstance(reply, queries.Refused):
        return refused(state, view, settings, queries.RESET, reply)
    moves_on = state.wants is not Action.LOOK
    return reply if isinstance(reply, Step) else Step(to(state, Phase.LOOKING, view, pressed=moves_on))


def _next_place(state: Workflow, view: View) -> Place | None:
    """Where the target is put next: where it is to be shown a motion, else where the dice say."""
    shows = proposed(view.scene, state.guide, view.kept_at) if state.guide.open and view.scene is not None else None
    return shows or view.drawn


def _reset(state: Workflow, view: View, settings: Settings, intent: int) -> queries.Reset:
    if settings.arrangement is not None:
        return msgspec.structs.replace(settings.arrangement, epoch=state.epoch, request=intent)
    place = state.placed or Place()
    changed = view.scene.variants[-1] if view.scene is not None and view.scene.variants else None
    return queries.Reset(
        state.epoch, settings.variant or changed, place.object_position, place.condition, request=intent
    )


def looking(state: Workflow, view: View, settings: Settings) -> Step:
    """See where the target stands; without a press the operator is asked then, and nothing has moved."""
    del settings
    if view.robot is not None and view.robot.phase is RobotPhase.HOMING:
        return Step(replace(state, since_s=view.now_s))  # what is seen counts once the arm is out of the way
    onward, guide = _onward(state), state.guide.looked(put=state.placed is not None)
    if view.scene is not None and view.scene.condition:
        # Nothing to look for: the robot says where it stands, once it has been reset.
        if state.pressed and view.scene_s <= state.since_s:
            return Step(state)
        known = {"looked": ORIGIN, "condition": view.scene.condition, "unseen": False}
        return Step(to(state, onward, view, **known, guide=guide))
    sighting = view.seen
    if sighting is None or not is_seen(state, view):
        patience_s = UNSEEN_AFTER_RESET_S if state.pressed or state.unseen else UNSEEN_S
        if view.now_s - state.since_s < patience_s:
            return Step(state)
        return Step(to(state, Phase.DECIDING, view, pressed=False, unseen=True))
    known = {"looked": sighting.pose.position, "condition": (), "unseen": False}
    return Step(to(state, onward, view, **known, guide=guide))


def is_seen(state: Workflow, view: View) -> bool:
    """Whether the target was seen, in pictures enough, since the workflow came to where it stands."""
    return view.seen is not None and view.seen.pictures >= PICTURES_NEEDED and view.seen_s - state.since_s >= LOOK_S


def _onward(state: Workflow) -> Phase:
    """Where a look leads: nowhere without a press; else to a motion, but where the hand leads alone."""
    if not state.pressed:
        return Phase.DECIDING
    if state.mode is Mode.TEACH:
        return Phase.TAKING_UP
    return Phase.PREDICTING if state.origin is Origin.MODEL else Phase.PLANNING


def predicting(state: Workflow, view: View, settings: Settings) -> Step:
    """Have the model predict a motion to where the target was seen; without a press it is only shown."""
    looked, robot, scene = state.looked, view.robot, view.scene
    if looked is None or robot is None or scene is None:
        return Step(to(state, Phase.LOOKING, view))
    start = robot.measured if state.pressed else scene.start
    reply = ask(state, view, queries.PREDICT, lambda intent: queries.Predict(looked, start, state.condition))
    if isinstance(reply, queries.Refused):
        return refused(state, view, settings, queries.PREDICT, reply)
    if isinstance(reply, Step):
        return reply
    if not state.pressed:
        kept = {"event": state.event, "offered": state.offered}
        return Step(to(state, Phase.DECIDING, view, prediction=reply.prediction, **kept))
    if _doubtful(state, reply.prediction, settings):
        warned = replace(state, prediction=reply.prediction, last=None, warned=True)
        return Step(to(warned, Phase.DECIDING, view, pressed=False))
    return Step(to(state, Phase.STARTING, view, prediction=reply.prediction))


def _doubtful(state: Workflow, prediction: Prediction, settings: Settings) -> bool:
    """A person is asked before the robot alone tries what little is known of; a script is there to see it try."""
    alone = state.mode is Mode.AUTONOMOUS and not settings.scripted
    return alone and not state.warned and prediction.known < LITTLE


def starting(state: Workflow, view: View, settings: Settings) -> Step:
    """Tell the robot the prediction."""
    prediction, robot = state.prediction, view.robot
    if prediction is None:
        return Step(to(state, Phase.LOOKING, view))
    if robot is None:
        return Step(state)
    duration = settings.duration_s(state.mode)
    part = state.part if state.mode is Mode.REFINE else WHOLE
    reply = ask(
        state,
        view,
        queries.EXECUTE,
        lambda intent: queries.Execute(
            state.epoch, state.mode, prediction.id, duration, settings.adapt, part, request=intent
        ),
    )
    if isinstance(reply, queries.Refused):
        # The robot has moved since, or has not heard this prediction: another one is as quickly made.
        again = Phase.PREDICTING if state.origin is Origin.MODEL else Phase.PLANNING
        return refused(state, view, settings, queries.EXECUTE, reply, again=again)
    if isinstance(reply, Step):
        if reply.ask is None:
            return reply
        told = Episode(reply.state.intent, robot.publisher, part=part)
        return Step(replace(reply.state, episode=told), reply.ask)
    started = started_as(state, reply.episode, view)
    paced = going.begun(state, settings, part)
    begun = {"episode": started, "pressed": False, "led": False, "let_go": False, "going": paced}
    return Step(to(state, Phase.EXECUTING, view, **begun))


def started_as(state: Workflow, number: int, view: View) -> Episode | None:
    """The episode that was asked for, now that the robot has begun it under this number."""
    return replace(state.episode, number=number, begun_s=view.now_s) if state.episode is not None else None


def refused(
    state: Workflow,
    view: View,
    settings: Settings,
    query: Query[Any, Any],
    reply: queries.Refused,
    *,
    again: Phase | None = None,
) -> Step:
    """Once more, as another request; where the reason does not pass, the operator is told and asked."""
    notice, refusals = not_done(query, reply.reason), state.refusals + 1
    if refusals < REFUSALS_SUFFERED and not reply.lasting:
        retry_s = view.now_s + RETRY_S
        once_more = {"refusals": refusals, "retry_s": retry_s, "notice": notice, "wants": state.wants}
        return Step(to(state, again or state.phase, view, **once_more, offered=state.offered))
    if settings.scripted:
        return Step(to(state, Phase.FINISHED, view, reason=notice))
    return Step(to(state, Phase.DECIDING, view, pressed=False, event=notice))


def executing(state: Workflow, view: View, settings: Settings) -> Step:
    """Watch, until the result has come; the operator ends the episode, or lets a held one go on."""
    ended = _without_result(state, view, settings)
    if ended:
        if not runs(state, view):  # what is known of an attempt before it says nothing of this one
            state = replace(state, last=None, taught=None)
        if settings.scripted:  # what a script had not shown to its end leads nowhere
            state = replace(state, approach=state.approach.cleared())
        return Step(to(state, Phase.DECIDING, view, episode=None, event=ended))
    state = editing.heard(going.heard(state, view), view)
    wanted = _wanted(state, view, settings)
    if wanted is not state.wants:
        state = replace(state, wants=wanted, question=0, intent=0, retry_s=view.now_s, event="")
    let_go = _let_go(state, view)
    if let_go is not state.let_go:
        state = replace(state, let_go=let_go)
    offered = _offered(state, view)
    match state.wants:
        case Action.FINISH:
            finishing = replace(state.episode, finishing=True) if state.episode is not None else None
            state = replace(state, episode=finishing, going=None)
            step = _order(state, view, queries.FINISH, lambda intent: queries.Finish(state.epoch, request=intent))
        case Action.GO_ON:
            step = _order(state, view, queries.RESUME, lambda intent: queries.Resume(state.epoch, request=intent))
        case Action.PACE if state.going is not None:
            step = _order(state, view, queries.PACE, partial(going.request, state, state.going))
        case _:
            step = Step(state)
    return step if offered == step.state.offered else Step(replace(step.state, offered=offered), step.ask)


def _offered(state: Workflow, view: View) -> frozenset[Action]:
    """What the operator may do; a robot that is not heard for a moment takes no button away."""
    if view.robot is None and state.offered:
        return state.offered
    ends = {Action.FINISH, Action.GO_ON} if _waits(state, view) else {Action.FINISH}
    return going.offered(state, view) | editing.offered(state, view) | ends


def _waits(state: Workflow, view: View) -> bool:
    """The robot waits to be asked, as far as it was heard."""
    return view.robot.waiting if view.robot is not None else Action.GO_ON in state.offered


def _wanted(state: Workflow, view: View, settings: Settings) -> Action | None:
    """What the operator wants of the robot: what is not answered yet, but to end goes before all else."""
    if Action.FINISH in view.actions or state.wants is not None:
        return Action.FINISH if Action.FINISH in view.actions else state.wants
    pressed = view.now_s >= state.retry_s if settings.scripted else Action.GO_ON in view.actions
    if pressed and _waits(state, view):
        return Action.GO_ON
    return Action.PACE if state.going is not None else None


def _order(state: Workflow, view: View, query: Query[Any, Any], request: Callable[[int], msgspec.Struct]) -> Step:
    """Finish, go on, or at another pace, as the operator wants, until the robot has answered."""
    reply = ask(state, view, query, request)
    if isinstance(reply, Step):
        return reply
    answered = replace(state, wants=None, retry_s=view.now_s + RETRY_S)
    if query is queries.PACE:
        answered = replace(answered, going=None)
    if not isinstance(reply, queries.Refused):
        return Step(replace(answered, notice=""))
    if query is queries.FINISH and view.robot is not None and view.robot.phase is RobotPhase.IDLE:
        notice = say("event.no_result")
        return Step(to(answered, Phase.DECIDING, view, event=notice))
    return Step(replace(answered, notice=not_done(query, reply.reason)))


def _let_go(state: Workflow, view: View) -> bool:
    """Keys that were held before the robot executes, or when it had to be asked, do not count until all were let go.

    A hold that ends by itself changes nothing in what counts, nor does a robot that is not heard for a moment.
    """
    robot = view.robot
    waits = robot is not None and (robot.waiting or robot.phase not in (RobotPhase.EXECUTE, RobotPhase.HOLD))
    return view.steering and (state.let_go or waits)


def _without_result(state: Workflow, view: View, settings: Settings) -> str:
    """Why the episode's result is not waited for any more; empty where it is.

    A robot that is idle proves nothing: its result may be on its way, and is repeated until it comes.
    """
    if not runs(state, view):
        return gone(state, view)
    # A person may let the robot hold for as long as they like; a script that does is broken.
    begun_s = state.episode.begun_s if state.episode is not None else state.since_s
    if settings.scripted and view.now_s - begun_s > settings.duration_s(state.mode) + EPISODE_GRACE_S:
        return say("event.lost_episode")
    return ""
