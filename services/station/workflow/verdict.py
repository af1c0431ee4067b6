"""What an episode's result comes to: the attempt that it was, and what of it can be learnt."""

from __future__ import annotations

from dataclasses import replace

import msgspec
import numpy as np

from lfd.exceptions import LfdError
from lfd.motion.resampling import at_phases
from lfd.motion.trajectory import Trajectory
from protocol.messages import Attempt, Cut, EpisodeResult, Method, Mode, Motion, Origin, Outcome, Part
from services.bus.arrays import motion_from_wire, motion_to_wire
from services.process.exceptions import ServiceError
from services.station.words.heard import heard
from services.station.words.table import say
from services.station.workflow.approach import Approach
from services.station.workflow.asking import to
from services.station.workflow.demonstration import demonstrated
from services.station.workflow.episode import ORIGIN
from services.station.workflow.part import common
from services.station.workflow.planning import preview
from services.station.workflow.settings import Settings
from services.station.workflow.state import WHOLE, Episode, Phase, Taught, Workflow
from services.station.workflow.view import View

ATTEMPTS_KEPT = 100
"""More than one run until the loop has closed may have; a day's are told as they come, by number."""

MARGIN = 0.05
"""Share of a motion that is not learnt before it failed: the correction led to the failure by then."""

SHORTEST = 0.1
"""Share of a motion that is worth learning at least."""

_STANDING = frozenset({Phase.STOPPED, Phase.RELEASING})
_ATTENDING = frozenset({Phase.STARTING, Phase.TAKING_UP, Phase.EXECUTING})


def judged(state: Workflow, view: View, settings: Settings) -> Workflow:
    """With the result of the episode that the robot was told to run, however late and wherever the workflow stands."""
    result, episode = view.result, state.episode
    if result is None or episode is None or result.request != episode.request:
        return state
    if result.mode is Mode.TEACH and state.led:
        return _led(replace(state, episode=None, last=None), view, result)
    outcome = Outcome(result.verdict.reached, result.verdict.kicked_over, result.verdict.collision)
    attempt = Attempt(
        scene=view.scene.name if view.scene is not None else "",
        object_position=state.looked or ORIGIN,
        model_version=state.prediction.model_version if state.prediction is not None else 0,
        operator_input=result.operator_input or shown(state),
        verdict=outcome,
        duration_s=result.duration,
        variant=view.scene.variant if view.scene is not None else "",
        mode=Mode.TEACH if shown(state) else result.mode,
        condition=state.condition,
        number=state.attempts[-1].number + 1 if state.attempts else 1,
        completed=result.completed,
    )
    taught = _kept(state, _taught(state, result, outcome, episode, settings))
    known = replace(
        state,
        episode=None,
        attempts=(*state.attempts, attempt)[-ATTEMPTS_KEPT:],
        closure=state.closure.after(attempt, empty=state.empty or state.guide.open),
        last=outcome,
        refinements=state.refinements + (result.mode is Mode.REFINE),
        taught=taught,
        approach=_followed(state, result, taught),
    )
    if state.phase not in _ATTENDING:
        return known
    if result.mode is Mode.TEACH and known.taught is not None:
        return preview(replace(known, event=""), view, Origin.DEMONSTRATION)
    asked = state.guide.open
    learns = known.taught is not None and known.taught.whole and result.completed and not asked
    event = " ".join(part for part in (_end(result), _nothing(known, result)) if part)
    return to(known, Phase.LEARNING if learns else Phase.DECIDING, view, pressed=False, event=event)


def shown(state: Workflow) -> bool:
    """The motion of the newest episode is the operator's own, and no prediction."""
    return state.mode is Mode.TEACH or state.origin in (Origin.WAYPOINTS, Origin.DEMONSTRATION)


def _led(state: Workflow, view: View, result: EpisodeResult) -> Workflow:
    """After the waypoints were stored: the motion through them is shown as soon as they make one."""
    if state.phase not in _ATTENDING:
        return state
    event = "" if result.cut is Cut.FINISHED else _end(result)
    if state.approach.replays is not None:
        return preview(replace(state, event=event), view, state.approach.replays)
    return to(state, Phase.DECIDING, view, pressed=False, event=event)


def _followed(state: Workflow, result: EpisodeResult, taught: Taught | None) -> Approach:
    """With what a refinement came to, for whoever goes on from there; with what was led, for whoever sees it done."""
    if result.mode is Mode.TEACH and taught is not None:
        return replace(state.approach, shown=taught.motion)
    previous = _of_all_phases(result) if result.mode is Mode.REFINE else None
    return state.approach if previous is None else replace(state.approach, previous=previous)


