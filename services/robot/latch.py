"""The emergency stop as the robot latches it: who pressed it, why and when, and who released it."""

from __future__ import annotations

import msgspec

from protocol.messages import Name, Text

LONGEST_REASON = 500
"""Characters of a reason that are kept: with the words around it, it fits into every message that repeats it."""


class Latch(msgspec.Struct, frozen=True, kw_only=True):
    """Pressed: no motion until it is released.

    Attributes:
        latched: it is.
        by: who pressed it first.
        reason: as given with it.
        at: when it was latched, or released where it is not: UTC, ISO 8601; empty for never.
        released_by: who released it last; empty while it is latched, or for never.
    """

    latched: bool = False
    by: Name = ""
    reason: Text = ""
    at: Name = ""
    released_by: Name = ""

    def pressed(self, by: str, reason: str, at: str) -> Latch:
        """Latch; the first press keeps its author, reason and time."""
        return self if self.latched else Latch(latched=True, by=by, reason=reason[:LONGEST_REASON], at=at)

    def released(self, by: str, at: str) -> Latch:
        """Let go; who pressed and why stays known."""
        return msgspec.structs.replace(self, latched=False, at=at, released_by=by)

    def __str__(self) -> str:
        """For people."""
        return f"emergency stop by {self.by}" + (f": {self.reason}" if self.reason else "")
