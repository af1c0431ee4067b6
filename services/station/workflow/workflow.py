"""The teaching workflow (thesis, Algorithm 1) as one pure function of state and view.

Look at the object, predict, execute; where that fails, execute again under correction; where that succeeds, learn;
predict again. A lost authority is asked for again, and the run goes on where it was: the robot holds meanwhile. What
cannot go on (a robot that was restarted, an episode without an end) is done anew from the reset.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import msgspec
import numpy as np

from protocol import queries
from protocol.messages import Attempt, EpisodeResult, Mode, Motion, Outcome, Vector3
from protocol.messages import Phase as RobotPhase
from protocol.queries import Query
from services.bus.bus import Failed
from services.station.workflow.state import Action, Ask, Phase, Place, Settings, Step, View, Workflow

RETRY_S = 0.5
LOOK_S = 0.8
"""A sighting counts once all its pictures were taken after the reset: nine at 15 Hz, and their way here."""

PICTURES_NEEDED = 5
EPISODE_GRACE_S = 45.0
"""How much longer than its motion a scripted episode may take (ramp, holds) before it counts as lost."""

SAME_PLACE_M = 0.02
"""Two sightings of an object that nobody moved differ by a few millimetres."""

ORIGIN: Vector3 = (0.0, 0.0, 0.0)
"""What motions are relative to where there is no object."""

IDLE_S = 3.0
"""A robot that is idle for so long while an episode should run has forgotten it: it was restarted."""

_RESUMED = frozenset({Phase.DECIDING, Phase.EXECUTING})

_WITHOUT_AUTHORITY = frozenset({Phase.WAITING, Phase.ACQUIRING, Phase.RELEASING, Phase.FINISHED})


def advance(state: Workflow, view: View, settings: Settings) -> Step:
    """One step of the workflow."""
    if state.phase is Phase.FINISHED:
        return Step(state)
    if view.safety is not None and view.safety.emergency_stop and state.phase is not Phase.RELEASING:
        if Action.RELEASE_STOP in view.actions:
            return Step(_to(state, Phase.RELEASING, view))
        return Step(replace(state, offered=frozenset({Action.RELEASE_STOP})))
    if state.phase not in _WITHOUT_AUTHORITY and _authority_lost(state, view, settings):
        resume = state.phase if state.phase in _RESUMED else Phase.RESETTING
        return Step(_to(state, Phase.WAITING, view, resume=resume, notice="The authority was lost."))
    return _PHASES[state.phase](state, view, settings)


def loop_has_closed(attempts: tuple[Attempt, ...]) -> bool:
    """A prediction failed, a refinement succeeded, and under a newer model a prediction succeeded by itself."""
    return any(
        _closes(first, refined, later)
        for i, first in enumerate(attempts)
        for j, refined in enumerate(attempts[i + 1 :], i + 1)
        for later in attempts[j + 1 :]
    )


def _closes(first: Attempt, refined: Attempt, later: Attempt) -> bool:
    return (
        first.mode is Mode.AUTONOMOUS
        and not first.verdict.success
        and refined.mode is Mode.REFINE
        and refined.operator_input
        and refined.verdict.success
        and later.mode is Mode.AUTONOMOUS
        and not later.operator_input
        and later.verdict.success
        and later.model_version > refined.model_version
        and later.variant == first.variant
        and later.condition == first.condition
        and bool(np.allclose(later.object_position, first.object_position, rtol=0.0, atol=SAME_PLACE_M))
    )


def _to(state: Workflow, phase: Phase, view: View, **changes: Any) -> Workflow:
    entered: dict[str, Any] = {"asking": False, "retry_s": 0.0, "offered": frozenset(), "notice": "", **changes}
    return replace(state, phase=phase, since_s=view.now_s, **entered)


def _authority_lost(state: Workflow, view: View, settings: Settings) -> bool:
    """The robot says so; what it said before it granted the lease, of an earlier epoch, does not count."""
    authority = view.authority
    if authority is None or authority.epoch < state.epoch:
        return False
    return authority.epoch > state.epoch or authority.holder != settings.holder


def _asked(state: Workflow, view: View, query: Query[Any, Any], request: msgspec.Struct) -> Step | Any:
    """The positive reply, or the step to take while there is none; a failure or a no is shown and asked again."""
    if not state.asking:
        return Step(replace(state, asking=True), Ask(query, request)) if view.now_s >= state.retry_s else Step(state)
    match view.outcome:
        case None:
            return Step(state)
        case Failed(reason) | queries.Refused(reason):
            notice = f"Could not {query.about}: {reason}"
            return Step(replace(state, asking=False, retry_s=view.now_s + RETRY_S, notice=notice))
        case reply:
            return reply


def _waiting(state: Workflow, view: View, settings: Settings) -> Step:
    del settings
    missing = [name for name, there in (("robot", view.robot and view.scene), ("model", view.model)) if not there]
    if missing:
        return Step(replace(state, notice=f"Waiting for the {' and the '.join(missing)}."))
    if view.model is not None and not view.model.demonstrations + view.model.updates:
        return Step(replace(state, notice="Waiting for the first demonstrations."))
    return Step(_to(state, Phase.ACQUIRING, view))


def _acquiring(state: Workflow, view: View, settings: Settings) -> Step:
    if Action.TAKE_OVER in view.actions:
        state = replace(state, asking=False, retry_s=0.0)
    request = queries.AcquireAuthority(settings.holder, take_over=Action.TAKE_OVER in view.actions)
    reply = _asked(state, view, queries.ACQUIRE, request)
    if isinstance(reply, Step):
        return Step(replace(reply.state, offered=frozenset({Action.TAKE_OVER})), reply.ask)
    return Step(_to(state, state.resume, view, epoch=reply.epoch, resume=Phase.RESETTING))


def _resetting(state: Workflow, view: View, settings: Settings) -> Step:
    if not state.asking and view.robot is not None and view.robot.phase.running:
        # Of an episode that was lost; its result is nobody's.
        finish = view.now_s >= state.retry_s
        return Step(
            replace(state, retry_s=view.now_s + RETRY_S) if finish else state,
            Ask(queries.FINISH, queries.Finish(state.epoch)) if finish else None,
        )
    if settings.arrangement is not None:
        request = msgspec.structs.replace(settings.arrangement, epoch=state.epoch)
    else:
        state = replace(state, placed=state.placed or view.drawn)
        place = state.placed or Place()
        changed = view.scene.variants[-1] if view.scene is not None and view.scene.variants else None
        request = queries.Reset(state.epoch, settings.variant or changed, place.object_position, place.condition)
    reply = _asked(state, view, queries.RESET, request)
    return reply if isinstance(reply, Step) else Step(_to(state, Phase.LOOKING, view))


def _looking(state: Workflow, view: View, settings: Settings) -> Step:
    del settings
    if view.scene is not None and view.scene.condition:
        # Nothing to look for: the robot says where it stands, once it has been reset.
        if view.scene_s <= state.since_s:
            return Step(state)
        return Step(_to(state, Phase.PREDICTING, view, looked=ORIGIN, condition=view.scene.condition))
    seen = view.seen
    if seen is None or seen.pictures < PICTURES_NEEDED or view.seen_s - state.since_s < LOOK_S:
        return Step(state)
    return Step(_to(state, Phase.PREDICTING, view, looked=seen.pose.position, condition=()))


def _predicting(state: Workflow, view: View, settings: Settings) -> Step:
    del settings
    if state.looked is None or view.robot is None:
        return Step(_to(state, Phase.LOOKING, view))
    request = queries.Predict(state.looked, view.robot.measured, state.condition)
    reply = _asked(state, view, queries.PREDICT, request)
    if isinstance(reply, Step):
        return reply
    return Step(_to(state, Phase.STARTING, view, prediction=reply.prediction))


def _starting(state: Workflow, view: View, settings: Settings) -> Step:
    prediction = state.prediction
    if prediction is None:
        return Step(_to(state, Phase.LOOKING, view))
    if not state.asking:
        state = replace(state, request=state.request + 1)
    duration = _duration(state.mode, settings)
    request = queries.Execute(state.epoch, state.mode, prediction.id, duration, settings.adapt, request=state.request)
    reply = _asked(state, view, queries.EXECUTE, request)
    if state.asking and isinstance(view.outcome, queries.Refused) and isinstance(reply, Step):
        # The robot has moved since, or has not heard this prediction: another one is as quickly made.
        return Step(_to(state, Phase.PREDICTING, view, retry_s=reply.state.retry_s, notice=reply.state.notice))
    return reply if isinstance(reply, Step) else Step(_to(state, Phase.EXECUTING, view))


def _duration(mode: Mode, settings: Settings) -> float:
    return settings.refine_s if mode is Mode.REFINE else settings.autonomous_s


def _executing(state: Workflow, view: View, settings: Settings) -> Step:
    if view.result is not None and view.result.request == state.request:
        return _judged(state, view, view.result)
    elapsed = view.now_s - state.since_s
    forgotten = view.robot is not None and view.robot.phase is RobotPhase.IDLE and elapsed > IDLE_S
    # A person may let the robot hold for as long as they like; a script that does is broken.
    stuck = settings.scripted and elapsed > _duration(state.mode, settings) + EPISODE_GRACE_S
    if forgotten or stuck:
        return Step(_to(state, Phase.WAITING, view, notice="The episode was lost."))
    if Action.FINISH in view.actions:
        return Step(state, Ask(queries.FINISH, queries.Finish(state.epoch)))
    return Step(replace(state, offered=frozenset({Action.FINISH})))


def _judged(state: Workflow, view: View, result: EpisodeResult) -> Step:
    verdict = Outcome(result.verdict.reached, result.verdict.kicked_over, result.verdict.collision)
    attempt = Attempt(
        scene=view.scene.name if view.scene is not None else "",
        object_position=state.looked or ORIGIN,
        model_version=state.prediction.model_version if state.prediction is not None else 0,
        operator_input=result.operator_input,
        verdict=verdict,
        duration_s=result.duration,
        variant=view.scene.variant if view.scene is not None else "",
        mode=result.mode,
        condition=state.condition,
    )
    refining = result.mode is Mode.REFINE
    attempts = (*state.attempts, attempt)
    judged = replace(
        state,
        attempts=attempts,
        loop_closed=loop_has_closed(attempts),
        last=verdict,
        refinements=state.refinements + refining,
        taught=result.commanded if refining and verdict.success else None,
    )
    return Step(_to(judged, Phase.LEARNING if judged.taught else Phase.DECIDING, view, notice=result.reason))


def _learning(state: Workflow, view: View, settings: Settings) -> Step:
    if state.taught is None or state.looked is None:
        return Step(_to(state, Phase.DECIDING, view))
    motion = learnable(state.taught, settings.autonomous_s)
    scene = view.scene.name if view.scene is not None else ""
    # The model needs the refined prediction only where it is to believe the refinement in part.
    believed_in_part = state.prediction if settings.alpha < 1.0 else None
    refined = learnable(believed_in_part.motion, settings.autonomous_s) if believed_in_part is not None else None
    request = queries.AddDemonstration(
        queries.Kind.UPDATE, motion, state.looked, scene, state.condition, prediction=refined, alpha=settings.alpha
    )
    reply = _asked(state, view, queries.ADD_DEMONSTRATION, request)
    if isinstance(reply, Step):
        return reply
    learnt = replace(state, taught=None, refinements=0, updates=state.updates + 1)
    return _again(learnt, view, Mode.AUTONOMOUS)


def learnable(motion: Motion, duration: float) -> Motion:
    """A motion in the tempo of an autonomous execution: a refinement ran slower than what it corrects."""
    return msgspec.structs.replace(motion, duration=duration)


def _undoing(state: Workflow, view: View, settings: Settings) -> Step:
    del settings
    reply = _asked(state, view, queries.UNDO, queries.Undo())
    if isinstance(reply, Step):
        return reply
    return _again(replace(state, updates=max(0, state.updates - 1)), view, Mode.AUTONOMOUS)


def _releasing(state: Workflow, view: View, settings: Settings) -> Step:
    reply = _asked(state, view, queries.RELEASE_STOP, queries.ReleaseStop(settings.holder))
    if isinstance(reply, Step):
        return reply
    # After a stop nothing moves by itself: the operator decides.
    return Step(_to(state, Phase.WAITING, view, resume=Phase.DECIDING, last=None))


def _deciding(state: Workflow, view: View, settings: Settings) -> Step:
    offered = {Action.EXECUTE, Action.REFINE, Action.NEXT, Action.END}
    if state.updates:
        offered.add(Action.UNDO)
    pressed = [action for action in Action if action in view.actions & offered]
    chosen = _recommended(state, settings) if settings.scripted else next(iter(pressed), None)
    match chosen:
        case Action.EXECUTE:
            return _again(state, view, Mode.AUTONOMOUS)
        case Action.REFINE:
            return _refine(state, view, settings)
        case Action.NEXT:
            fresh = replace(state, placed=None, last=None, refinements=0, updates=0)
            return _again(fresh, view, Mode.AUTONOMOUS)
        case Action.UNDO:
            return Step(_to(state, Phase.UNDOING, view))
        case Action.END:
            return _end(state, view, "ended before the loop had closed")
        case _:
            return Step(replace(state, offered=frozenset(offered)))


def _recommended(state: Workflow, settings: Settings) -> Action:
    if state.last is None:
        return Action.EXECUTE
    if not state.last.success:
        return Action.REFINE
    return Action.END if settings.once else Action.NEXT


def _refine(state: Workflow, view: View, settings: Settings) -> Step:
    if state.refinements >= settings.refinements_allowed:
        return _end(state, view, f"{state.refinements} refinements did not succeed")
    if state.updates >= settings.updates_allowed:
        return _end(state, view, f"{state.updates} updates did not teach the model")
    return _again(state, view, Mode.REFINE)


def _again(state: Workflow, view: View, mode: Mode) -> Step:
    """Every episode begins with a reset and a look: what was seen before the last motion may no longer be so."""
    return Step(_to(state, Phase.RESETTING, view, mode=mode))


def _end(state: Workflow, view: View, reason: str) -> Step:
    return Step(_to(state, Phase.FINISHED, view, reason="" if state.loop_closed else reason))


_PHASES: dict[Phase, Callable[[Workflow, View, Settings], Step]] = {
    Phase.WAITING: _waiting,
    Phase.ACQUIRING: _acquiring,
    Phase.RESETTING: _resetting,
    Phase.LOOKING: _looking,
    Phase.PREDICTING: _predicting,
    Phase.STARTING: _starting,
    Phase.EXECUTING: _executing,
    Phase.LEARNING: _learning,
    Phase.UNDOING: _undoing,
    Phase.DECIDING: _deciding,
    Phase.RELEASING: _releasing,
}
