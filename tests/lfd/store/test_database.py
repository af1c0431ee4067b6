import sqlite3
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lfd.exceptions import BoundElsewhere, NothingToRedo, NothingToUndo, StorageError
from lfd.motion.demonstration import Demonstration
from lfd.motion.departure import Departure
from lfd.motion.provenance import UNKNOWN, Method, Provenance
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Binding, Counts, Purpose, Turn

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


def test_how_far_the_gripper_was_open_is_kept_bit_for_bit(path, reach):
    plain = reach([0.9, 0.1, 0.6])
    opening = np.where(plain.trajectory.phases < 0.8, 0.08, 0.0)
    given = replace(plain, trajectory=replace(plain.trajectory, opening=opening))
    with DemonstrationStore(path) as store:
        store.add(given, Purpose.INITIAL, DISHWASHER)
        store.add(plain, Purpose.UPDATE, DISHWASHER)
    with DemonstrationStore(path) as store:
        with_it, without = store.active()
    np.testing.assert_array_equal(with_it.demonstration.trajectory.opening, opening)
    assert without.demonstration.trajectory.opening is None


def test_whose_a_demonstration_is_since_when_and_how_far_it_is_believed_is_kept(path, reach):
    given = [UNKNOWN, Provenance("anna", 1790000000.25, 0.3, Method.WAYPOINTS)]
    with DemonstrationStore(path) as store:
        for provenance in given:
            store.add(replace(reach([0.9, 0.1, 0.6]), provenance=provenance), Purpose.UPDATE, TABLE)
    with DemonstrationStore(path) as store:
        assert [stored.demonstration.provenance for stored in store.active()] == given


def test_how_far_a_correction_led_from_the_prediction_is_kept(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.INITIAL, TABLE)
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE, departure=Departure(0.01, 0.04))
    with DemonstrationStore(path) as store:
        assert [stored.departure for stored in store.history()] == [None, Departure(0.01, 0.04)]


@pytest.mark.parametrize("version", [1, 2, 3])
def test_any_demonstration_is_taken_back_and_used_again_in_its_place(path, reach, version):
    with DemonstrationStore(path) as store:
        for purpose in (Purpose.INITIAL, Purpose.UPDATE, Purpose.UPDATE):
            store.add(reach([0.9, 0.1, 0.6]), purpose, TABLE)
        assert store.undo(version, author="ben", at_s=7.5) == 4
    with DemonstrationStore(path) as store:
        assert [s.version for s in store.active()] == [v for v in (1, 2, 3) if v != version]
        taken = store.history()[version - 1]
        assert (taken.in_use, taken.turn) == (False, Turn(4, False, "ben", 7.5))
        assert store.redo(version, author="eva", at_s=9.5) == 5
        assert [s.version for s in store.active()] == [1, 2, 3]
        assert store.history()[version - 1].turn == Turn(5, True, "eva", 9.5)
        assert store.add(reach([0.9, 0.3, 0.6]), Purpose.UPDATE, TABLE) == 6


def test_what_is_not_in_use_cannot_be_taken_back_nor_what_is_be_used_again(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE)
        for version in (1, 2):
            with pytest.raises(NothingToRedo, match=f"no demonstration {version} was taken back"):
                store.redo(version)
        store.undo(1)
        for version in (1, 2):
            with pytest.raises(NothingToUndo, match=f"no demonstration {version} is in use"):
                store.undo(version)
        assert store.version == 2


def test_nothing_is_used_again_beside_what_is_of_another_scene(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE)
        store.undo(1)
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, DISHWASHER)
        with pytest.raises(BoundElsewhere):
            store.redo(1)
        assert [s.version for s in store.active()] == [3]


