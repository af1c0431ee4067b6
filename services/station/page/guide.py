"""What leads whoever shows an empty skill its first motions: at which place, and what is next there."""

from __future__ import annotations

from protocol.messages import ShowStep
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say

STEPS = tuple(step.value for step in ShowStep)
"""In order; their words are in the section "showing"."""


def guide(shown: Shown) -> Values:
    """The steps, and which of them is done, next or to come; not there where the skill has its first motions."""
    teaching = shown.view.teaching
    showing = None if teaching is None else teaching.showing
    if showing is None:
        return {"showing@hidden": True}
    now = STEPS.index(showing.step.value)
    return {
        "showing@hidden": False,
        "showing@data-step": showing.step.value,
        "showing-of": say("showing.of", number=showing.place, places=showing.places),
        **{f"showing-{name}@data-state": _state(number, now) for number, name in enumerate(STEPS)},
        **{f"showing-{name}@aria-current": "step" if number == now else "false" for number, name in enumerate(STEPS)},
    }


def _state(number: int, now: int) -> str:
    if number == now:
        return "now"
    return "done" if number < now else "later"
