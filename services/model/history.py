"""What was learnt, entry by entry, and the model that those in use make."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import replace
from datetime import UTC, datetime

from lfd.models.model import MovementModel
from lfd.motion.demonstration import Demonstration
from lfd.motion.departure import Departure
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Binding, Counts, Made, Purpose, StoredDemonstration, Turn
from protocol import messages
from protocol.queries import ENTRIES_AT_ONCE, Entry, HistoryListed
from services.bus.arrays import vector3
from services.model.learning import Fit, learn_all
from services.process.exceptions import ServiceError

_NOTHING_BEFORE = -1.0
"""A departure where nothing was predicted before."""


class NoSuchEntry(ServiceError):
    """The history holds no entry of this number."""

    def __init__(self, entry: int) -> None:
        self.entry = entry
        super().__init__(f"the history holds no entry {entry}: choose one that it lists")


class History:
    """A skill's demonstrations on disk, and its model in memory.

    The model is made of those in use, in the order in which they came: what was taken back leaves no trace in it.

    Args:
        store: every demonstration that was ever added.
        binding: of the skill; what the file holds of another one is no part of the history.
        kind: of the model, a key of `models`.
        models: to choose from.
    """

    def __init__(self, store: DemonstrationStore, binding: Binding, kind: str, models: Mapping[str, Fit]) -> None:
        self._store = store
        self._binding = binding
        self._kind = kind
        self._models = models
        self.entries: tuple[StoredDemonstration, ...] = tuple(
            one for one in store.history() if one.binding.fits(binding)
        )
        self.model = self.made_of(self.in_use)
        self.version = store.version

    @property
    def in_use(self) -> list[StoredDemonstration]:
        """Those that the model is made of."""
        return [one for one in self.entries if one.in_use]

    @property
    def counts(self) -> Counts:
        """How many those are."""
        return Counts.of(self.in_use)

    def made_by(self, request: int) -> tuple[Made, Counts] | None:
        """What a request has changed already, in this process or in one before it, and what the model held then."""
        made = self._store.made_by(request) if request else None
        return None if made is None else (made, self._store.counts(made.version))

    def find(self, entry: int) -> StoredDemonstration:
        """An entry by its number.

        Raises:
            NoSuchEntry: there is none.
        """
        found = next((one for one in self.entries if one.version == entry), None)
        if found is None:
            raise NoSuchEntry(entry)
        return found

    def newest(self, purpose: Purpose) -> StoredDemonstration | None:
        """The newest in use of one purpose; None where there is none."""
        return next((one for one in reversed(self.entries) if one.in_use and one.purpose is purpose), None)

    def add(self, demonstration: Demonstration, purpose: Purpose, request: int) -> None:
        """Learn; on disk once this has returned.

        Raises:
            LfdError: the model cannot learn it, or it could not be written; all is as before.
        """
        entry = StoredDemonstration(self.version + 1, purpose, self._binding, demonstration)
        if purpose is Purpose.UPDATE and self.model is not None:
            candidate: MovementModel | None = self.model.updated(demonstration)
        else:
            candidate = self.made_of([*self.in_use, entry])
        departure = _departure(self.model, demonstration)
        version = self._store.add(demonstration, purpose, self._binding, request, departure)
        whose = demonstration.provenance
        turn = Turn(version, True, whose.author, whose.at_s)
        kept = replace(entry, version=version, departure=departure, turn=turn)
        self.entries, self.model, self.version = (*self.entries, kept), candidate, version

    def turn(self, entry: StoredDemonstration, *, in_use: bool, author: str, at_s: float, request: int) -> None:
        """Take an entry back, or use it again; on disk once this has returned.

        Raises:
            LfdError: it is so already, the model cannot be made, or the change could not be written; all is as before.
        """
        changes = self._store.redo if in_use else self._store.undo
        candidate = self.made_of(self._with(entry, in_use=in_use))
        version = changes(entry.version, request, author, at_s)
        turned = replace(entry, turn=Turn(version, in_use, author, at_s))
        self.entries = tuple(turned if one is entry else one for one in self.entries)
        self.model, self.version = candidate, version

    def compared(self, entry: StoredDemonstration) -> tuple[list[StoredDemonstration], list[StoredDemonstration]]:
        """What is in use with an entry, and without it, all others as they are."""
        return self._with(entry, in_use=True), self._with(entry, in_use=False)

    def made_of(self, stored: Sequence[StoredDemonstration]) -> MovementModel | None:
        """The model of some entries; None of none."""
        return learn_all(self._kind, stored, self._models)

    def listed(self, before: int) -> HistoryListed:
        """The newest entries, of those before a number where it is not 0."""
        asked = [one for one in reversed(self.entries) if not before or one.version < before]
        entries = tuple(told(one) for one in asked[:ENTRIES_AT_ONCE])
        return HistoryListed(self.version, entries, len(asked) - len(entries))

    def close(self) -> None:
        """Close the file."""
        self._store.close()

    def _with(self, entry: StoredDemonstration, *, in_use: bool) -> list[StoredDemonstration]:
        return [one for one in self.entries if (in_use if one is entry else one.in_use)]


def _departure(model: MovementModel | None, demonstration: Demonstration) -> Departure | None:
    if model is None:
        return None
    return Departure.of(demonstration.trajectory, model.predict(demonstration.situation).trajectory, demonstration.part)


def told(stored: StoredDemonstration) -> Entry:
    """An entry, as whoever asks is told of it."""
    given = stored.demonstration
    whose, departure, turn = given.provenance, stored.departure, stored.turn
    turned = turn is not None and turn.version != stored.version
    return Entry(
        id=stored.version,
        purpose=messages.Purpose(stored.purpose.value),
        method=messages.Method(whose.method.value),
        operator=whose.author,
        at=iso(whose.at_s),
        alpha=whose.confidence,
        part=messages.Part(*given.part),
        object_position=vector3(given.origin),
        mean=departure.mean if departure is not None else _NOTHING_BEFORE,
        most=departure.most if departure is not None else _NOTHING_BEFORE,
        in_use=stored.in_use,
        turned_by=turn.author if turn is not None and turned else "",
        turned_at=iso(turn.at_s) if turn is not None and turned else "",
    )


def iso(at_s: float | None) -> str:
    """A time since 1970-01-01 UTC [s] as ISO 8601; empty where it is not known."""
    try:
        return "" if at_s is None else datetime.fromtimestamp(at_s, UTC).isoformat(timespec="seconds")
    except (OverflowError, ValueError, OSError):  # a finite number that is no year's
        return ""
