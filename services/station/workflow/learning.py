"""What the model is told to learn, and how far it is to believe it. Nothing moves meanwhile or after."""

from __future__ import annotations

import math
from dataclasses import replace

import msgspec

from protocol import queries
from protocol.messages import Motion, Origin, Purpose
from services.station.words.predictions import extent
from services.station.words.table import say
from services.station.workflow import guiding
from services.station.workflow.action import Action
from services.station.workflow.asking import ask, not_done, to
from services.station.workflow.history import named
from services.station.workflow.settings import Settings
from services.station.workflow.state import WHOLE, Phase, Taught, Workflow
from services.station.workflow.view import Step, View


def learning(state: Workflow, view: View, settings: Settings) -> Step:
    """Have the model learn the refinement; then the operator is asked to see what it does by itself."""
    taught = state.taught
    if taught is None:
        return Step(to(state, Phase.DECIDING, view, owed=None))
    reply = ask(
        state,
        view,
        queries.ADD_DEMONSTRATION,
        lambda intent: _request(taught, state, view, settings, intent),
    )
    match reply:
        case Step():
            return reply
        case queries.Refused(reason):
            notice = not_done(queries.ADD_DEMONSTRATION, reason)
            if settings.scripted:
                return Step(to(state, Phase.FINISHED, view, owed=None, reason=notice))
            return Step(to(state, Phase.DECIDING, view, owed=None, event=notice))
        case _:
            learnt = replace(
                state,
                taught=None,
                last=None,
                refinements=0,
                learnt=(*state.learnt, reply.entry),
                warned=False,
                part=WHOLE,
                approach=replace(state.approach.cleared(), basis=Origin.MODEL),
            )
            learnt = guiding.told_by(learnt, reply.state, view, settings)
            said = say(f"event.learnt_{taught.method.value}", extent=extent(taught.part))
            event = f"{said} {say('event.listed', what=named(reply))}"
            return Step(to(learnt, Phase.DECIDING, view, owed=None, event=event))


def confided(state: Workflow, view: View) -> Workflow:
    """With how far the operator is sure of what s/he shows: it counts for whatever is taught next, until set anew."""
    if Action.CONFIDENCE not in view.actions:
        return state
    return replace(state, confidence=_share(view.argument(Action.CONFIDENCE), state.confidence))


def confidence(state: Workflow, settings: Settings) -> float:
    """How far the model is to believe what it is taught next: alpha of equation (18)."""
    return settings.alpha if state.confidence is None else state.confidence


def _share(text: str, otherwise: float | None) -> float | None:
    """From 0 to 1, as a page says it; what it was where it says none."""
    try:
        share = float(text)
    except ValueError:
        return otherwise
    return min(max(share, 0.0), 1.0) if math.isfinite(share) else otherwise


def _request(taught: Taught, state: Workflow, view: View, settings: Settings, intent: int) -> queries.AddDemonstration:
    return queries.AddDemonstration(
        Purpose.INITIAL if state.empty or state.guide.open else Purpose.UPDATE,
        learnable(taught.motion, settings.autonomous_s),
        taught.object_position,
        view.scene.name if view.scene is not None else "",
        taught.condition,
        operator=settings.operator,
        alpha=confidence(state, settings),
        part=taught.part,
        method=taught.method,
        skill=state.prediction.skill if state.prediction is not None else "",
        request=intent,
    )


def learnable(motion: Motion, duration: float) -> Motion:
    """A motion in the tempo of an autonomous execution: a refinement ran slower than what it corrects."""
    return msgspec.structs.replace(motion, duration=duration)
