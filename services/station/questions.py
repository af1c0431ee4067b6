"""The question that the workflow asks, and the answer to it."""

from __future__ import annotations

from typing import Any

from services.bus.bus import Bus, Pending
from services.station.workflow.view import Answer, Ask

QUERY_TIMEOUT_S = 5.0


class Questions:
    """One at a time: the workflow knows what it waits for.

    Args:
        bus: to the other processes.
    """

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._asked: tuple[int, Pending[Any]] | None = None

    def ask(self, ask: Ask) -> None:
        """Ask, instead of what was asked before."""
        self._asked = ask.number, self._bus.ask(ask.query, ask.request, QUERY_TIMEOUT_S)

    def answer(self) -> Answer | None:
        """To the question asked last, in every view until another is asked; None where there is none yet."""
        if self._asked is None:
            return None
        number, pending = self._asked
        outcome = pending.poll()
        return Answer(number, outcome) if outcome is not None else None
