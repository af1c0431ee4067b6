"""What keeps a good file from being used is told apart from a bad file, and leaves it as it was."""

import sqlite3

import pytest

from lfd.exceptions import StorageError, StorageUnavailable
from lfd.store import connection
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Binding, Purpose

TABLE = Binding("table", "tiago")


@pytest.fixture
def path(tmp_path):
    return tmp_path / "demonstrations.sqlite"


def test_a_file_that_another_process_holds_is_no_bad_file(path, reach, monkeypatch):
    monkeypatch.setattr(connection, "BUSY_TIMEOUT", 0.01)
    with DemonstrationStore(path) as store:
        holder = sqlite3.connect(path, isolation_level=None)
        holder.execute("BEGIN IMMEDIATE")
        with pytest.raises(StorageUnavailable, match="another process holds it"):
            store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        holder.execute("ROLLBACK")
        holder.close()
        assert store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE) == 1


def test_a_full_disk_is_no_bad_file_and_leaves_the_store_as_it_was(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        pages = store._connection.value("PRAGMA page_count")
        store._connection.rows(f"PRAGMA max_page_count = {pages}")
        with pytest.raises(StorageUnavailable, match="disk is full"):
            store.add(reach([0.9, 0.2, 0.6], n=5000), Purpose.UPDATE, TABLE)
        assert store.version == 1
        assert len(store.active()) == 1


def test_a_file_that_may_not_be_written_is_no_bad_file(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        store._connection.rows("PRAGMA query_only = ON")
        with pytest.raises(StorageUnavailable, match="cannot be written"):
            store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)


def test_a_failed_change_leaves_the_store_as_it_was(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        with sqlite3.connect(path, isolation_level=None) as other:
            other.execute("DROP TABLE arrays")
        other.close()
        with pytest.raises(StorageError):
            store.add(reach([0.9, 0.2, 0.6]), Purpose.UPDATE, TABLE)
        assert store.version == 1
