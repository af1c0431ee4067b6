"""All that a file of demonstrations holds, bit by bit: what another file can be made of."""

from collections.abc import Iterable, Sequence
from typing import Any, NamedTuple, Self

from lfd.exceptions import StorageError
from lfd.store.connection import Connection
from lfd.store.rows import COLUMNS
from lfd.store.stored import About, Binding, Change, Record, Turn

NAMES = tuple(COLUMNS.split(", "))
"""Of a demonstration's numbers and texts."""


class Whole(NamedTuple):
    """A file of demonstrations as a value; of which requests it was changed is no part of it.

    Attributes:
        about: What it says of itself.
        records: Every demonstration that was ever added, oldest first.
        changes: Every change, oldest first.
    """

    about: About
    records: tuple[Record, ...]
    changes: tuple[Change, ...]

    @classmethod
    def of(cls, connection: Connection) -> Self:
        """What a file holds.

        Args:
            connection: To it, in a transaction.

        Raises:
            StorageError: It does not say what it is for.
        """
        about = said(connection)
        if about is None:
            raise StorageError(connection.path, "it does not say what it is for", "teach it something first")
        rows = connection.rows(f"SELECT {COLUMNS} FROM demonstrations ORDER BY added")
        records = (Record(dict(zip(NAMES, row, strict=True)), tuple(arrays(connection, row[0]))) for row in rows)
        turned = connection.rows(
            "SELECT demonstration, version, in_use, turned_by, turned_at_s FROM changes ORDER BY version"
        )
        changes = (Change(one, Turn(version, bool(in_use), by, at_s)) for one, version, in_use, by, at_s in turned)
        return cls(about, tuple(records), tuple(changes))

    def put(self, connection: Connection) -> None:
        """Put it into a file that holds nothing.

        Args:
            connection: To it, in a transaction.

        Raises:
            StorageError: It is no history, or could not be written.
        """
        for record in self.records:
            names = [name for name in NAMES if name in record.values]
            insert(connection, names, [record.values[name] for name in names], record.arrays)
        for change in self.changes:
            note(connection, change)
        say(connection, self.about)


def said(connection: Connection) -> About | None:
    """What a file says of itself; None where nobody has said it."""
    found = connection.rows("SELECT scene, robot, author, notes, created_s, used_s FROM skill")
    return About(Binding(*found[0][:2]), *found[0][2:]) if found else None


def say(connection: Connection, about: About) -> None:
    """Let a file say something else of itself."""
    connection.rows("DELETE FROM skill")
    row = (*about.binding, about.author, about.notes, about.created_s, about.used_s)
    connection.rows("INSERT INTO skill VALUES (1, ?, ?, ?, ?, ?, ?)", row)


def note(connection: Connection, change: Change) -> None:
    """Note a change."""
    turn = change.turn
    row = (turn.version, change.demonstration, turn.in_use, turn.author, turn.at_s)
    connection.rows("INSERT INTO changes VALUES (?, ?, ?, ?, ?)", row)


def insert(
    connection: Connection, names: Sequence[str], row: Sequence[object], given: Iterable[tuple[object, ...]]
) -> None:
    """Put in a demonstration.

    Args:
        connection: To the file.
        names: Of its numbers and texts.
        row: These.
        given: Name, number format, shape and bytes of each of its arrays.
    """
    marks = ", ".join("?" * len(row))
    connection.rows(f"INSERT INTO demonstrations ({', '.join(names)}) VALUES ({marks})", row)
    added = row[list(names).index("added")]
    for array in given:
        connection.rows("INSERT INTO arrays VALUES (?, ?, ?, ?, ?)", (added, *array))


def arrays(connection: Connection, added: int) -> list[tuple[Any, ...]]:
    """Name, number format, shape and bytes of each array of a demonstration."""
    return connection.rows(
        "SELECT name, dtype, shape, bytes FROM arrays WHERE demonstration = ? ORDER BY name", (added,)
    )
