"""What the model process has acknowledged is on disk, once, and comes back as it was."""

import sqlite3
from datetime import UTC, datetime

import numpy as np
import pytest

from lfd.exceptions import StorageError
from lfd.store import connection
from lfd.store.database import DemonstrationStore
from protocol import queries
from protocol.messages import Purpose
from protocol.queries import Predicted, Undo
from services.model.exceptions import SkillMisfit
from tests.services.model.rig import Rig, positions


def test_a_correction_is_stored_whole_with_its_author_its_time_and_how_far_it_is_believed(rig, path):
    began = datetime.now(UTC).timestamp()
    rig.teach(Purpose.INITIAL)
    rig.teach(Purpose.UPDATE, bend=0.1, operator="anna", alpha=0.5)
    with DemonstrationStore(path) as store:
        first, correction = (stored.demonstration for stored in store.active())
    assert (first.provenance.author, first.provenance.confidence) == ("", 1.0)
    assert (correction.provenance.author, correction.provenance.confidence) == ("anna", 0.5)
    assert began <= first.provenance.at_s <= correction.provenance.at_s <= datetime.now(UTC).timestamp()
    assert np.max(correction.trajectory.positions[:, 2] - first.trajectory.positions[:, 2]) == pytest.approx(0.1, 0.01)


def test_a_restarted_process_believes_what_it_learnt_as_far_as_before(rig, path):
    rig.teach(Purpose.INITIAL)
    rig.teach(Purpose.UPDATE, bend=0.1, alpha=0.5)
    before = positions(rig.predict())
    rig.service.close()
    again = Rig(path)
    np.testing.assert_allclose(positions(again.predict()), before, atol=1e-9)
    again.service.close()


@pytest.mark.parametrize("kind", ["adaptive", "promp"])
def test_a_new_process_predicts_as_the_one_that_was_killed(path, kind):
    first = Rig(path, kind)
    first.teach(Purpose.INITIAL)
    first.teach(Purpose.INITIAL, at=(0.8, -0.1, 0.55))
    first.teach(Purpose.UPDATE, bend=0.1)
    expected = first.predict()
    second = Rig(path, kind)
    try:
        again = second.predict()
        assert again.prediction.model_version == expected.prediction.model_version
        np.testing.assert_array_equal(positions(again), positions(expected))
    finally:
        first.service.close()
        second.service.close()


@pytest.mark.parametrize("restarted", [False, True])
def test_what_is_asked_twice_is_done_once_and_answered_the_same(path, restarted):
    """The reply was lost, or the process killed before it could give one."""
    rig = Rig(path)
    rig.teach(Purpose.INITIAL)
    added = rig.teach(Purpose.UPDATE, bend=0.1, request=11)
    undone = rig.ask(queries.UNDO, Undo(request=12))
    later = rig.teach(Purpose.UPDATE, bend=0.05)
    again = Rig(path) if restarted else rig
    assert again.teach(Purpose.UPDATE, bend=0.1, request=11) == added
    assert again.ask(queries.UNDO, Undo(request=12)) == undone
    assert again.described() == later.state
    again.service.close()


def test_requests_without_a_number_are_each_done(rig):
    rig.teach(Purpose.INITIAL)
    assert [rig.teach(Purpose.UPDATE).state.updates for _ in range(2)] == [1, 2]


def test_a_database_of_another_scene_is_refused_by_both_names_and_untouched(path):
    first = Rig(path)
    first.teach(Purpose.INITIAL)
    first.service.close()
    for scene in ("table", "particle"):
        with pytest.raises(SkillMisfit, match=rf"'model' is for task dishwasher on tiago.* in {scene}") as caught:
            Rig(path, scene=scene)
        assert "\n" not in str(caught.value)
    again = Rig(path)
    assert again.described().demonstrations == 1
    again.service.close()


def test_a_file_that_is_no_database_is_named_in_one_line(path):
    path.write_bytes(b"this is no database, whatever its name says" * 100)
    with pytest.raises(StorageError, match=r"model\.sqlite") as caught:
        Rig(path)
    assert "\n" not in str(caught.value)


def test_a_database_that_somebody_writes_to_costs_the_change_only_and_the_next_one_succeeds(rig, path, monkeypatch):
    monkeypatch.setattr(connection, "BUSY_TIMEOUT", 0.01)
    rig.service.close()
    rig = Rig(path)
    learnt = rig.teach(Purpose.INITIAL)
    holder = sqlite3.connect(path, isolation_level=None)
    holder.execute("BEGIN IMMEDIATE")
    assert "another process holds it" in rig.teach(Purpose.UPDATE, bend=0.1, request=7).reason
    for _ in range(3):
        rig.clock.advance(1.0)
        assert isinstance(rig.predict(), Predicted)
    assert rig.described() == learnt.state
    holder.execute("ROLLBACK")
    holder.close()
    assert rig.teach(Purpose.UPDATE, bend=0.1, request=8).state.updates == 1
    rig.service.close()
