"""What whoever has no authority says all the same: it counts for nothing, and is counted."""

from __future__ import annotations

import logging

from protocol.messages import Figure
from services.process.lines import one_line

log = logging.getLogger(__name__)

UNUSUAL_HZ = 500.0
"""Stations and masters that only wait for the authority come to less; what is above is told."""


class Foreign:
    """Counts it, and tells of a flood."""

    def __init__(self) -> None:
        self._count = self._told = 0
        self._last = ""
        self._since_ns = 0

    def heard(self, process: str) -> None:
        """A process said something without authority."""
        self._count += 1
        self._last = process

    def figure(self, now_ns: int) -> Figure:
        """How much so far; a flood since the last call is told."""
        elapsed, self._since_ns = (now_ns - self._since_ns) / 1e9, now_ns
        new, self._told = self._count - self._told, self._count
        if new > UNUSUAL_HZ * elapsed:
            log.warning(
                "%s",
                one_line(
                    f"{new / elapsed:.0f} messages a second come without authority, the last of them from"
                    f" {self._last!r}: they count for nothing"
                ),
            )
        return Figure("without_authority", float(self._count), "messages")
