"""Durable demonstrations: one SQLite file, from which a model can always be built again."""

import sqlite3
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from enum import Enum
from pathlib import Path
from typing import Self

import numpy as np

from lfd.arrays import Array
from lfd.exceptions import LfdError, NothingToUndo, StorageError
from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory

SCHEMA_VERSION = 2  # 1 had no conditions: they were the object relative to the start
APPLICATION_ID = 0x52544348  # "RTCH" in the file's header tells our files from others
BUSY_TIMEOUT = 5.0  # [s] how long a statement waits for another connection's lock

_DTYPE = "<f8"
_NEW_FILE = f"""
CREATE TABLE IF NOT EXISTS demonstrations (
    added INTEGER PRIMARY KEY,
    undone INTEGER UNIQUE,
    kind TEXT NOT NULL CHECK (kind IN ('initial', 'update')),
    scene TEXT NOT NULL,
    duration REAL NOT NULL
) STRICT;
CREATE TABLE IF NOT EXISTS arrays (
    demonstration INTEGER NOT NULL REFERENCES demonstrations (added),
    name TEXT NOT NULL,
    dtype TEXT NOT NULL,
    shape TEXT NOT NULL,
    bytes BLOB NOT NULL,
    PRIMARY KEY (demonstration, name)
) STRICT;
PRAGMA application_id = {APPLICATION_ID};
PRAGMA user_version = {SCHEMA_VERSION};
"""
_VERSION = "SELECT max(coalesce(max(added), 0), coalesce(max(undone), 0)) FROM demonstrations"


class Kind(Enum):
    """What a demonstration is for the model."""

    INITIAL = "initial"  # one of those that the model is fitted to
    UPDATE = "update"  # a refinement that the model learnt later


@dataclass(frozen=True, eq=False)
class StoredDemonstration:
    """A demonstration with its place in the history.

    Attributes:
        version: Model version that it created.
        kind: Initial or update.
        scene: Name of the scene in which it was given.
        demonstration: The motion.
    """

    version: int
    kind: Kind
    scene: str
    demonstration: Demonstration


