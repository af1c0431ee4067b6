"""The history's region: what can be done with its rows, and how far what is taught next is to be believed."""

from __future__ import annotations

from services.bus.predictions import percent
from services.station.page.entries import Rows
from services.station.page.values import Values
from services.station.page.view import Shown

TURNS = ("take_back", "use_again")
CONTROLS = (*TURNS, "confidence")
"""What is pressed or slid there, as the workflow calls it; the last one counts at any time."""


def history(shown: Shown) -> Values:
    """Everything that the region shows beside its rows."""
    teaching, rows = shown.view.teaching, shown.view.history
    allowed = frozenset() if teaching is None else frozenset(teaching.actions)
    return {
        "history@data-turns": " ".join(name for name in TURNS if name in allowed),
        "history-count": "" if rows is None else _count(rows),
        "confidence@data-share": "" if teaching is None else f"{teaching.confidence:.2f}",
        "confidence-share": "" if teaching is None else percent(teaching.confidence),
    }


def _count(rows: Rows) -> str:
    older = f", {rows.older} older not shown" if rows.older else ""
    return f"version {rows.version}: {rows.in_use} of {len(rows.rows)} in use{older}"
