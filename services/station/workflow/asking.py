"""Moving on and asking: every phase is entered and every question is asked in these ways only.

An answer carries its question's number, and counts in the one state that waits for that number: whatever happens
between, it is neither lost nor taken for the answer to another question. A request that changes something carries the
number of its intent: the same while it is unanswered, another one once it was refused.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import replace
from typing import Any

import msgspec

from protocol.queries import Query, Refused
from services.bus.bus import Failed
from services.station.words.heard import heard
from services.station.words.table import say, speech
from services.station.workflow.state import Owed, Phase, Workflow
from services.station.workflow.view import Ask, Step, View

RETRY_S = 0.5

_OWING = frozenset({Phase.LEARNING, Phase.TURNING, Phase.CHOOSING})


def to(state: Workflow, phase: Phase, view: View, **changes: Any) -> Workflow:
    """The state in another phase; what belonged to the old one is left behind, but what is owed to the model."""
    entered: dict[str, Any] = {
        "question": 0,
        "intent": 0,
        "retry_s": 0.0,
        "wants": None,
        "going": None,
        "why": "",
        "asks": 0,
        "offered": frozenset(),
        "notice": "",
    }
    if state.phase in _OWING and state.intent:
        entered["owed"] = Owed(state.phase, state.intent)
    entered.update(changes)
    return replace(state, phase=phase, since_s=view.now_s, **entered)


def ask(
    state: Workflow, view: View, query: Query[Any, Any], request: Callable[[int], msgspec.Struct]
) -> Step | Refused | Any:
    """The reply or refusal, or the step to take while there is none; without an answer it is asked again.

    Args:
        state: of the workflow.
        view: what is seen.
        query: to ask.
        request: made of the intent's number.
    """
    if not state.question:
        if view.now_s < state.retry_s:
            return Step(state)
        asking = replace(state, question=view.number, intent=state.intent or view.number)
        return Step(asking, Ask(query, request(asking.intent), view.number))
    answer = view.answer
    if answer is None or answer.number != state.question:
        return Step(state)
    if isinstance(answer.outcome, Failed):
        notice = not_done(query, answer.outcome.reason)
        return Step(replace(state, question=0, retry_s=view.now_s + RETRY_S, notice=notice))
    return answer.outcome


def not_done(query: Query[Any, Any], reason: str) -> str:
    """A refusal or a failure in a line."""
    return say("event.not_done", what=_about(query), reason=heard(reason))


def _about(query: Query[Any, Any]) -> str:
    return speech.section("query").get(query.name.rpartition("/")[2], query.about)
