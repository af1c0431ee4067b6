"""Where events are written: a file that is only ever appended to, by a thread that nobody waits for."""

from __future__ import annotations

import fcntl
import logging
import os
from collections import deque
from collections.abc import Callable
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from datetime import UTC, datetime
from pathlib import Path
from typing import Protocol

from protocol.names import checked_name
from services.evidence.entry import LONGEST, Entry, read
from services.evidence.events import Event, Repaired
from services.process.chained import ORIGIN, sealed
from services.process.files import make_folder, settle_names, state_folder

log = logging.getLogger(__name__)

FILE = "evidence.jsonl"


class Ledger(Protocol):
    """Takes events in the order in which they happened."""

    @property
    def unwritten(self) -> int:
        """Events that are not on the disk yet, or cannot be brought there."""
        ...

    def add(self, event: Event) -> None:
        """Write an event down; returns at once."""
        ...

    def close(self) -> None:
        """Finish writing."""
        ...


class Unkept:
    """Keeps nothing: for robots that are simulated within one process. See `Ledger`."""

    unwritten = 0

    def add(self, event: Event) -> None:
        """Forget it."""

    def close(self) -> None:
        """Nothing is being written."""


class LedgerFile:
    """Appends to a file, and flushes it to the disk. See `Ledger`.

    What could not be written stays, and is tried again with the next event.

    Args:
        path: of the file; its folder is made.
        executor: that writes, one entry after another.
        utc: the time of day.
    """

    def __init__(self, path: Path, executor: Executor, utc: Callable[[], datetime]) -> None:
        self._path = path
        self._executor = executor
        self._utc = utc
        self._waiting: deque[tuple[str, Event]] = deque()
        self._writing: Future[None] | None = None
        self._file: int | None = None
        self._number, self._chain = 0, ORIGIN
        self._fault = ""

    @property
    def unwritten(self) -> int:
        """See `Ledger.unwritten`."""
        return len(self._waiting)

    def add(self, event: Event) -> None:
        """See `Ledger.add`."""
        self._waiting.append((self._now(), event))
        if self._writing is None or self._writing.done():
            self._writing = self._executor.submit(self._write)

    def close(self) -> None:
        """See `Ledger.close`."""
        self._executor.submit(self._write)
        self._executor.shutdown()
        if self._file is not None:
            os.close(self._file)
            self._file = None

    def _write(self) -> None:
        """Bring all that waits to the disk, or say why not, once."""
        try:
            while self._waiting:
                self._append()
        except OSError as error:
            fault = f"the evidence log is not written: {self._path}: {error.strerror or error}"
            if fault != self._fault:
                log.error("%s", fault)
            self._fault = fault
        else:
            self._fault = ""

    def _append(self) -> None:
        """Write one line: of several that are written at once a power cut may leave the last and not the first."""
        file = self._file = self._opened() if self._file is None else self._file
        at, event = self._waiting[0]
        line, chain = sealed(Entry(number=self._number + 1, at=at, event=event), self._chain)
        try:
            if os.write(file, line) != len(line):
                raise OSError(f"no room for {len(line)} bytes")
            os.fsync(file)
        except OSError:
            # What lies there now is found out when it is opened again.
            os.close(file)
            self._file = None
            raise
        self._number, self._chain = self._number + 1, chain
        self._waiting.popleft()

    def _opened(self) -> int:
        """The file, locked, with its end known and whole."""
        make_folder(self._path.parent)
        file = os.open(self._path, os.O_RDWR | os.O_APPEND | os.O_CREAT | os.O_CLOEXEC, 0o644)
        try:
            settle_names(self._path.parent)
            fcntl.flock(file, fcntl.LOCK_EX | fcntl.LOCK_NB)
            self._resume(file)
        except BlockingIOError:
            os.close(file)
            raise OSError("another process writes it") from None
        except OSError:
            os.close(file)
            raise
        return file

    def _resume(self, file: int) -> None:
        """Go on after the last whole line; what lies behind it is told to be none."""
        size = os.fstat(file).st_size
        tail = os.pread(file, 2 * LONGEST, max(0, size - 2 * LONGEST))
        self._number, self._chain, torn = 0, ORIGIN, 0
        for text in reversed(tail.splitlines(keepends=True)):
            line = read(text)
            if line is not None:
                self._number, self._chain = line.number, line.chain
                break
            torn += len(text)
        if torn:
            if not tail.endswith(b"\n"):
                torn += os.write(file, b"\n")
            self._waiting.appendleft((self._now(), Repaired(size=torn)))

    def _now(self) -> str:
        return self._utc().isoformat(timespec="milliseconds")


def ledger_file(robot: str) -> LedgerFile:
    """The log of a robot, in the user's state folder.

    Raises:
        InvalidName: the robot's name cannot be one.
        FolderUnusable: there is no such folder.
    """
    return LedgerFile(path_of(robot), ThreadPoolExecutor(1, "evidence"), lambda: datetime.now(UTC))


def path_of(robot: str) -> Path:
    """Where the log of a robot lies.

    Raises:
        InvalidName: the robot's name cannot be one.
        FolderUnusable: there is no such folder.
    """
    return state_folder() / checked_name(robot) / FILE
