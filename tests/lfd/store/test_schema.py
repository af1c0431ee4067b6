"""Files of earlier versions go on being good; what is no file of ours stays untouched."""

import sqlite3
from dataclasses import replace

import numpy as np
import pytest

from lfd.exceptions import BoundElsewhere, StorageError
from lfd.motion.part import WHOLE
from lfd.motion.provenance import UNKNOWN, Provenance
from lfd.store.database import Binding, DemonstrationStore, Purpose

DISHWASHER, TABLE = Binding("dishwasher", "tiago"), Binding("table", "tiago")


@pytest.fixture
def path(tmp_path):
    return tmp_path / "demonstrations.sqlite"


def _as_schema_4(path):
    with sqlite3.connect(path) as old:
        for column in ("part_first", "part_last"):
            old.execute(f"ALTER TABLE demonstrations DROP COLUMN {column}")
        old.execute("PRAGMA user_version = 4")
    old.close()


def _as_schema_3(path):
    _as_schema_4(path)
    with sqlite3.connect(path) as old:
        for column in ("author", "at_s", "confidence"):
            old.execute(f"ALTER TABLE demonstrations DROP COLUMN {column}")
        old.execute("PRAGMA user_version = 3")
    old.close()


def _as_schema_2(path):
    _as_schema_3(path)
    with sqlite3.connect(path) as old:
        old.execute("ALTER TABLE demonstrations DROP COLUMN robot")
        old.execute("DROP TABLE requests")
        old.execute("PRAGMA user_version = 2")
    old.close()


def test_a_file_of_schema_1_gets_its_conditions(path, reach):
    """They were the object relative to the motion's first point; the object's position had another name."""
    given = reach([0.9, 0.1, 0.6])
    with DemonstrationStore(path) as store:
        store.add(given, Purpose.INITIAL, TABLE)
    _as_schema_2(path)
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


def test_a_file_of_schema_2_is_bound_to_the_scene_of_its_rows_whatever_the_robot(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, DISHWASHER)
    _as_schema_2(path)
    for _ in range(2):
        with DemonstrationStore(path) as store:
            store.check(DISHWASHER)
            with pytest.raises(BoundElsewhere, match=r"scene dishwasher.*scene table"):
                store.check(TABLE)
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, DISHWASHER, request=5)
        assert store.made_by(5) == 2


def test_what_a_file_of_schema_3_holds_is_nobodys_of_no_time_and_believed_whole(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
    _as_schema_3(path)
    given = Provenance("anna", 1.5, 0.25)
    with DemonstrationStore(path) as store:
        store.add(replace(reach([0.9, 0.2, 0.6]), provenance=given), Purpose.UPDATE, TABLE)
    with DemonstrationStore(path) as store:
        assert [stored.demonstration.provenance for stored in store.active()] == [UNKNOWN, given]


def test_what_a_file_of_schema_4_holds_speaks_of_whole_motions(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
    _as_schema_4(path)
    with DemonstrationStore(path) as store:
        store.add(replace(reach([0.9, 0.2, 0.6]), part=(0.25, 0.75)), Purpose.UPDATE, TABLE)
    with DemonstrationStore(path) as store:
        assert [stored.demonstration.part for stored in store.active()] == [WHOLE, (0.25, 0.75)]


def test_a_file_in_which_an_earlier_version_mixed_two_scenes_is_refused_by_both(path, reach):
    with DemonstrationStore(path) as store:
        for _ in range(2):
            store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, DISHWASHER)
    _as_schema_2(path)
    with sqlite3.connect(path) as old:
        old.execute("UPDATE demonstrations SET scene = 'table' WHERE added = 2")
    old.close()
    with DemonstrationStore(path) as store:
        for wanted in (DISHWASHER, TABLE):
            with pytest.raises(BoundElsewhere, match="scene dishwasher and for scene table"):
                store.check(wanted)


def _not_a_database(path):
    path.write_text("t,x,y,z\n0,1,2,3\n" * 100)


def _of_another_program(path):
    other = sqlite3.connect(path)
    other.execute("CREATE TABLE recipes (name TEXT)")
    other.close()


def _from_the_future(path):
    DemonstrationStore(path).close()
    other = sqlite3.connect(path)
    other.execute("PRAGMA user_version = 99")
    other.close()


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