class DemonstrationStore:
    """Demonstrations in a file, in the order in which they came.

    Each change, undo included, makes a new model version, one higher than any before: a version never names two
    different models, and nothing is deleted. A change that has returned is on the disk (write-ahead log, full
    synchronisation). Not shared between threads; other processes may read and write the same file.

    Args:
        path: The file; it is made if it is missing, its folder is not.

    Raises:
        StorageError: The file cannot be opened, is damaged, is another program's or has a newer schema.
    """

    def __init__(self, path: Path) -> None:
        self._path = Path(path)
        with self._storage_errors():
            self._connection = sqlite3.connect(self._path, timeout=BUSY_TIMEOUT, isolation_level=None)
        try:
            with self._storage_errors():
                self._open()
        except StorageError:
            self._connection.close()
            raise

    def __enter__(self) -> Self:
        return self

    def __exit__(self, *_: object) -> None:
        self.close()

    def close(self) -> None:
        """Close the file. What was acknowledged is already in it."""
        self._connection.close()

    @property
    def version(self) -> int:
        """The current model version; 0 before the first demonstration."""
        with self._storage_errors():
            return int(self._connection.execute(_VERSION).fetchone()[0])

    def add(self, demonstration: Demonstration, kind: Kind, scene: str) -> int:
        """Store a demonstration and return the model version that it makes.

        Raises:
            StorageError: It could not be written; the file is as before.
        """
        trajectory = demonstration.trajectory
        arrays = {
            "positions": trajectory.positions,
            "orientations": trajectory.orientations,
            "origin": demonstration.origin,
            "condition": demonstration.condition,
        }
        with self._transaction() as version:
            self._connection.execute(
                "INSERT INTO demonstrations (added, kind, scene, duration) VALUES (?, ?, ?, ?)",
                (version, kind.value, scene, trajectory.duration),
            )
            self._connection.executemany(
                "INSERT INTO arrays VALUES (?, ?, ?, ?, ?)",
                [(version, name, _DTYPE, _shape_text(a), a.astype(_DTYPE).tobytes()) for name, a in arrays.items()],
            )
        return version

    def undo(self) -> int:
        """Take back the newest active demonstration and return the model version that this makes.

        Raises:
            NothingToUndo: No demonstration is active.
            StorageError: It could not be written; the file is as before.
        """
        with self._transaction() as version:
            newest = self._connection.execute("SELECT max(added) FROM demonstrations WHERE undone IS NULL").fetchone()
            if newest[0] is None:
                raise NothingToUndo(self._path)
            self._connection.execute("UPDATE demonstrations SET undone = ? WHERE added = ?", (version, newest[0]))
        return version

    def active(self) -> list[StoredDemonstration]:
        """The demonstrations that were not undone, oldest first.

        Raises:
            StorageError: A record cannot be read.
        """
        with self._storage_errors():
            rows = self._connection.execute(
                "SELECT added, kind, scene, duration FROM demonstrations WHERE undone IS NULL ORDER BY added"
            ).fetchall()
            return [
                StoredDemonstration(added, Kind(kind), scene, self._demonstration(added, duration))
                for added, kind, scene, duration in rows
            ]

    def _demonstration(self, added: int, duration: float) -> Demonstration:
        rows = self._connection.execute(
            "SELECT name, dtype, shape, bytes FROM arrays WHERE demonstration = ?", (added,)
        ).fetchall()
        try:
            arrays = {name: _array(dtype, shape, data) for name, dtype, shape, data in rows}
            trajectory = Trajectory(arrays["positions"], arrays["orientations"], duration)
            return Demonstration(trajectory, arrays["origin"], arrays["condition"])
        except (LfdError, ValueError, KeyError) as error:
            reason = f"demonstration {added} is damaged ({error})"
            raise StorageError(self._path, reason, "restore the file from a copy") from error

    def _open(self) -> None:
        execute = self._connection.execute
        application = execute("PRAGMA application_id").fetchone()[0]
        schema = execute("PRAGMA user_version").fetchone()[0]
        empty = execute("SELECT count(*) FROM sqlite_schema").fetchone()[0] == 0
        if application != APPLICATION_ID and not (empty and application == 0 and schema == 0):
            raise StorageError(self._path, "this is not a file of demonstrations", "choose another file name")
        if schema > SCHEMA_VERSION:
            raise StorageError(self._path, f"its schema {schema} is newer than {SCHEMA_VERSION}", "update Retouch")
        execute("PRAGMA journal_mode = WAL")
        execute("PRAGMA synchronous = FULL")
        execute("PRAGMA foreign_keys = ON")
        if empty:
            self._connection.executescript(f"BEGIN IMMEDIATE; {_NEW_FILE} COMMIT;")
        elif schema < SCHEMA_VERSION:
            self._upgrade()
        damage = execute("PRAGMA quick_check(1)").fetchone()[0]
        if damage != "ok":
            raise StorageError(self._path, f"the file is damaged ({damage})", "restore it from a copy")

    def _upgrade(self) -> None:
        """Give the demonstrations of schema 1 their conditions: the object relative to the motion's first point."""
        with self._transaction():
            execute = self._connection.execute
            execute("UPDATE arrays SET name = 'origin' WHERE name = 'object_position'")
            rows = execute(
                "SELECT a.demonstration, a.bytes, p.bytes FROM arrays a JOIN arrays p USING (demonstration)"
                " WHERE a.name = 'origin' AND p.name = 'positions'"
            ).fetchall()
            for demonstration, origin, positions in rows:
                first = np.frombuffer(positions, dtype=_DTYPE, count=3)
                condition = (np.frombuffer(origin, dtype=_DTYPE) - first).tobytes()
                execute("INSERT INTO arrays VALUES (?, 'condition', ?, '3', ?)", (demonstration, _DTYPE, condition))
            execute(f"PRAGMA user_version = {SCHEMA_VERSION}")

    @contextmanager
    def _transaction(self) -> Iterator[int]:
        """All or nothing; yields the version that the change makes. Committed to the disk on leaving."""
        with self._storage_errors():
            self._connection.execute("BEGIN IMMEDIATE")
            try:
                yield int(self._connection.execute(_VERSION).fetchone()[0]) + 1
                self._connection.execute("COMMIT")
            except BaseException:
                if self._connection.in_transaction:  # a full disk has already rolled back
                    self._connection.execute("ROLLBACK")
                raise

    @contextmanager
    def _storage_errors(self) -> Iterator[None]:
        try:
            yield
        except sqlite3.OperationalError as error:
            raise StorageError(
                self._path, f"cannot be used ({error})", "check folder, rights and disk space"
            ) from error
        except sqlite3.Error as error:
            raise StorageError(
                self._path, f"not readable ({error})", "restore it from a copy or move it away"
            ) from error


def _shape_text(array: Array) -> str:
    return ",".join(str(length) for length in array.shape)


def _array(dtype: str, shape: str, data: bytes) -> Array:
    if dtype != _DTYPE:
        raise ValueError(f"unknown number format {dtype!r}")
    return np.frombuffer(data, dtype=_DTYPE).reshape([int(length) for length in shape.split(",")])
