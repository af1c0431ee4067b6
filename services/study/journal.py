"""The journal: a study's raw data, a file that is only ever appended to, and by one process at a time.

What `add` returned from is on the disk. Each line is chained to all before (services.process.chained). Deletion on a
participant's wish is the one thing that changes what was written: a tombstone takes each line's place, and says what
digest was there, so that whoever noted a digest earlier sees what was taken out, and that nothing else was.
"""

from __future__ import annotations

import fcntl
import os
from collections.abc import Callable
from datetime import datetime
from pathlib import Path
from typing import TypeVar

import msgspec

from services.process.chained import ORIGIN, Line, sealed
from services.process.exceptions import CannotWrite
from services.process.files import make_folder, settle_names, write_whole
from services.study.events import Entry, Erased, Event, Repaired
from services.study.exceptions import JournalBroken, StudyInUse

FILE = "journal.jsonl"

_LINES = msgspec.json.Decoder(Line)
_ENTRIES = msgspec.json.Decoder(Entry)

E = TypeVar("E")


class Journal:
    """Of one study, open for writing; a context manager.

    Attributes:
        entries: all, the oldest first.

    Args:
        folder: of the raw data; it is made.
        utc: the time of day.
        marked: called with every entry that is added, once it is on the disk.

    Raises:
        StudyInUse: another process has it open.
        JournalBroken: it is not as it was written.
        CannotWrite: it cannot be opened.
    """

    def __init__(
        self, folder: Path, utc: Callable[[], datetime], marked: Callable[[Entry], None] = lambda _: None
    ) -> None:
        self.entries: list[Entry] = []
        self._path = folder / FILE
        self._utc = utc
        self._marked = marked
        self._chain = ORIGIN
        self._file = self._opened(folder)
        try:
            self._resume()
        except BaseException:
            self.close()
            raise

    def __enter__(self) -> Journal:
        """It is open already."""
        return self

    def __exit__(self, *_: object) -> None:
        """Close it."""
        self.close()

    def add(self, event: Event) -> Entry:
        """Write an event down; on the disk when this returns.

        Raises:
            CannotWrite: it is not; what was there is as it was.
        """
        entry = Entry(number=len(self.entries) + 1, at=self._utc().isoformat(timespec="milliseconds"), event=event)
        line, chain = sealed(entry, self._chain)
        end = os.fstat(self._file).st_size
        try:
            if os.write(self._file, line) != len(line):
                raise OSError("there is no room")
            os.fsync(self._file)
        except OSError as error:
            os.ftruncate(self._file, end)
            raise CannotWrite(self._path, error.strerror or str(error)) from None
        self._chain = chain
        self.entries.append(entry)
        self._marked(entry)
        return entry

    def erase(self, participant: int, erasable: Callable[[Event], bool]) -> int:
        """Put a tombstone in the place of each line of a participant; how many.

        Args:
            participant: number.
            erasable: which of their events are.
        """
        chain, lines, kept, erased = ORIGIN, [], [], 0
        for entry, line in zip(self.entries, _lines(self._path), strict=True):
            event = entry.event
            if getattr(event, "participant", None) == participant and erasable(event):
                tombstone = Erased(participant=participant, was=line.chain)
                entry, erased = msgspec.structs.replace(entry, event=tombstone), erased + 1  # noqa: PLW2901 - the line's
            written, chain = sealed(entry, chain)
            lines.append(written)
            kept.append(entry)
        if erased:
            write_whole(self._path, b"".join(lines))
            old, self._file = self._file, self._locked()
            os.close(old)
            self.entries, self._chain = kept, chain
        return erased

    def close(self) -> None:
        """Let another process have it."""
        os.close(self._file)

    def _opened(self, folder: Path) -> int:
        try:
            make_folder(folder)
            file = self._locked()
            settle_names(folder)
        except BlockingIOError:
            raise StudyInUse(folder.parent) from None
        except OSError as error:
            raise CannotWrite(self._path, error.strerror or str(error)) from None
        return file

    def _locked(self) -> int:
        file = os.open(self._path, os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC, 0o600)
        try:
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError:
            os.close(file)
            raise
        return file

    def _resume(self) -> None:
        """Read what is there, and cut off what a power cut left of the last line: nobody was told that it is there."""
        whole = 0
        for line, entry, text in _read(self._path):
            self._chain, whole = line.chain, whole + len(text)
            self.entries.append(entry)
        torn = os.fstat(self._file).st_size - whole
        if torn:
            os.ftruncate(self._file, whole)
            self.add(Repaired(size=torn))


def check_closed(folder: Path) -> None:
    """Let a journal pass that no process has open for writing now; one may in a moment.

    Raises:
        StudyInUse: one has.
        CannotWrite: it cannot be opened.
    """
    path = folder / FILE
    if not path.exists():
        return
    try:
        with path.open("rb") as file:
            fcntl.flock(file, fcntl.LOCK_SH | fcntl.LOCK_NB)
    except BlockingIOError:
        raise StudyInUse(folder.parent) from None
    except OSError as error:
        raise CannotWrite(path, error.strerror or str(error)) from None


def read(folder: Path) -> list[Entry]:
    """What a journal holds, without opening it for writing; a line that is being written is left out.

    Raises:
        JournalBroken: it is not as it was written.
    """
    return [entry for _, entry, _ in _read(folder / FILE)]


def _read(path: Path) -> list[tuple[Line, Entry, bytes]]:
    """Every whole line.

    Raises:
        JournalBroken: one is not as it was written.
    """
    chain, found = ORIGIN, []
    texts = path.read_bytes().splitlines(keepends=True) if path.exists() else []
    for at, text in enumerate(texts, 1):
        if not text.endswith(b"\n") and at == len(texts):
            break
        try:
            line = _LINES.decode(text)
        except (ValueError, RecursionError):
            raise JournalBroken(path, at, "it is none of the journal's") from None
        if not line.follows(chain):
            raise JournalBroken(path, at, "it was changed, or something before it was changed or taken out")
        try:
            entry = _ENTRIES.decode(line.entry)
        except (ValueError, RecursionError):
            raise JournalBroken(path, at, "another version of Retouch wrote it: read it with that one") from None
        chain = line.chain
        found.append((line, entry, text))
    return found


def _lines(path: Path) -> list[Line]:
    return [line for line, _, _ in _read(path)]
