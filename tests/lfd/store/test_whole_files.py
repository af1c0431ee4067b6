"""A file says what skill it is, is copied and restored whole, and is moved only where nobody uses it."""

import pytest

from lfd.exceptions import BoundElsewhere, StorageError, StorageUnavailable
from lfd.store.database import DemonstrationStore
from lfd.store.stored import About, Binding, Purpose
from lfd.store.whole import Whole

DISHWASHER, TABLE = Binding("dishwasher", "tiago"), Binding("table", "tiago")


@pytest.fixture
def path(tmp_path):
    return tmp_path / "demonstrations.sqlite"


def test_what_a_skill_is_for_binds_its_file_before_anything_is_learnt(path, reach):
    with DemonstrationStore(path) as store:
        store.describe(About(TABLE, "anna", "the blue cup", 1.0))
        with pytest.raises(BoundElsewhere, match=r"scene table.*scene dishwasher"):
            store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, DISHWASHER)
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        with pytest.raises(BoundElsewhere, match=r"scene table.*scene dishwasher"):
            store.describe(About(DISHWASHER))
        assert store.about() == About(TABLE, "anna", "the blue cup", 1.0)


def test_a_history_is_restored_bit_by_bit_version_by_version(path, tmp_path, reach):
    with DemonstrationStore(path) as store:
        for y in (0.1, 0.2, 0.3):
            store.add(reach([0.9, y, 0.6]), Purpose.UPDATE, TABLE)
        store.undo(2, author="anna", at_s=3.0)
        store.describe(About(TABLE, "anna"))
        given = store.whole()
    with DemonstrationStore(tmp_path / "other.sqlite") as other:
        other.restore(given)
        assert other.whole() == given
        assert [one.version for one in other.active()] == [1, 3]


def test_what_is_no_history_leaves_an_empty_file_empty(path, tmp_path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE)
        store.describe(About(TABLE))
        about, records, changes = store.whole()
    without_a_motion = (records[0]._replace(arrays=records[0].arrays[:-1]),)
    with DemonstrationStore(tmp_path / "other.sqlite") as other:
        for wrong in ((without_a_motion, changes), (records, ()), ((), changes), (records * 2, changes)):
            with pytest.raises(StorageError):
                other.restore(Whole(about, *wrong))
            assert (other.about(), other.version, other.history()) == (None, 0, [])


def test_a_file_that_another_uses_is_not_settled_and_one_alone_is_a_single_file(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        with DemonstrationStore(path) as second, pytest.raises(StorageUnavailable, match="another process holds it"):
            second.settle()
        store.settle()
        assert [file.name for file in path.parent.iterdir()] == [path.name]


def test_a_copy_is_made_while_the_file_is_in_use_and_holds_what_was_committed(path, tmp_path, reach):
    with DemonstrationStore(path) as store:
        store.describe(About(TABLE))
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        with DemonstrationStore(path) as second:
            second.copy_to(tmp_path / "copy.sqlite")
        with DemonstrationStore(tmp_path / "copy.sqlite") as copy:
            assert copy.whole() == store.whole()
