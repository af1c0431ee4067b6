"""One line of the log: an event, its number and time, chained to all that came before (services.process.chained)."""

from __future__ import annotations

import msgspec

from protocol.messages import Count
from services.evidence.events import Event
from services.process import chained

LONGEST = 65_536
"""Bytes of a line, at most."""


class Entry(msgspec.Struct, frozen=True, kw_only=True, forbid_unknown_fields=True):
    """What was written down.

    Attributes:
        number: counts from 1.
        at: when, UTC by the robot's clock, ISO 8601.
        event: what happened.
    """

    number: Count
    at: str
    event: Event


class _Numbered(msgspec.Struct, frozen=True):
    """What is known of an entry of any version."""

    number: Count


class Line(chained.Line, frozen=True, forbid_unknown_fields=True):
    """An entry as it lies in the file."""

    @property
    def number(self) -> int:
        """Of the entry."""
        return _NUMBERS.decode(self.entry).number

    @property
    def content(self) -> Entry | None:
        """The entry; None where it tells of something that this version does not know."""
        try:
            return _ENTRIES.decode(self.entry)
        except (ValueError, RecursionError):
            return None


_NUMBERS = msgspec.json.Decoder(_Numbered)
_ENTRIES = msgspec.json.Decoder(Entry)
_LINES = msgspec.json.Decoder(Line)


def read(text: bytes) -> Line | None:
    """A line with its end; None where it is none."""
    try:
        line = _LINES.decode(text) if text.endswith(b"\n") else None
        return line if line is not None and line.number else None
    except (ValueError, RecursionError):  # no UTF-8 among them
        return None
