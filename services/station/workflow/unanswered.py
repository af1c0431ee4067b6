"""A motion that waits to be answered while the authority is lost and comes back: for a moment its buttons stay.

A short outage else takes the button away from under the pointer. What is pressed meanwhile is done once the authority
is back; after a longer one the operator is asked anew.
"""

from __future__ import annotations

from dataclasses import replace

from services.station.workflow.action import Action
from services.station.workflow.state import Phase, Unanswered, Workflow
from services.station.workflow.view import View

STAYS_S = 2.0
"""So long the buttons stay, and what is pressed counts."""

ANSWERS = frozenset({Action.FINISH, Action.GO_ON})


def kept(state: Workflow, view: View) -> Unanswered | None:
    """What is still to be answered where the authority is lost now; None where nothing is."""
    asked = state.phase is Phase.EXECUTING and Action.GO_ON in state.offered
    return Unanswered(view.now_s, state.wants if state.wants in ANSWERS else None) if asked else None


def heard(state: Workflow, view: View) -> Workflow:
    """With what was pressed without the authority, and without the buttons once they have stayed long enough."""
    unanswered = state.unanswered
    if unanswered is None:
        return state
    if view.now_s - unanswered.since_s > STAYS_S:
        return replace(state, unanswered=None, offered=state.offered - ANSWERS)
    pressed = next((action for action in Action if action in view.actions & ANSWERS), unanswered.answer)
    return replace(state, unanswered=replace(unanswered, answer=pressed), offered=ANSWERS)
