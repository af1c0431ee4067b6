"""Parts of a motion: what is left of one, and how it is said."""

from __future__ import annotations

from protocol.messages import Part
from services.bus.predictions import percent


def common(one: Part, other: Part, shortest: float) -> Part | None:
    """The part that lies in both; None where it is shorter than some share of the motion."""
    first, last = max(one.first, other.first), min(one.last, other.last)
    return Part(first, last) if last - first >= shortest else None


def extent(part: Part) -> str:
    """From where to where a part is, to be put behind a sentence; empty for the whole motion."""
    if part == Part():
        return ""
    if part.first == 0.0:
        return f" up to {percent(part.last)} of the motion"
    if part.last == 1.0:
        return f" from {percent(part.first)} of the motion on"
    return f" from {percent(part.first)} to {percent(part.last)} of the motion"
