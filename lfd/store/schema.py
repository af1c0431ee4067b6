"""The tables of a file of demonstrations: made in a new file, brought up to date in an older one."""

import numpy as np

from lfd.exceptions import ForeignFile, StorageError
from lfd.store.connection import Connection

SCHEMA_VERSION = 7
"""1 had no conditions: they were the object relative to the start. 2 knew neither robots nor requests, 3 no authors,
times and confidences: its motions were stored as far as they were believed. 4 knew whole motions only. 5 took back
the newest only and for ever, and knew no methods. 6 said nothing of the skill itself, and its
motions nothing of a gripper."""

APPLICATION_ID = 0x52544348  # "RTCH" in the file's header tells our files from others
DTYPE = "<f8"

_DEMONSTRATIONS = """
CREATE TABLE demonstrations (
    added INTEGER PRIMARY KEY,
    kind TEXT NOT NULL CHECK (kind IN ('initial', 'update')),
    scene TEXT NOT NULL,
    duration REAL NOT NULL,
    robot TEXT NOT NULL DEFAULT '',
    author TEXT NOT NULL DEFAULT '',
    at_s REAL,
    confidence REAL NOT NULL DEFAULT 1.0 CHECK (confidence BETWEEN 0.0 AND 1.0),
    part_first REAL NOT NULL DEFAULT 0.0 CHECK (part_first BETWEEN 0.0 AND 1.0),
    part_last REAL NOT NULL DEFAULT 1.0 CHECK (part_last BETWEEN 0.0 AND 1.0),
    method TEXT NOT NULL DEFAULT '',
    departure_mean REAL,
    departure_most REAL
) STRICT
"""
_CHANGES = """
CREATE TABLE changes (
    version INTEGER PRIMARY KEY,
    demonstration INTEGER NOT NULL REFERENCES demonstrations (added),
    in_use INTEGER NOT NULL CHECK (in_use IN (0, 1)),
    turned_by TEXT NOT NULL DEFAULT '',
    turned_at_s REAL
) STRICT
"""
_ARRAYS = """
CREATE TABLE arrays (
    demonstration INTEGER NOT NULL REFERENCES demonstrations (added),
    name TEXT NOT NULL,
    dtype TEXT NOT NULL,
    shape TEXT NOT NULL,
    bytes BLOB NOT NULL,
    PRIMARY KEY (demonstration, name)
) STRICT
"""
_REQUESTS = """
CREATE TABLE requests (
    request INTEGER PRIMARY KEY,
    version INTEGER NOT NULL UNIQUE
) STRICT
"""
_SKILL = """
CREATE TABLE skill (
    one INTEGER PRIMARY KEY CHECK (one = 1),
    scene TEXT NOT NULL,
    robot TEXT NOT NULL,
    author TEXT NOT NULL DEFAULT '',
    notes TEXT NOT NULL DEFAULT '',
    created_s REAL,
    used_s REAL
) STRICT
"""


def prepare(connection: Connection) -> None:
    """Make a new file one of demonstrations, bring an older one up to date, and refuse what is neither.

    Of an older one a copy as it was stays beside it.

    Raises:
        StorageError: The file is damaged, is another program's or has a newer schema; it is as before.
    """
    path, value = connection.path, connection.value
    application, schema = value("PRAGMA application_id"), value("PRAGMA user_version")
    empty = value("SELECT count(*) FROM sqlite_schema") == 0
    if application != APPLICATION_ID and not (empty and application == 0 and schema == 0):
        raise ForeignFile(path)
    if schema > SCHEMA_VERSION:
        raise StorageError(path, f"its schema {schema} is newer than {SCHEMA_VERSION}", "update Retouch")
    connection.use_log()
    if empty:
        _make(connection)
    elif schema < SCHEMA_VERSION:
        _upgrade(connection, schema)
    connection.rows("PRAGMA foreign_keys = ON")  # only now: a table that others refer to may have been made anew
    damage = value("PRAGMA quick_check(1)")
    if damage != "ok":
        raise StorageError(path, f"the file is damaged ({damage})", "restore it from a copy")


def _make(connection: Connection) -> None:
    with connection.transaction():
        # Another process may have made them since this one looked.
        if connection.value("SELECT count(*) FROM sqlite_schema") == 0:
            for statement in (_DEMONSTRATIONS, _ARRAYS, _CHANGES, _REQUESTS, _SKILL):
                connection.rows(statement)
            connection.rows(f"PRAGMA application_id = {APPLICATION_ID}")
            connection.rows(f"PRAGMA user_version = {SCHEMA_VERSION}")


