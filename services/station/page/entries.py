"""The history of the skill as rows: what was learnt, by whom, when and how, and how far it led from the prediction."""

from __future__ import annotations

import msgspec

from protocol.messages import Method, Part, Purpose
from protocol.queries import Entry, HistoryListed
from services.station.page.readout import length
from services.station.words.table import say


class Row(msgspec.Struct, frozen=True):
    """An entry in words; what is not known is left empty.

    Attributes:
        id: by which a press names it.
        what: it is.
        how: it was given.
        who: gave it.
        at: when; see `protocol.history.Entry`.
        moved: how far it led from what was predicted.
        believed: how far, where that is not all the way, and of which part it speaks.
        is_update: the model learnt it later; else it is one of those that it starts from.
        in_use: the model is made of it.
        turned: who took it back or into use again.
        turned_at: when.
    """

    id: int
    what: str
    how: str
    who: str
    at: str
    moved: str
    believed: str
    is_update: bool
    in_use: bool
    turned: str
    turned_at: str


class Rows(msgspec.Struct, frozen=True):
    """A history.

    Attributes:
        version: of the model.
        rows: the newest first.
        older: how many there are beyond them.
        edition: another one whenever the model or the skill has become another one.
    """

    version: int
    rows: tuple[Row, ...]
    older: int
    edition: int = 0

    @property
    def newest(self) -> str:
        """What is taken back where nothing else is named; empty where there is no such row."""
        return next((row.what for row in self.rows if row.in_use and row.is_update), "")

    @property
    def in_use(self) -> int:
        """How many of the rows the model is made of."""
        return sum(row.in_use for row in self.rows)


def rows_of(listed: HistoryListed, edition: int = 0) -> Rows:
    """What the model lists, for people."""
    return Rows(listed.version, tuple(_row(entry) for entry in listed.entries), listed.older, edition)


def _row(entry: Entry) -> Row:
    return Row(
        id=entry.id,
        what=say(f"skill.{entry.purpose.value}", id=entry.id),
        how=say(f"skill.{entry.method.value}") if entry.method is not Method.UNKNOWN else "",
        who=entry.operator,
        at=entry.at,
        moved=_moved(entry),
        believed=_believed(entry),
        is_update=entry.purpose is Purpose.UPDATE,
        in_use=entry.in_use,
        turned=_turned(entry),
        turned_at=entry.turned_at,
    )


def _moved(entry: Entry) -> str:
    """Nothing was predicted before where it is negative."""
    return "" if entry.most < 0.0 else say("skill.moved", most=length(entry.most), mean=length(entry.mean))


def _believed(entry: Entry) -> str:
    share = "" if entry.alpha == 1.0 else say("skill.believed", share=_percent(entry.alpha))
    first, last = _percent(entry.part.first), _percent(entry.part.last)
    part = "" if entry.part == Part() else say("skill.part", first=first, last=last)
    return ", ".join(words for words in (share, part) if words)


def _turned(entry: Entry) -> str:
    if entry.in_use and not entry.turned_at and not entry.turned_by:
        return ""
    turn = "used_again" if entry.in_use else "taken_back"
    return say(f"skill.{turn}_by", name=entry.turned_by) if entry.turned_by else say(f"skill.{turn}")


def _percent(share: float) -> str:
    return f"{100.0 * share:.0f}"
