"""Durable demonstrations: one SQLite file, from which a model can always be built again."""

from collections.abc import Sequence
from dataclasses import astuple, dataclass
from enum import Enum
from pathlib import Path
from typing import NamedTuple, Self

import numpy as np

from lfd.arrays import Array
from lfd.exceptions import BoundElsewhere, LfdError, NothingToUndo, StorageError
from lfd.motion.demonstration import Demonstration
from lfd.motion.part import Part
from lfd.motion.provenance import Provenance
from lfd.motion.trajectory import Trajectory
from lfd.store.connection import Connection
from lfd.store.schema import DTYPE, prepare

_VERSION = "SELECT max(coalesce(max(added), 0), coalesce(max(undone), 0)) FROM demonstrations"
_THEN = "added <= ? AND (undone IS NULL OR undone > ?)"


class Purpose(Enum):
    """What a demonstration is for the model."""

    INITIAL = "initial"  # one of those that the model is fitted to
    UPDATE = "update"  # a refinement that the model learnt later


class Binding(NamedTuple):
    """What was learnt is good for one scene and one kind of robot only.

    Attributes:
        scene: Its name.
        robot: The robot's kind, not its name on a network; empty where an older file does not say it.
    """

    scene: str
    robot: str

    def fits(self, other: "Binding") -> bool:
        """Whether what is bound to the one may be used for the other."""
        return self.scene == other.scene and (not self.robot or not other.robot or self.robot == other.robot)

    def __str__(self) -> str:
        return f"scene {self.scene} with robot {self.robot}" if self.robot else f"scene {self.scene}"


@dataclass(frozen=True, eq=False)
class StoredDemonstration:
    """A demonstration with its place in the history.

    Attributes:
        version: Model version that it created.
        purpose: Initial or update.
        binding: Scene and robot that it was given with.
        demonstration: The motion.
    """

    version: int
    purpose: Purpose
    binding: Binding
    demonstration: Demonstration


class Counts(NamedTuple):
    """Of active demonstrations: what the model starts from, and what it learnt later."""

    initial: int
    updates: int

    @classmethod
    def of(cls, stored: Sequence[StoredDemonstration]) -> Self:
        """Of demonstrations that are all active."""
        initial = sum(one.purpose is Purpose.INITIAL for one in stored)
        return cls(initial, len(stored) - initial)


