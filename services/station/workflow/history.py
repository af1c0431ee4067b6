"""What the model is told of its history: to take an entry back, to use it again. Nothing moves meanwhile or after."""

from __future__ import annotations

from dataclasses import replace

from protocol import queries
from services.station.words.table import say
from services.station.workflow.action import Action
from services.station.workflow.asking import ask, not_done, to
from services.station.workflow.settings import Settings
from services.station.workflow.state import Phase, Turning, Workflow
from services.station.workflow.view import Step, View

_TURNS = {Action.UNDO: False, Action.TAKE_BACK: False, Action.USE_AGAIN: True}
"""Whether the entry is in use afterwards."""


def named(learnt: queries.Learnt) -> str:
    """What the list calls an entry: it is called so wherever it is told of."""
    return say(f"skill.{learnt.purpose.value}", id=learnt.entry)


def turns(view: View) -> frozenset[Action]:
    """What can be done with the model's history: whatever is in use can be taken back, whatever is not used again."""
    if view.model is None or not view.model.version:
        return frozenset()
    newest = frozenset({Action.UNDO} if view.model.updates else ())
    return newest | {Action.TAKE_BACK, Action.USE_AGAIN}


def turn(state: Workflow, view: View, chosen: Action) -> Step:
    """Do it; where no entry is named, with the newest update."""
    argument = view.argument(chosen)
    if chosen is not Action.UNDO and not (argument.isascii() and argument.isdecimal()):
        return Step(state)
    skill = view.model.skill if view.model is not None else ""
    turning = Turning(int(argument) if chosen is not Action.UNDO else 0, _TURNS[chosen], skill)
    return Step(to(state, Phase.TURNING, view, taught=None, turning=turning))


def turning(state: Workflow, view: View, settings: Settings) -> Step:
    """Have the model take an entry back, or use it again; the robot may know another motion afterwards."""
    wanted = state.turning
    query = queries.REDO if wanted.in_use else queries.UNDO
    reply = ask(
        state,
        view,
        query,
        lambda intent: query.request(
            entry=wanted.entry, operator=settings.operator, skill=wanted.skill, request=intent
        ),
    )
    match reply:
        case Step():
            return reply
        case queries.Refused(reason):
            return Step(to(state, Phase.DECIDING, view, owed=None, event=not_done(query, reason)))
        case _:
            left = tuple(entry for entry in state.learnt if wanted.in_use or entry != reply.entry)
            turned = replace(state, last=None, learnt=left, warned=False)
            done = say("event.used_again" if wanted.in_use else "event.taken_back", what=named(reply))
            return Step(to(turned, Phase.DECIDING, view, owed=None, event=done))
