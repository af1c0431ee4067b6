"""The history's region: what can be done with its rows, and how far what is taught next is to be believed."""

from __future__ import annotations

from services.station.page.entries import Rows
from services.station.page.values import Values
from services.station.page.view import Shown
from services.station.words.table import say

TURNS = ("take_back", "use_again")
CONTROLS = (*TURNS, "confidence")
"""What is pressed or slid there, as the workflow calls it; the last one counts at any time."""


def history(shown: Shown) -> Values:
    """Everything that the region shows beside its rows."""
    teaching, rows = shown.view.teaching, shown.view.history
    allowed = frozenset() if teaching is None else frozenset(teaching.actions)
    newest = "" if rows is None else rows.newest
    return {
        "action-undo@data-confirm": say("confirm.undo_named", what=newest) if newest else say("confirm.undo"),
        "history@data-allowed": " ".join(name for name in CONTROLS if name in allowed),
        "skill-count": "" if rows is None else _count(rows),
        "skill-older": say("skill.older", number=rows.older) if rows is not None and rows.older else "",
        "confidence@data-share": "" if teaching is None else f"{teaching.confidence:.2f}",
        "confidence-share": "" if teaching is None else say("skill.share", share=f"{100.0 * teaching.confidence:.0f}"),
    }


def _count(rows: Rows) -> str:
    if not rows.rows:
        return say("skill.empty")
    return say("skill.count", version=rows.version, used=rows.in_use, all=len(rows.rows))
