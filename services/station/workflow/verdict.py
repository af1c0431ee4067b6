"""What an episode's result comes to: the attempt that it was, and what of it can be learnt."""

from __future__ import annotations

from dataclasses import replace

from protocol.messages import Attempt, Cut, EpisodeResult, Mode, Motion, Outcome
from services.station.workflow.asking import to
from services.station.workflow.episode import ORIGIN
from services.station.workflow.state import Episode, Phase, Workflow
from services.station.workflow.view import View

ATTEMPTS_KEPT = 100
"""More than one run until the loop has closed may have; a day's are told as they come, by number."""

_STANDING = frozenset({Phase.STOPPED, Phase.RELEASING})
_ATTENDING = frozenset({Phase.STARTING, Phase.EXECUTING})


def judged(state: Workflow, view: View) -> Workflow:
    """With the result of the episode that the robot was told to run, however late and wherever the workflow stands."""
    result, episode = view.result, state.episode
    if result is None or episode is None or result.request != episode.request:
        return state
    outcome = Outcome(result.verdict.reached, result.verdict.kicked_over, result.verdict.collision)
    attempt = Attempt(
        scene=view.scene.name if view.scene is not None else "",
        object_position=state.looked or ORIGIN,
        model_version=state.prediction.model_version if state.prediction is not None else 0,
        operator_input=result.operator_input,
        verdict=outcome,
        duration_s=result.duration,
        variant=view.scene.variant if view.scene is not None else "",
        mode=result.mode,
        condition=state.condition,
        number=state.attempts[-1].number + 1 if state.attempts else 1,
    )
    known = replace(
        state,
        episode=None,
        attempts=(*state.attempts, attempt)[-ATTEMPTS_KEPT:],
        closure=state.closure.after(attempt),
        last=outcome,
        refinements=state.refinements + (result.mode is Mode.REFINE),
        taught=None if state.phase in _STANDING else _learnable(result, outcome, episode),
    )
    if state.phase not in _ATTENDING:
        return known
    learns = known.taught is not None and result.completed
    return to(known, Phase.LEARNING if learns else Phase.DECIDING, view, pressed=False, event=_end(result))


def _end(result: EpisodeResult) -> str:
    return "" if result.completed else f"It did not run to its end: {result.reason}."


def _learnable(result: EpisodeResult, outcome: Outcome, episode: Episode) -> Motion | None:
    """What a refinement has shown: all of it where it came to its end and succeeded.

    In the thesis every refinement ends with the space bar, and is learnt where it succeeded. Here a motion ends by
    itself, and the space bar says "satisfied" as well as "I give up": one that its operator finished early and that
    succeeded can be learnt, but only once the operator says so. One that anything else cut short, a stop above all, is
    not learnt.
    """
    if result.mode is not Mode.REFINE or not outcome.success:
        return None
    finished = episode.finishing and result.cut is Cut.FINISHED
    return result.commanded if result.completed or finished else None
