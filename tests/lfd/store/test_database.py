import sqlite3
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from lfd.exceptions import BoundElsewhere, NothingToUndo, StorageError
from lfd.motion.provenance import UNKNOWN, Provenance
from lfd.store.database import Binding, Counts, DemonstrationStore, Purpose

DISHWASHER, TABLE = Binding("dishwasher", "tiago"), Binding("table", "tiago")
REPOSITORY = Path(__file__).resolve().parents[3]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "demonstrations.sqlite"


def test_what_was_stored_is_read_back_bit_for_bit_and_in_order(path, reach):
    given = [reach([0.9, y, 0.6], bend=y, duration=4.0 + y) for y in (0.1, 0.2, 0.3)]
    with DemonstrationStore(path) as store:
        assert store.version == 0
        versions = [
            store.add(d, purpose, DISHWASHER)
            for d, purpose in zip(given, [Purpose.INITIAL, Purpose.INITIAL, Purpose.UPDATE], strict=True)
        ]
    assert versions == [1, 2, 3]
    with DemonstrationStore(path) as store:
        stored = store.active()
        assert store.version == 3
    assert [(s.version, s.purpose, s.binding) for s in stored][2] == (3, Purpose.UPDATE, DISHWASHER)
    for record, expected in zip(stored, given, strict=True):
        trajectory = record.demonstration.trajectory
        np.testing.assert_array_equal(trajectory.positions, expected.trajectory.positions)
        np.testing.assert_allclose(trajectory.orientations, expected.trajectory.orientations, atol=1e-15)
        np.testing.assert_array_equal(record.demonstration.origin, expected.origin)
        np.testing.assert_array_equal(record.demonstration.condition, expected.condition)
        assert trajectory.duration == expected.trajectory.duration


def test_whose_a_demonstration_is_since_when_and_how_far_it_is_believed_is_kept(path, reach):
    given = [UNKNOWN, Provenance("anna", 1790000000.25, 0.3)]
    with DemonstrationStore(path) as store:
        for provenance in given:
            store.add(replace(reach([0.9, 0.1, 0.6]), provenance=provenance), Purpose.UPDATE, TABLE)
    with DemonstrationStore(path) as store:
        assert [stored.demonstration.provenance for stored in store.active()] == given


def test_undo_takes_back_the_newest_and_makes_a_new_version(path, reach):
    with DemonstrationStore(path) as store:
        for y in (0.1, 0.2):
            store.add(reach([0.9, y, 0.6]), Purpose.UPDATE, TABLE)
        assert store.undo(Purpose.UPDATE) == 3
        assert [s.version for s in store.active()] == [1]
        assert store.add(reach([0.9, 0.3, 0.6]), Purpose.UPDATE, TABLE) == 4
        assert [s.version for s in store.active()] == [1, 4]
        assert [store.undo(Purpose.UPDATE), store.undo(Purpose.UPDATE)] == [5, 6]
        with pytest.raises(NothingToUndo):
            store.undo(Purpose.UPDATE)
        assert store.version == 6


def test_undo_takes_back_the_newest_of_its_purpose_only(path, reach):
    with DemonstrationStore(path) as store:
        for purpose in (Purpose.INITIAL, Purpose.UPDATE, Purpose.INITIAL):
            store.add(reach([0.9, 0.1, 0.6]), purpose, TABLE)
        store.undo(Purpose.UPDATE)
        assert [s.version for s in store.active()] == [1, 3]
        with pytest.raises(NothingToUndo, match="update"):
            store.undo(Purpose.UPDATE)
        store.undo(Purpose.INITIAL)
        assert [s.version for s in store.active()] == [1]


def test_the_counts_of_a_version_stay_what_they_were(path, reach):
    with DemonstrationStore(path) as store:
        for purpose in (Purpose.INITIAL, Purpose.UPDATE, Purpose.UPDATE):
            store.add(reach([0.9, 0.1, 0.6]), purpose, TABLE)
        store.undo(Purpose.UPDATE)
        counted = [store.counts(version) for version in range(5)]
    assert counted == [Counts(0, 0), Counts(1, 0), Counts(1, 1), Counts(1, 2), Counts(1, 1)]


def test_a_request_is_known_by_the_version_that_it_made(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE, request=77)
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE)
        store.undo(Purpose.UPDATE, request=2**53)
    with DemonstrationStore(path) as store:
        assert [store.made_by(request) for request in (77, 2**53, 78)] == [1, 3, None]


def test_a_request_makes_no_second_change(path, reach):
    """Not even where two processes are asked the same at once."""
    with DemonstrationStore(path) as first, DemonstrationStore(path) as second:
        first.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE, request=77)
        with pytest.raises(StorageError):
            second.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE, request=77)
        assert second.version == 1


@pytest.mark.parametrize("other", [TABLE, Binding("dishwasher", "particle")])
def test_what_was_learnt_for_one_scene_and_robot_takes_nothing_from_another(path, reach, other):
    with DemonstrationStore(path) as store:
        store.check(other)
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, DISHWASHER)
        store.check(DISHWASHER)
        for refused in (lambda: store.check(other), lambda: store.add(reach([0.9, 0.2, 0.6]), Purpose.UPDATE, other)):
            with pytest.raises(BoundElsewhere) as caught:
                refused()
            for words in (str(path), str(DISHWASHER), str(other)):
                assert words in str(caught.value)
        assert store.version == 1


def test_a_file_in_which_nothing_is_active_is_free_for_another_scene(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, DISHWASHER)
        store.undo(Purpose.INITIAL)
        store.check(TABLE)


WRITER = """
import sys
import numpy as np
from lfd.motion.demonstration import Demonstration
from lfd.store.database import Binding, DemonstrationStore, Purpose
from lfd.motion.trajectory import Trajectory

store = DemonstrationStore(sys.argv[1])
trajectory = Trajectory(np.arange(30.0).reshape(10, 3), np.tile([1.0, 0.0, 0.0, 0.0], (10, 1)), 5.0)
given = Demonstration.reaching(trajectory, np.zeros(3))
while True:
    print(store.add(given, Purpose.UPDATE, Binding("table", "tiago")), flush=True)
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
        assert first.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE) == 1
        assert second.add(reach([0.9, 0.2, 0.6]), Purpose.UPDATE, TABLE) == 2
        assert first.version == 2


def test_a_damaged_record_is_reported_and_not_returned(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        other = sqlite3.connect(path, isolation_level=None)
        other.execute("UPDATE arrays SET bytes = x'00' WHERE name = 'positions'")
        other.close()
        with pytest.raises(StorageError, match="demonstration 1 is damaged"):
            store.active()