def _end(result: EpisodeResult) -> str:
    return "" if result.completed else say("event.cut", why=heard(result.reason))


def _nothing(known: Workflow, result: EpisodeResult) -> str:
    """Why nothing of a refinement that failed can be taught; empty where something can, or it did not fail."""
    failed = known.last is not None and not known.last.success
    if result.mode is not Mode.REFINE or known.taught is not None or not failed or result.cut is Cut.TAKEN_OVER:
        return ""
    if not result.operator_input:
        return say("event.nothing_counted")
    if result.completed and result.clear_until >= result.progress:
        return say("event.only_missed")
    return say("event.too_early", share=f"{100.0 * min(result.clear_until, result.progress):.0f}")


def _kept(state: Workflow, taught: Taught | None) -> Taught | None:
    """Under a stop what came to its end is not learnt either, whatever it looked like."""
    return None if state.phase in _STANDING and taught is not None and taught.whole else taught


def _taught(
    state: Workflow, result: EpisodeResult, outcome: Outcome, episode: Episode, settings: Settings
) -> Taught | None:
    """What an episode has shown, by the way in which it was led; nothing where the model led it."""
    if result.mode is Mode.REFINE:
        return _corrected(state, result, outcome, episode)
    spoilt = outcome.collision or outcome.kicked_over
    ended = result.completed or (episode.finishing and result.cut is Cut.FINISHED)
    if not shown(state) or spoilt or not ended:
        return None
    led = result.mode is Mode.TEACH
    motion = demonstrated(_shown(result), settings) if led else _shown(result)
    if motion is None:
        return None
    method = Method.DEMONSTRATE if led or state.origin is Origin.DEMONSTRATION else Method.WAYPOINTS
    return Taught(motion, state.looked or ORIGIN, state.condition, whole=outcome.success, method=method)


def _corrected(state: Workflow, result: EpisodeResult, outcome: Outcome, episode: Episode) -> Taught | None:
    """What a refinement has shown: all of it where it came to its end and succeeded.

    In the thesis every refinement ends with the space bar, and is learnt where it succeeded. Here a motion ends by
    itself, and the space bar says "satisfied" as well as "I give up": one that its operator finished early and that
    succeeded can be learnt, but only once the operator says so. So can the part of one before it failed, was given up
    or was stopped; what came after that, and what another station cut short, is not learnt.
    """
    finished = episode.finishing and result.cut is Cut.FINISHED
    succeeded = outcome.success and (result.completed or finished)
    part = (_part_within if succeeded else _part_before)(result, episode.part, finished=finished)
    motion = _shown(result) if part == WHOLE else _of_all_phases(result)
    if part is None or motion is None:
        return None
    whole = succeeded and part == episode.part
    return Taught(motion, state.looked or ORIGIN, state.condition, part, whole=whole)


def _part_within(result: EpisodeResult, corrected: Part, *, finished: bool) -> Part | None:
    """What was corrected of a refinement that succeeded: all of it, or as far as it came before it was finished."""
    if corrected == WHOLE or not finished:
        return corrected
    return common(Part(0.0, max(result.progress, SHORTEST)), corrected, SHORTEST)


def _part_before(result: EpisodeResult, corrected: Part, *, finished: bool) -> Part | None:
    """What was corrected of a refinement before it failed or was cut short; None where there is none to speak of.

    One that came to its end and merely missed the target does not say where it went wrong.
    """
    cut = finished or result.cut is Cut.STOPPED
    spoilt = result.clear_until < result.progress and (result.completed or cut)
    last = min(result.clear_until, result.progress) - MARGIN
    if not (result.operator_input and (cut or spoilt) and last >= SHORTEST):
        return None
    return common(Part(0.0, last), corrected, SHORTEST)


def _shown(result: EpisodeResult) -> Motion:
    """Where the arm was told to be, oriented as it was asked to be.

    At a joint's limit, or in a hurry, the orientation gives way first. That was nobody's wish; learnt, it would be
    asked for from then on, and give way by as much again.
    """
    return msgspec.structs.replace(result.commanded, orientations=result.refined.orientations)


def _of_all_phases(result: EpisodeResult) -> Motion | None:
    """What was shown, as a motion of all the prediction's phases: where it was cut short, it stood from then on."""
    try:
        shown = Trajectory(*motion_from_wire(_shown(result)))
    except (LfdError, ServiceError):
        return None  # of numbers that no robot sends
    whole = at_phases(shown, np.minimum(shown.phases / result.progress, 1.0))
    return motion_to_wire(whole.positions, whole.orientations, shown.duration, whole.opening)