@settings(max_examples=60, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(["add", "undo", "redo"]), st.integers(0, 5)), max_size=25))
def test_whatever_is_added_taken_back_and_used_again_the_file_says_what_is_in_use(tmp_path_factory, steps):
    """In the order in which it was added, now and in every version before."""
    path = tmp_path_factory.mktemp("history") / "demonstrations.sqlite"
    added, in_use, counted = 0, set(), [Counts(0, 0)]
    with DemonstrationStore(path) as store:
        for step, which in steps:
            version = len(counted)
            chosen = sorted(in_use if step == "undo" else set(_versions(store)) - in_use)
            if step == "add":
                in_use.add(store.add(_short(added), Purpose.UPDATE, TABLE))
                added += 1
            elif chosen:
                one = chosen[which % len(chosen)]
                assert (store.undo if step == "undo" else store.redo)(one) == version
                (in_use.remove if step == "undo" else in_use.add)(one)
            else:
                continue
            counted.append(Counts(0, len(in_use)))
    with DemonstrationStore(path) as store:
        assert [s.version for s in store.active()] == sorted(in_use)
        assert len(store.history()) == added
        assert store.version == len(counted) - 1
        assert [store.counts(version) for version in range(len(counted))] == counted


def _versions(store):
    return [stored.version for stored in store.history()]


def _short(number):
    positions = np.array([[0.0, 0.0, 0.0], [1.0, float(number), 0.0]])
    return Demonstration.reaching(Trajectory(positions, np.tile([1.0, 0.0, 0.0, 0.0], (2, 1)), 5.0), np.ones(3))


def test_the_counts_of_a_version_stay_what_they_were(path, reach):
    with DemonstrationStore(path) as store:
        for purpose in (Purpose.INITIAL, Purpose.UPDATE, Purpose.UPDATE):
            store.add(reach([0.9, 0.1, 0.6]), purpose, TABLE)
        store.undo(2)
        store.undo(1)
        store.redo(2)
        counted = [store.counts(version) for version in range(7)]
    assert counted[:4] == [Counts(0, 0), Counts(1, 0), Counts(1, 1), Counts(1, 2)]
    assert counted[4:] == [Counts(1, 1), Counts(0, 1), Counts(0, 2)]


def test_a_request_is_known_by_the_version_that_it_made(path, reach):
    with DemonstrationStore(path) as store:
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE, request=77)
        store.add(reach([0.9, 0.1, 0.6]), Purpose.UPDATE, TABLE)
        store.undo(2, request=2**53)
        store.redo(2, request=5)
    with DemonstrationStore(path) as store:
        assert [store.made_by(request) for request in (77, 2**53, 5, 78)] == [(1, 1), (3, 2), (4, 2), None]


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
        store.undo(1)
        store.check(TABLE)


WRITER = """
import sys
import numpy as np
from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Binding, Purpose

store = DemonstrationStore(sys.argv[1])
trajectory = Trajectory(np.arange(30.0).reshape(10, 3), np.tile([1.0, 0.0, 0.0, 0.0], (10, 1)), 5.0)
given = Demonstration.reaching(trajectory, np.zeros(3))
while True:
    version = store.add(given, Purpose.UPDATE, Binding("table", "tiago"))
    print(version, flush=True)
    print(store.undo(version), flush=True)
    print(store.redo(version), flush=True)
"""


def test_what_was_acknowledged_survives_kill_9(path):
    command = [sys.executable, "-c", WRITER, str(path)]
    with subprocess.Popen(command, cwd=REPOSITORY, stdout=subprocess.PIPE, text=True) as writer:
        for _ in range(20):
            acknowledged = int(writer.stdout.readline())
        writer.kill()
        acknowledged = max([acknowledged, *(int(line) for line in writer.stdout if line.endswith("\n"))])
    with DemonstrationStore(path) as store:
        added, (whole, step) = store.history(), divmod(store.version, 3)
        assert store.version >= acknowledged
        assert [s.version for s in added] == list(range(1, store.version + 1, 3))
        assert [s.turn.version for s in added] == [*range(3, 3 * whole + 1, 3), *[store.version] * (step > 0)]
        assert [s.in_use for s in added] == [True] * whole + [step == 1] * (step > 0)


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
