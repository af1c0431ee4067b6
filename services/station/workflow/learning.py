"""What the model is told: to learn a refinement, to take an update back. Nothing moves meanwhile or after."""

from __future__ import annotations

from dataclasses import replace

import msgspec

from protocol import queries
from protocol.messages import Method, Motion, Purpose
from services.station.workflow.asking import ask, not_done, to
from services.station.workflow.part import extent
from services.station.workflow.state import WHOLE, Phase, Settings, Taught, Workflow
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
        lambda intent: _request(taught, view, settings, intent),
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
                state, taught=None, last=None, refinements=0, updates=state.updates + 1, warned=False, part=WHOLE
            )
            event = f"The model has learnt the correction{extent(taught.part)}."
            return Step(to(learnt, Phase.DECIDING, view, owed=None, event=event))


def _request(taught: Taught, view: View, settings: Settings, intent: int) -> queries.AddDemonstration:
    return queries.AddDemonstration(
        Purpose.UPDATE,
        learnable(taught.motion, settings.autonomous_s),
        taught.object_position,
        view.scene.name if view.scene is not None else "",
        taught.condition,
        operator=settings.operator,
        alpha=settings.alpha,
        part=taught.part,
        method=Method.REFINE,
        request=intent,
    )


def learnable(motion: Motion, duration: float) -> Motion:
    """A motion in the tempo of an autonomous execution: a refinement ran slower than what it corrects."""
    return msgspec.structs.replace(motion, duration=duration)


def undoing(state: Workflow, view: View, settings: Settings) -> Step:
    """Have the model take its newest update back."""
    reply = ask(state, view, queries.UNDO, lambda intent: queries.Undo(operator=settings.operator, request=intent))
    match reply:
        case Step():
            return reply
        case queries.Refused(reason):
            return Step(to(state, Phase.DECIDING, view, owed=None, event=not_done(queries.UNDO, reason)))
        case _:
            undone = replace(state, last=None, updates=state.updates - 1, warned=False)
            return Step(to(undone, Phase.DECIDING, view, owed=None, event="The newest update was taken back."))
