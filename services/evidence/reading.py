"""The log as it is found: each entry, and whether it is as it was written."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from pathlib import Path

from services.evidence.entry import Entry, Line, read
from services.evidence.events import Repaired
from services.evidence.exceptions import NoLog
from services.process.chained import ORIGIN


@dataclass(frozen=True)
class Found:
    """A line of the log.

    Attributes:
        line: its number in the file, from 1.
        entry: what was written there; None where this version does not know it.
        chain: its digest.
        fault: what is wrong there, empty where nothing is.
    """

    line: int
    entry: Entry | None
    chain: str
    fault: str = ""


@dataclass(frozen=True)
class Account:
    """What a log is worth.

    Attributes:
        entries: in it.
        head: digest of the newest one.
        faults: lines of the file with what is wrong there.
        known: the digest that was asked for is one of them, or nothing was asked for.
        unfinished: bytes at the end that are no line yet.
    """

    entries: int
    head: str
    faults: tuple[tuple[int, str], ...]
    known: bool
    unfinished: int

    @property
    def whole(self) -> bool:
        """Nothing was changed, and nothing left out but what may be missing behind the newest known digest."""
        return self.known and not self.faults


class Reader:
    """Goes through a log once.

    Attributes:
        unfinished: bytes at the end that are no line yet, once it is through.

    Args:
        path: of the log.
    """

    def __init__(self, path: Path) -> None:
        self.unfinished = 0
        self._path = path

    def __iter__(self) -> Iterator[Found]:
        """Every line, the oldest first; what was not written to its end goes with the line that tells of it.

        Raises:
            NoLog: there is none, or it cannot be read.
        """
        chain, number, torn = ORIGIN, 0, 0
        try:
            with self._path.open("rb") as file:
                for at, text in enumerate(file, 1):
                    line = read(text)
                    if line is None:
                        torn += len(text)
                        continue
                    yield Found(at, line.content, line.chain, _fault(line, chain, number, torn))
                    chain, number, torn = line.chain, line.number, 0
        except OSError as error:
            raise NoLog(self._path, error.strerror or str(error)) from None
        self.unfinished = torn


def verify(path: Path, known: str = "") -> Account:
    """Go through a log.

    Args:
        path: of it.
        known: a digest that was noted elsewhere, at any time; empty for none.

    Raises:
        NoLog: there is none, or it cannot be read.
    """
    entries, head, faults = 0, ORIGIN, []
    seen = not known
    reader = Reader(path)
    for found in reader:
        entries, head = entries + 1, found.chain
        seen = seen or found.chain == known
        if found.fault:
            faults.append((found.line, found.fault))
    return Account(entries, head, tuple(faults), seen, reader.unfinished)


def _fault(line: Line, chain: str, number: int, torn: int) -> str:
    """What is wrong with a line that comes after that digest and number, and after so many bytes that are no line."""
    if not line.follows(chain) or line.number != number + 1:
        return "it was changed, or something before it was changed or taken out"
    event = line.content.event if line.content is not None else None
    told = event.size if isinstance(event, Repaired) else 0
    if torn != told:
        return f"{torn} bytes before it are no entry, and it tells of {told}"
    return ""
