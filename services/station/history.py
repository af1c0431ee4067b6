"""Asks the model for its history when it has become another one, and what an entry changes where a tab asks for it."""

from __future__ import annotations

from typing import Any, Protocol

from protocol import queries
from protocol.messages import ModelState, Purpose, Vector3
from protocol.queries import Compare, Compared, Effect, Entry, HistoryListed, ListHistory, Refused
from services.bus.bus import Bus, Pending
from services.station.page.entries import Rows, rows_of
from services.station.skills import SkillsReader

TIMEOUT_S = 2.0
AGAIN_NS = 200_000_000
"""After an answer that says nothing yet, or none."""


class Wanted(Protocol):
    """What entries of the history change, as far as somebody wants to see it."""

    def wanted(self) -> int | None:
        """The entry that is wanted next; None for none."""
        ...

    def put(self, version: int, entry: int, effect: Effect | Refused) -> None:
        """What an entry changes, or why that cannot be said."""
        ...

    def renew(self, version: int) -> None:
        """The model has become another one."""
        ...


def _is_first(entry: Entry) -> bool:
    return entry.in_use and entry.purpose is Purpose.INITIAL


class HistoryReader:
    """What is known of the model's history, and of the robot's other skills.

    Attributes:
        rows: of all of it.
        kept_at: where the object stood in the first demonstrations that are in use [m].

    Args:
        bus: to the model.
        effects: that the page wants to see.
    """

    def __init__(self, bus: Bus, effects: Wanted) -> None:
        self._bus = bus
        self._effects = effects
        self._asked: tuple[int, Pending[Any]] | None = None
        self._next_ns = 0
        self._of = ""
        self._edition = 0
        self.rows: Rows | None = None
        self.kept_at: tuple[Vector3, ...] = ()
        self.skills = SkillsReader(bus)

    def step(self, now_ns: int, model: ModelState | None) -> None:
        """Take what has come, and ask for what is missing: one question at a time."""
        self.skills.step(now_ns, model)
        if self._asked is not None:
            entry, pending = self._asked
            outcome = pending.poll()
            if outcome is None:
                return
            self._asked = None
            self._take(entry, outcome, now_ns)
        if model is None or now_ns < self._next_ns:
            return
        if model.skill != self._of:
            self._of, self.rows = model.skill, None
        if self.rows is None or self.rows.version != model.version:
            self._asked = 0, self._bus.ask(queries.HISTORY, ListHistory(), TIMEOUT_S)
        elif (wanted := self._effects.wanted()) is not None:
            self._asked = wanted, self._bus.ask(queries.COMPARE, Compare(wanted), TIMEOUT_S)

    def _take(self, entry: int, outcome: Any, now_ns: int) -> None:
        match outcome:
            case HistoryListed():
                self._edition += 1
                self.rows = rows_of(outcome, self._edition)
                self.kept_at = tuple(entry.object_position for entry in outcome.entries if _is_first(entry))
                self._effects.renew(self._edition)
            case Compared(version, effect) if effect is not None and self._is(version):
                self._effects.put(self._edition, entry, effect)
            case Refused() if entry and self.rows is not None:
                self._effects.put(self._edition, entry, outcome)
            case _:
                self._next_ns = now_ns + AGAIN_NS

    def _is(self, version: int) -> bool:
        return self.rows is not None and self.rows.version == version
