"""A SQLite file as the store uses it: every change whole and on the disk, every failure in this package's words."""

import os
import sqlite3
import tempfile
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from pathlib import Path
from typing import Any, NamedTuple

from lfd.exceptions import StorageError, StorageUnavailable

BUSY_TIMEOUT = 1.0  # [s] how long a statement waits for another connection's lock


class _Cause(NamedTuple):
    """Why a sound file cannot be used, what to do, and whether waiting helps."""

    reason: str
    remedy: str
    passes: bool


_HELD = _Cause("another process holds it", "end that process, or wait until it is done", passes=True)
_READ_ONLY = _Cause("it cannot be written", "make the file and its folder writable", passes=False)

_UNAVAILABLE = {
    sqlite3.SQLITE_BUSY: _HELD,
    sqlite3.SQLITE_LOCKED: _HELD,
    sqlite3.SQLITE_READONLY: _READ_ONLY,
    sqlite3.SQLITE_PERM: _READ_ONLY,
    sqlite3.SQLITE_FULL: _Cause("the disk is full", "make room on it", passes=True),
    sqlite3.SQLITE_IOERR: _Cause("the disk does not take it", "check the disk and the room on it", passes=True),
    sqlite3.SQLITE_CANTOPEN: _Cause("it cannot be opened", "check that its folder may be used", passes=False),
    sqlite3.SQLITE_NOMEM: _Cause("there is not enough memory", "end other programs", passes=True),
}
"""What is no fault of the file, by SQLite's primary result code."""

_PRIMARY = 0xFF  # SQLite's extended result codes carry the primary one in their lowest byte


class Connection:
    """One connection to a file. Not shared between threads; other processes may use the same file.

    Args:
        path: The file; it is made if it is missing, its folder is not.

    Raises:
        StorageUnavailable: The file cannot be opened.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        with self.errors():
            self._connection = sqlite3.connect(path, timeout=BUSY_TIMEOUT, isolation_level=None)

    def close(self) -> None:
        """Close the file. What was committed is already in it."""
        self._connection.close()

    def rows(self, statement: str, parameters: Sequence[object] = ()) -> list[tuple[Any, ...]]:
        """Carry out a statement, parameters in place of its question marks.

        Returns:
            What it finds.

        Raises:
            StorageError: It fails.
        """
        with self.errors():
            return self._connection.execute(statement, parameters).fetchall()

    def value(self, statement: str, parameters: Sequence[object] = ()) -> Any:
        """The first value of the first row that a statement finds; raises as `rows`."""
        return self.rows(statement, parameters)[0][0]

    def use_log(self) -> None:
        """Write ahead, and fully synchronised, so that a committed change outlives a power cut; raises as `rows`."""
        for statement in ("journal_mode = WAL", "synchronous = FULL"):
            self.rows(f"PRAGMA {statement}")

    def copy_to(self, target: Path) -> None:
        """Copy all that is committed into a file, which is there whole or not at all.

        Args:
            target: Of the copy; one that is there is replaced.

        Raises:
            StorageError: It could not be written.
        """
        try:
            handle, name = tempfile.mkstemp(dir=target.parent, prefix=f".{target.name}-", suffix=".part")
        except OSError as error:
            raise StorageUnavailable(
                target, error.strerror or str(error), "check that its folder may be used", passes=False
            ) from None
        part = Path(name)
        try:
            self.rows("VACUUM INTO ?", (name,))
            os.fchmod(handle, self.path.stat().st_mode & 0o777)
            os.fsync(handle)
            part.replace(target)
        finally:
            os.close(handle)
            part.unlink(missing_ok=True)

    def settle(self) -> None:
        """Bring everything into the one file, which no log stands beside any more; only where nobody else uses it.

        Raises:
            StorageUnavailable: Another process uses it.
            StorageError: It fails.
        """
        self.rows("PRAGMA journal_mode = DELETE")

    @contextmanager
    def transaction(self) -> Iterator[None]:
        """All or nothing; committed to the disk on leaving.

        Raises:
            StorageError: It could not be written; the file is as before.
        """
        with self.errors():
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield
                self._connection.execute("COMMIT")
            except BaseException:
                if self._connection.in_transaction:  # a full disk has already rolled back
                    self._connection.execute("ROLLBACK")
                raise

    @contextmanager
    def errors(self) -> Iterator[None]:
        """Say SQLite's failures in this package's words."""
        try:
            yield
        except sqlite3.Error as error:
            cause = _UNAVAILABLE.get(getattr(error, "sqlite_errorcode", 0) & _PRIMARY)
            if cause is not None:
                raise StorageUnavailable(self.path, cause.reason, cause.remedy, passes=cause.passes) from error
            reason = f"not readable ({error})"
            raise StorageError(self.path, reason, "restore it from a copy or move it away") from error
