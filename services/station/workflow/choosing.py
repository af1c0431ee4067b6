"""Which of the robot's skills is used: chosen by its name, or made anew. Nothing moves meanwhile or after."""

from __future__ import annotations

from dataclasses import replace

from protocol import queries
from protocol.messages import Origin
from services.station.words.table import say
from services.station.workflow import guiding
from services.station.workflow.action import Action
from services.station.workflow.approach import Approach
from services.station.workflow.asking import ask, not_done, to
from services.station.workflow.closure import Closure
from services.station.workflow.guide import Guide
from services.station.workflow.settings import Settings
from services.station.workflow.state import WHOLE, Choosing, Phase, Workflow
from services.station.workflow.view import Step, View

LONGEST_NAME = 64
"""Of a skill, in a message."""


def choices(view: View) -> frozenset[Action]:
    """A model that is heard can be told of another skill."""
    return frozenset() if view.model is None else frozenset({Action.SKILL, Action.NEW_SKILL})


def choose(state: Workflow, view: View, chosen: Action) -> Step:
    """Have the model use the skill that was pressed, or make the one that was named."""
    name = view.argument(chosen)
    if not 0 < len(name) <= LONGEST_NAME:
        return Step(state)
    return Step(to(state, Phase.CHOOSING, view, choosing=Choosing(name, chosen is Action.NEW_SKILL)))


def choosing(state: Workflow, view: View, settings: Settings) -> Step:
    """What was predicted, shown and counted was of the skill before: all of it begins anew, the target stays."""
    wanted = state.choosing
    reply = ask(
        state,
        view,
        queries.CHOOSE_SKILL,
        lambda intent: queries.ChooseSkill(wanted.name, wanted.new, operator=settings.operator, request=intent),
    )
    match reply:
        case Step():
            return reply
        case queries.Refused(reason):
            event = not_done(queries.CHOOSE_SKILL, reason)
            return Step(to(state, Phase.DECIDING, view, owed=None, event=event))
        case _:
            other = replace(
                state,
                prediction=None,
                taught=None,
                last=None,
                refinements=0,
                learnt=(),
                warned=False,
                origin=Origin.MODEL,
                part=WHOLE,
                closure=Closure(),
                guide=Guide(),
                approach=Approach(state.approach.method),
            )
            said = say("event.made_skill" if wanted.new else "event.chose_skill", skill=reply.state.skill)
            known = guiding.told_by(other, reply.state, view, settings)
            return Step(to(known, Phase.DECIDING, view, owed=None, event=said))
