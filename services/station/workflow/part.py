"""Parts of a motion: what is left of one."""

from __future__ import annotations

from protocol.messages import Part


def common(one: Part, other: Part, shortest: float) -> Part | None:
    """The part that lies in both; None where it is shorter than some share of the motion."""
    first, last = max(one.first, other.first), min(one.last, other.last)
    return Part(first, last) if last - first >= shortest else None
