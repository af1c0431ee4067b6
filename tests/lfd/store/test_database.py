import sqlite3
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest

from lfd.exceptions import NothingToUndo, StorageError
from lfd.store.database import DemonstrationStore, Kind

REPOSITORY = Path(__file__).resolve().parents[3]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "demonstrations.sqlite"


def test_what_was_stored_is_read_back_bit_for_bit_and_in_order(path, reach):
    given = [reach([0.9, y, 0.6], bend=y, duration=4.0 + y) for y in (0.1, 0.2, 0.3)]
    with DemonstrationStore(path) as store:
        assert store.version == 0
        versions = [
            store.add(d, kind, "dishwasher")
            for d, kind in zip(given, [Kind.INITIAL, Kind.INITIAL, Kind.UPDATE], strict=True)
        ]
    assert versions == [1, 2, 3]
    with DemonstrationStore(path) as store:
        stored = store.active()
        assert store.version == 3
    assert [(s.version, s.kind, s.scene) for s in stored][2] == (3, Kind.UPDATE, "dishwasher")
    for record, expected in zip(stored, given, strict=True):
        trajectory = record.demonstration.trajectory
        np.testing.assert_array_equal(trajectory.positions, expected.trajectory.positions)
        np.testing.assert_allclose(trajectory.orientations, expected.trajectory.orientations, atol=1e-15)
        np.testing.assert_array_equal(record.demonstration.origin, expected.origin)
        np.testing.assert_array_equal(record.demonstration.condition, expected.condition)
        assert trajectory.duration == expected.trajectory.duration


def test_undo_takes_back_the_newest_and_makes_a_new_version(path, reach):
    with DemonstrationStore(path) as store:
        for y in (0.1, 0.2):
            store.add(reach([0.9, y, 0.6]), Kind.UPDATE, "table")
        assert store.undo() == 3
        assert [s.version for s in store.active()] == [1]
        assert store.add(reach([0.9, 0.3, 0.6]), Kind.UPDATE, "table") == 4
        assert [s.version for s in store.active()] == [1, 4]
        assert [store.undo(), store.undo()] == [5, 6]
        with pytest.raises(NothingToUndo):
            store.undo()
        assert store.version == 6


def test_a_file_of_schema_1_gets_its_conditions(path, reach):
    """They were the object relative to the motion's first point; the object's position had another name."""
    given = reach([0.9, 0.1, 0.6])
    with DemonstrationStore(path) as store:
        store.add(given, Kind.INITIAL, "table")
    with sqlite3.connect(path) as old:
        old.execute("DELETE FROM arrays WHERE name = 'condition'")
        old.execute("UPDATE arrays SET name = 'object_position' WHERE name = 'origin'")
        old.execute("PRAGMA user_version = 1")
    old.close()
    for _ in range(2):
        with DemonstrationStore(path) as store:
            (record,) = store.active()
        np.testing.assert_allclose(record.demonstration.condition, given.condition, atol=1e-15)
        np.testing.assert_array_equal(record.demonstration.origin, given.origin)


WRITER = """
import sys
import numpy as np
from lfd.motion.demonstration import Demonstration
from lfd.store.database import DemonstrationStore, Kind
from lfd.motion.trajectory import Trajectory

store = DemonstrationStore(sys.argv[1])
trajectory = Trajectory(np.arange(30.0).reshape(10, 3), np.tile([1.0, 0.0, 0.0, 0.0], (10, 1)), 5.0)
while True:
    print(store.add(Demonstration.reaching(trajectory, np.zeros(3)), Kind.UPDATE, "table"), flush=True)
"""


def test_what_was_acknowledged_survives_kill_9(path):
    command = [sys.executable, "-c", WRITER, str(path)]
    with subprocess.Popen(command, cwd=REPOSITORY, stdout=subprocess.PIPE, text=True) as writer:
        for _ in range(20):
            acknowledged = int(writer.stdout.readline())
        writer.kill()
        acknowledged = max([acknowledged, *(int(line) for line in writer.stdout if line.endswith("\n"))])
    with DemonstrationStore(path) as store:
        assert store.version >= acknowledged
        assert [s.version for s in store.active()] == list(range(1, store.version + 1))


def test_two_connections_see_one_history(path, reach):
    with DemonstrationStore(path) as first, DemonstrationStore(path) as second:
        assert first.add(reach([0.9, 0.1, 0.6]), Kind.INITIAL, "table") == 1
        assert second.add(reach([0.9, 0.2, 0.6]), Kind.UPDATE, "table") == 2
        assert first.version == 2


def test_a_failed_change_leaves_the_store_as_it_was(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Kind.INITIAL, "table")
        with sqlite3.connect(path, isolation_level=None) as other:
            other.execute("DROP TABLE arrays")
        other.close()
        with pytest.raises(StorageError):
            store.add(reach([0.9, 0.2, 0.6]), Kind.UPDATE, "table")
        assert store.version == 1


def _not_a_database(path):
    path.write_text("t,x,y,z\n0,1,2,3\n" * 100)


def _of_another_program(path):
    connection = sqlite3.connect(path)
    connection.execute("CREATE TABLE recipes (name TEXT)")
    connection.close()


def _from_the_future(path):
    DemonstrationStore(path).close()
    connection = sqlite3.connect(path)
    connection.execute("PRAGMA user_version = 99")
    connection.close()


def _cut_off(path):
    DemonstrationStore(path).close()
    path.write_bytes(path.read_bytes()[:5000])


def _in_no_folder(path):
    path.symlink_to(path.parent / "missing" / path.name)


@pytest.mark.parametrize("spoil", [_not_a_database, _of_another_program, _from_the_future, _cut_off, _in_no_folder])
def test_a_file_that_cannot_be_used_is_named_with_what_to_do(path, spoil):
    spoil(path)
    before = path.read_bytes() if path.exists() else None
    with pytest.raises(StorageError) as caught:
        DemonstrationStore(path)
    assert caught.value.path == path
    assert str(caught.value).startswith(f"{path}: ")
    assert caught.value.remedy
    assert before is None or path.read_bytes() == before


def test_a_damaged_record_is_reported_and_not_returned(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Kind.INITIAL, "table")
        connection = sqlite3.connect(path, isolation_level=None)
        connection.execute("UPDATE arrays SET bytes = x'00' WHERE name = 'positions'")
        connection.close()
        with pytest.raises(StorageError, match="demonstration 1 is damaged"):
            store.active()
