"""One line of the log: an event, its number and time, chained to all that came before.

A line is JSON: `{"chain": C, "entry": E}`. E is the entry as it was written, byte for byte, and C the SHA-256 digest of
the line's predecessor's digest and E, in hexadecimal, so that whoever knows the newest digest knows every line
(S. Haber, W. S. Stornetta, How to time-stamp a digital document, J. Cryptology 3, 1991, section 5.1).
"""

from __future__ import annotations

import hashlib

import msgspec

from protocol.messages import Count
from services.evidence.events import Event

ORIGIN = "0" * 64
"""The digest before the first line."""

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


class Line(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """An entry as it lies in the file."""

    chain: str
    entry: msgspec.Raw

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

    def follows(self, chain: str) -> bool:
        """Whether it was written after the line of this digest, and is as it was written."""
        return self.chain == digest(chain, bytes(self.entry))


_NUMBERS = msgspec.json.Decoder(_Numbered)
_ENTRIES = msgspec.json.Decoder(Entry)
_LINES = msgspec.json.Decoder(Line)


def digest(chain: str, entry: bytes) -> str:
    """Of a line, from its predecessor's digest and its entry."""
    return hashlib.sha256(chain.encode() + entry).hexdigest()


def written(entry: Entry, chain: str) -> tuple[bytes, str]:
    """A line with its end, and its digest, after the line of the digest `chain`."""
    raw = msgspec.json.encode(entry)
    after = digest(chain, raw)
    return msgspec.json.encode(Line(after, msgspec.Raw(raw))) + b"\n", after


def read(text: bytes) -> Line | None:
    """A line with its end; None where it is none."""
    try:
        line = _LINES.decode(text) if text.endswith(b"\n") else None
        return line if line is not None and line.number else None
    except (ValueError, RecursionError):  # no UTF-8 among them
        return None