def _upgrade(connection: Connection, schema: int) -> None:
    kept = connection.path.with_name(f"{connection.path.name}.schema-{schema}")
    if not kept.exists():
        connection.copy_to(kept)
    with connection.transaction():
        if connection.value("PRAGMA user_version") != schema:
            return  # another process was first
        for older_than, upgrade in _UPGRADES:
            if schema < older_than:
                upgrade(connection)
        connection.rows(f"PRAGMA user_version = {SCHEMA_VERSION}")


def _add_conditions(connection: Connection) -> None:
    """Give the demonstrations of schema 1 their conditions: the object relative to the motion's first point."""
    connection.rows("UPDATE arrays SET name = 'origin' WHERE name = 'object_position'")
    found = connection.rows(
        "SELECT a.demonstration, a.bytes, p.bytes FROM arrays a JOIN arrays p USING (demonstration)"
        " WHERE a.name = 'origin' AND p.name = 'positions'"
    )
    for demonstration, origin, positions in found:
        first = np.frombuffer(positions, dtype=DTYPE, count=3)
        condition = (np.frombuffer(origin, dtype=DTYPE) - first).tobytes()
        connection.rows("INSERT INTO arrays VALUES (?, 'condition', ?, '3', ?)", (demonstration, DTYPE, condition))


def _add_robots_and_requests(connection: Connection) -> None:
    connection.rows("ALTER TABLE demonstrations ADD COLUMN robot TEXT NOT NULL DEFAULT ''")
    connection.rows(_REQUESTS)


def _add_provenance(connection: Connection) -> None:
    for column in (
        "author TEXT NOT NULL DEFAULT ''",
        "at_s REAL",
        "confidence REAL NOT NULL DEFAULT 1.0 CHECK (confidence BETWEEN 0.0 AND 1.0)",
    ):
        connection.rows(f"ALTER TABLE demonstrations ADD COLUMN {column}")


def _add_parts(connection: Connection) -> None:
    for column in (
        "part_first REAL NOT NULL DEFAULT 0.0 CHECK (part_first BETWEEN 0.0 AND 1.0)",
        "part_last REAL NOT NULL DEFAULT 1.0 CHECK (part_last BETWEEN 0.0 AND 1.0)",
    ):
        connection.rows(f"ALTER TABLE demonstrations ADD COLUMN {column}")


def _add_changes(connection: Connection) -> None:
    """Every version says which demonstration came into use or out of it; one of schema 5 went out once at most."""
    kept = "added, kind, scene, duration, robot, author, at_s, confidence, part_first, part_last"
    connection.rows(_CHANGES)
    connection.rows(
        "INSERT INTO changes (version, demonstration, in_use, turned_by, turned_at_s)"
        " SELECT added, added, 1, author, at_s FROM demonstrations"
    )
    connection.rows(
        "INSERT INTO changes (version, demonstration, in_use)"
        " SELECT undone, added, 0 FROM demonstrations WHERE undone IS NOT NULL"
    )
    # A column that is UNIQUE cannot be dropped: the table is made anew, and takes the name that others refer to.
    connection.rows(_DEMONSTRATIONS.replace("demonstrations", "anew", 1))
    connection.rows(f"INSERT INTO anew ({kept}) SELECT {kept} FROM demonstrations")
    connection.rows("DROP TABLE demonstrations")
    connection.rows("ALTER TABLE anew RENAME TO demonstrations")


def _add_skill(connection: Connection) -> None:
    """What is in use says what the skill is for; who gave the first of it made it."""
    connection.rows(_SKILL)
    connection.rows(
        "INSERT INTO skill (one, scene, robot, author, created_s)"
        " SELECT 1, scene, robot, author, at_s FROM demonstrations WHERE"
        " (SELECT in_use FROM changes WHERE demonstration = added ORDER BY version DESC LIMIT 1) ORDER BY added LIMIT 1"
    )


_UPGRADES = (
    (2, _add_conditions),
    (3, _add_robots_and_requests),
    (4, _add_provenance),
    (5, _add_parts),
    (6, _add_changes),
    (7, _add_skill),
)
"""In order, each with the schema that it leads to."""
