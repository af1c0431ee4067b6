"""Durable demonstrations: one SQLite file, from which a model can always be built again."""

from pathlib import Path
from typing import Any, Self

from lfd.exceptions import BoundElsewhere, LfdError, NothingToRedo, NothingToUndo, StorageError
from lfd.motion.demonstration import Demonstration
from lfd.motion.departure import Departure
from lfd.store.connection import Connection
from lfd.store.rows import COLUMNS, arrays_of, row_of, stored_in
from lfd.store.schema import prepare
from lfd.store.stored import About, Binding, Change, Counts, Made, Purpose, StoredDemonstration, Turn
from lfd.store.whole import Whole, arrays, insert, note, said, say

_IN_USE = "(SELECT in_use FROM changes WHERE demonstration = added ORDER BY version DESC LIMIT 1)"


class DemonstrationStore:
    """Demonstrations in a file, in the order in which they came.

    Each change, undo and redo included, makes a new model version, one higher than any before: a version never names
    two different models, and nothing is deleted. A change that has returned is on the disk (write-ahead log, full
    synchronisation). Not shared between threads; other processes may read and write the same file.

    All demonstrations in use are of one scene and robot. A change may carry a request's number, by which it is known
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
        return int(self._connection.value("SELECT coalesce(max(version), 0) FROM changes"))

    def check(self, wanted: Binding) -> None:
        """Let pass what the demonstrations in use are good for; anything is, where there are none.

        Args:
            wanted: Scene and robot that they are wanted for.

        Raises:
            BoundElsewhere: They are of another scene or robot.
        """
        found = self._connection.rows(
            f"SELECT scene, robot FROM demonstrations WHERE {_IN_USE} UNION SELECT scene, robot FROM skill"
        )
        held = [Binding(*row) for row in found]
        if not all(one.fits(wanted) for one in held):
            raise BoundElsewhere(self._path, sorted({str(one) for one in held}), str(wanted))

    def about(self) -> About | None:
        """What the file says of itself; None where nobody has said it."""
        return said(self._connection)

    def describe(self, about: About) -> None:
        """Say what the file is, in place of what it said.

        Args:
            about: What it is for, whose, since when.

        Raises:
            BoundElsewhere: The demonstrations in use are of another scene or robot.
            StorageError: It could not be written; the file is as before.
        """
        with self._connection.transaction():
            say(self._connection, about)
            self.check(about.binding)

    def made_by(self, request: int) -> Made | None:
        """What a request has changed already; None where it has changed nothing."""
        joined = "SELECT version, demonstration FROM requests JOIN changes USING (version) WHERE request = ?"
        found = self._connection.rows(joined, (request,))
        return Made(*found[0]) if found else None

    def counts(self, version: int) -> Counts:
        """How many demonstrations were in use in a version."""
        rows = self._connection.rows(
            "SELECT kind, count(*) FROM demonstrations JOIN changes ON demonstration = added WHERE in_use AND version ="
            " (SELECT max(version) FROM changes WHERE demonstration = added AND version <= ?) GROUP BY kind",
            (version,),
        )
        found = {Purpose(purpose): int(number) for purpose, number in rows}
        return Counts(found.get(Purpose.INITIAL, 0), found.get(Purpose.UPDATE, 0))

    def add(
        self,
        demonstration: Demonstration,
        purpose: Purpose,
        binding: Binding,
        request: int = 0,
        departure: Departure | None = None,
    ) -> int:
        """Store a demonstration, in use from now on.

        Args:
            demonstration: The motion.
            purpose: What it is for the model.
            binding: What it is good for.
            request: By which the change is known again; 0 where it is not asked for twice.
            departure: From what was predicted there; None where nothing was.

        Returns:
            The model version that it makes, by which it is called from then on.

        Raises:
            BoundElsewhere: The others are of another scene or robot.
            StorageError: It could not be written; the file is as before.
        """
        with self._connection.transaction():
            self.check(binding)
            version = self.version + 1
            row = row_of(version, demonstration, purpose, binding, departure)
            insert(self._connection, COLUMNS.split(", "), row, arrays_of(demonstration))
            whose = demonstration.provenance
            self._turn(version, Turn(version, True, whose.author, whose.at_s), request)
        return version

    def undo(self, version: int, request: int = 0, author: str = "", at_s: float | None = None) -> int:
        """Take a demonstration back, whichever was added since.

        Args:
            version: That it made when it was added.
            request: See `add`.
            author: Who takes it back.
            at_s: When, in seconds since 1970-01-01 UTC.

        Returns:
            The model version that this makes.

        Raises:
            NothingToUndo: There is none of that version in use.
            StorageError: It could not be written; the file is as before.
        """
        with self._connection.transaction():
            if not self._connection.rows(f"SELECT added FROM demonstrations WHERE added = ? AND {_IN_USE}", (version,)):
                raise NothingToUndo(self._path, version)
            turn = Turn(self.version + 1, False, author, at_s)
            self._turn(version, turn, request)
        return turn.version

    def redo(self, version: int, request: int = 0, author: str = "", at_s: float | None = None) -> int:
        """Use a demonstration again that was taken back, in the place that it had.

        Args:
            version: That it made when it was added.
            request: See `add`.
            author: Who wants it back.
            at_s: When, in seconds since 1970-01-01 UTC.

        Returns:
            The model version that this makes.

        Raises:
            NothingToRedo: There is none of that version that was taken back.
            BoundElsewhere: What is in use is of another scene or robot.
            StorageError: It could not be written; the file is as before.
        """
        of_version = f"SELECT scene, robot FROM demonstrations WHERE added = ? AND NOT {_IN_USE}"
        with self._connection.transaction():
            found = self._connection.rows(of_version, (version,))
            if not found:
                raise NothingToRedo(self._path, version)
            self.check(Binding(*found[0]))
            turn = Turn(self.version + 1, True, author, at_s)
            self._turn(version, turn, request)
        return turn.version

    def active(self) -> list[StoredDemonstration]:
        """The demonstrations in use, oldest first.

        Raises:
            StorageError: A record cannot be read.
        """
        return self._found(_IN_USE)

    def history(self) -> list[StoredDemonstration]:
        """Every demonstration that was ever added, oldest first; raises as `active`."""
        return self._found("TRUE")

    def whole(self) -> Whole:
        """All that the file holds, as it is at one moment."""
        with self._connection.transaction():
            return Whole.of(self._connection)

    def restore(self, whole: Whole) -> None:
        """Make a file that holds nothing one with the history of another, version by version, bit by bit.

        Args:
            whole: Of the other.

        Raises:
            BoundElsewhere: What is in use is of another scene or robot than it says.
            StorageError: It could not be written, or is no history; the file is as before.
        """
        with self._connection.transaction():
            whole.put(self._connection)
            self.check(whole.about.binding)
            if len(self.history()) != len(whole.records):
                raise StorageError(self._path, "a demonstration never came into use", "take another copy")

    def copy_to(self, target: Path) -> None:
        """Copy the file, whole or not at all.

        Args:
            target: Of the copy; one that is there is replaced.

        Raises:
            StorageError: The copy could not be written.
        """
        self._connection.copy_to(target)

    def settle(self) -> None:
        """Bring all into the one file, so that it can be moved once it is closed; no change is possible any more.

        Raises:
            StorageUnavailable: Another process uses it.
        """
        self._connection.settle()

    def _turn(self, demonstration: int, turn: Turn, request: int) -> None:
        """Note what the running transaction changes, and for which request."""
        note(self._connection, Change(demonstration, turn))
        if request:
            self._connection.rows("INSERT INTO requests VALUES (?, ?)", (request, turn.version))

    def _found(self, which: str) -> list[StoredDemonstration]:
        rows = self._connection.rows(
            f"SELECT version, in_use, turned_by, turned_at_s, {COLUMNS} FROM demonstrations JOIN changes"
            " ON version = (SELECT max(version) FROM changes WHERE demonstration = added)"
            f" WHERE {which} ORDER BY added"
        )
        return [self._stored(Turn(version, bool(in_use), by, at_s), row) for version, in_use, by, at_s, *row in rows]

    def _stored(self, turn: Turn, row: list[Any]) -> StoredDemonstration:
        added = row[0]
        try:
            return stored_in(row, arrays(self._connection, added), turn)
        except (LfdError, ValueError, KeyError) as error:
            reason = f"demonstration {added} is damaged ({error})"
            raise StorageError(self._path, reason, "restore the file from a copy") from error