class DemonstrationStore:
    """Demonstrations in a file, in the order in which they came.

    Each change, undo included, makes a new model version, one higher than any before: a version never names two
    different models, and nothing is deleted. A change that has returned is on the disk (write-ahead log, full
    synchronisation). Not shared between threads; other processes may read and write the same file.

    All active demonstrations are of one scene and robot. A change may carry a request's number, by which it is known
    again: whoever is asked twice finds with `made_by` that it is done.

    Args:
        path: The file; it is made if it is missing, its folder is not.

    Raises:
        StorageUnavailable: The file cannot be opened or written, through no fault of its own.
        StorageError: The file is damaged, is another program's or has a newer schema.
    """

    def __init__(self, path: Path) -> None:
        self._path = Path(path)
        self._connection = Connection(self._path)
        try:
            prepare(self._connection)
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
        return int(self._connection.value(_VERSION))

    def check(self, wanted: Binding) -> None:
        """Let pass what the active demonstrations are good for; anything is, where there are none.

        Args:
            wanted: Scene and robot that they are wanted for.

        Raises:
            BoundElsewhere: They are of another scene or robot.
        """
        found = self._connection.rows("SELECT DISTINCT scene, robot FROM demonstrations WHERE undone IS NULL")
        held = [Binding(*row) for row in found]
        if not all(one.fits(wanted) for one in held):
            raise BoundElsewhere(self._path, sorted({str(one) for one in held}), str(wanted))

    def made_by(self, request: int) -> int | None:
        """The version that a request has made already; None where it has made none."""
        found = self._connection.rows("SELECT version FROM requests WHERE request = ?", (request,))
        return int(found[0][0]) if found else None

    def counts(self, version: int) -> Counts:
        """How many demonstrations were active in a version."""
        rows = self._connection.rows(
            f"SELECT kind, count(*) FROM demonstrations WHERE {_THEN} GROUP BY kind", [version] * 2
        )
        found = {Purpose(purpose): int(number) for purpose, number in rows}
        return Counts(found.get(Purpose.INITIAL, 0), found.get(Purpose.UPDATE, 0))

    def add(self, demonstration: Demonstration, purpose: Purpose, binding: Binding, request: int = 0) -> int:
        """Store a demonstration.

        Args:
            demonstration: The motion.
            purpose: What it is for the model.
            binding: What it is good for.
            request: By which the change is known again; 0 where it is not asked for twice.

        Returns:
            The model version that it makes.

        Raises:
            BoundElsewhere: The others are of another scene or robot.
            StorageError: It could not be written; the file is as before.
        """
        trajectory, provenance = demonstration.trajectory, demonstration.provenance
        arrays = {
            "positions": trajectory.positions,
            "orientations": trajectory.orientations,
            "origin": demonstration.origin,
            "condition": demonstration.condition,
        }
        with self._connection.transaction():
            self.check(binding)
            version = self._next(request)
            self._connection.rows(
                "INSERT INTO demonstrations"
                " (added, kind, scene, duration, robot, author, at_s, confidence, part_first, part_last)"
                " VALUES (?, ?, ?, ?, ?, ?, ?, ?, ?, ?)",
                (
                    *(version, purpose.value, binding.scene, trajectory.duration, binding.robot),
                    *(*astuple(provenance), *demonstration.part),
                ),
            )
            for name, array in arrays.items():
                row = (version, name, DTYPE, _shape_text(array), array.astype(DTYPE).tobytes())
                self._connection.rows("INSERT INTO arrays VALUES (?, ?, ?, ?, ?)", row)
        return version

    def undo(self, purpose: Purpose, request: int = 0) -> int:
        """Take back the newest active demonstration of one purpose.

        Args:
            purpose: Initial or update.
            request: See `add`.

        Returns:
            The model version that this makes.

        Raises:
            NothingToUndo: None of that purpose is active.
            StorageError: It could not be written; the file is as before.
        """
        newest = "SELECT max(added) FROM demonstrations WHERE undone IS NULL AND kind = ?"
        with self._connection.transaction():
            added = self._connection.value(newest, (purpose.value,))
            if added is None:
                raise NothingToUndo(self._path, purpose.value)
            version = self._next(request)
            self._connection.rows("UPDATE demonstrations SET undone = ? WHERE added = ?", (version, added))
        return version

    def active(self) -> list[StoredDemonstration]:
        """The demonstrations that were not undone, oldest first.

        Raises:
            StorageError: A record cannot be read.
        """
        rows = self._connection.rows(
            "SELECT added, kind, scene, robot, part_first, part_last, duration, author, at_s, confidence"
            " FROM demonstrations WHERE undone IS NULL ORDER BY added"
        )
        return [
            StoredDemonstration(
                added,
                Purpose(purpose),
                Binding(scene, robot),
                self._demonstration(added, duration, *provenance, part=(first, last)),
            )
            for added, purpose, scene, robot, first, last, duration, *provenance in rows
        ]

    def _next(self, request: int) -> int:
        """The version that the running transaction makes, noted for its request."""
        version = self.version + 1
        if request:
            self._connection.rows("INSERT INTO requests VALUES (?, ?)", (request, version))
        return version

    def _demonstration(
        self, added: int, duration: float, author: str, at_s: float | None, confidence: float, *, part: Part
    ) -> Demonstration:
        rows = self._connection.rows("SELECT name, dtype, shape, bytes FROM arrays WHERE demonstration = ?", (added,))
        try:
            arrays = {name: _array(dtype, shape, data) for name, dtype, shape, data in rows}
            trajectory = Trajectory(arrays["positions"], arrays["orientations"], duration)
            provenance = Provenance(author, at_s, confidence)
            return Demonstration(trajectory, arrays["origin"], arrays["condition"], provenance, part)
        except (LfdError, ValueError, KeyError) as error:
            reason = f"demonstration {added} is damaged ({error})"
            raise StorageError(self._path, reason, "restore the file from a copy") from error


def _shape_text(array: Array) -> str:
    return ",".join(str(length) for length in array.shape)


def _array(dtype: str, shape: str, data: bytes) -> Array:
    if dtype != DTYPE:
        raise ValueError(f"unknown number format {dtype!r}")
    return np.frombuffer(data, dtype=DTYPE).reshape([int(length) for length in shape.split(",")])
