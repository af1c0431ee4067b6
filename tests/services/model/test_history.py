"""The history of a skill: what was learnt, by whom, when, how and by how much; any of it taken back and used again."""

import sqlite3
from datetime import UTC, datetime

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from protocol import queries
from protocol.messages import Method, Part, Purpose
from protocol.queries import ENTRIES_AT_ONCE, ListHistory, Redo, Refused, Undo
from tests.services.model.rig import OBJECT, Rig, positions

FARTHER = (0.87, 0.15, 0.55)


def _entries(rig, before=0):
    return rig.ask(queries.HISTORY, ListHistory(before)).entries


def test_an_entry_says_what_was_learnt_by_whom_when_how_and_by_how_much(rig):
    began = datetime.now(UTC).replace(microsecond=0)
    rig.teach(Purpose.INITIAL)
    rig.teach(Purpose.UPDATE, bend=0.1, operator="anna", alpha=0.5, method=Method.REFINE, part=Part(0.0, 0.8))
    update, first = _entries(rig)
    assert (first.id, first.purpose, first.method, first.operator) == (1, Purpose.INITIAL, Method.UNKNOWN, "")
    assert (first.mean, first.most) == (-1.0, -1.0)
    assert (update.id, update.purpose, update.method, update.operator) == (2, Purpose.UPDATE, Method.REFINE, "anna")
    assert (update.alpha, update.part, update.object_position) == (0.5, Part(0.0, 0.8), OBJECT)
    assert update.most == pytest.approx(0.1, abs=0.02)
    assert 0.0 < update.mean < update.most
    assert all(began <= datetime.fromisoformat(one.at) <= datetime.now(UTC) for one in (first, update))
    assert all((one.in_use, one.turned_by, one.turned_at) == (True, "", "") for one in (first, update))


def test_who_took_an_entry_back_and_who_wanted_it_back_is_told_after_a_restart_too(path):
    rig = Rig(path)
    rig.teach(Purpose.INITIAL)
    rig.teach(Purpose.UPDATE, bend=0.1, operator="anna")
    rig.ask(queries.UNDO, Undo(entry=2, operator="ben"))
    taken_back = _entries(rig)[0]
    rig.ask(queries.REDO, Redo(2, operator="eva"))
    used_again = _entries(rig)[0]
    rig.service.close()
    again = Rig(path)
    assert _entries(again)[0] == used_again
    again.service.close()
    assert (taken_back.in_use, taken_back.turned_by) == (False, "ben")
    assert (used_again.in_use, used_again.turned_by, used_again.operator) == (True, "eva", "anna")
    assert taken_back.turned_at <= used_again.turned_at


@pytest.mark.parametrize("entry", [1, 2, 3, 4])
def test_a_model_without_an_entry_is_the_one_that_never_saw_it_and_again_the_one_that_did(tmp_path, entry):
    taught = [
        (Purpose.INITIAL, {"bend": 0.02}),
        (Purpose.INITIAL, {"at": FARTHER}),
        (Purpose.UPDATE, {"bend": 0.1, "at": FARTHER, "alpha": 0.7}),
        (Purpose.UPDATE, {"bend": -0.05}),
    ]
    rig, other = Rig(tmp_path / "one.sqlite"), Rig(tmp_path / "other.sqlite")
    for number, (purpose, how) in enumerate(taught, 1):
        rig.teach(purpose, **how)
        if number != entry:
            other.teach(purpose, **how)
    whole = positions(rig.predict(FARTHER))
    assert rig.ask(queries.UNDO, Undo(entry=entry)).state.version == 5
    np.testing.assert_array_equal(positions(rig.predict(FARTHER)), positions(other.predict(FARTHER)))
    assert rig.ask(queries.REDO, Redo(entry)).state.version == 6
    np.testing.assert_array_equal(positions(rig.predict(FARTHER)), whole)
    rig.service.close()
    other.service.close()


def test_all_can_be_taken_back_and_used_again(rig):
    rig.teach(Purpose.INITIAL)
    before = positions(rig.predict())
    rig.ask(queries.UNDO, Undo(entry=1))
    assert "teach it first" in rig.predict().reason
    rig.ask(queries.REDO, Redo(1))
    np.testing.assert_array_equal(positions(rig.predict()), before)


def test_what_cannot_be_is_refused_in_a_line_and_changes_nothing(rig):
    learnt = rig.teach(Purpose.INITIAL)
    for query, request, words in (
        (queries.UNDO, Undo(entry=7), "no entry 7"),
        (queries.REDO, Redo(7), "no entry 7"),
        (queries.REDO, Redo(1), "no demonstration 1 was taken back"),
    ):
        assert words in rig.ask(query, request).reason
    rig.ask(queries.UNDO, Undo(entry=1))
    assert "no demonstration 1 is in use" in rig.ask(queries.UNDO, Undo(entry=1)).reason
    assert rig.described().version == learnt.state.version + 1


@pytest.mark.parametrize("restarted", [False, True])
def test_taking_back_and_using_again_are_done_once_however_often_they_are_asked_for(path, restarted):
    rig = Rig(path)
    rig.teach(Purpose.INITIAL)
    undone = rig.ask(queries.UNDO, Undo(entry=1, request=21))
    redone = rig.ask(queries.REDO, Redo(1, request=22))
    again = Rig(path) if restarted else rig
    assert again.ask(queries.UNDO, Undo(entry=1, request=21)) == undone
    assert again.ask(queries.REDO, Redo(1, request=22)) == redone
    assert again.described() == redone.state
    again.service.close()


def test_a_long_history_is_told_page_by_page_newest_first(rig):
    rig.teach(Purpose.INITIAL)
    rig.teach(Purpose.UPDATE)
    history = rig.service._history
    history.entries = tuple(
        type(history.entries[1])(number, history.entries[1].purpose, None, history.entries[1].demonstration)
        for number in range(1, ENTRIES_AT_ONCE + 4)
    )
    newest = rig.ask(queries.HISTORY, ListHistory())
    rest = rig.ask(queries.HISTORY, ListHistory(newest.entries[-1].id))
    assert [one.id for one in (*newest.entries, *rest.entries)] == list(range(ENTRIES_AT_ONCE + 3, 0, -1))
    assert (newest.older, rest.older) == (3, 0)


def test_what_the_file_holds_of_another_scene_is_no_part_of_the_history(path):
    """An earlier version did not bind a file for good."""
    rig = Rig(path)
    rig.teach(Purpose.INITIAL)
    rig.ask(queries.UNDO, Undo(entry=1))
    rig.service.close()
    with sqlite3.connect(path) as file:
        file.execute("DELETE FROM skill")
    file.close()
    table = Rig(path, scene="table")
    assert _entries(table) == ()
    assert isinstance(table.ask(queries.REDO, Redo(1)), Refused)
    table.service.close()


@settings(max_examples=12, deadline=None)
@given(st.lists(st.tuples(st.sampled_from(["initial", "update", "undo", "redo"]), st.integers(0, 5)), max_size=8))
def test_whatever_was_done_the_model_is_that_of_the_entries_in_use(tmp_path_factory, steps):
    """Of them alone, given in their order to a model that saw nothing else."""
    folder = tmp_path_factory.mktemp("history")
    rig, fresh = Rig(folder / "rig.sqlite"), Rig(folder / "fresh.sqlite")
    for step, which in steps:
        listed = _entries(rig)
        chosen = [one.id for one in listed if one.in_use is (step == "undo")]
        if step in ("initial", "update"):
            rig.teach(Purpose(step), bend=0.01 * which, at=(0.84 + 0.005 * which, 0.03 * which, 0.55))
        elif chosen:
            entry = chosen[which % len(chosen)]
            rig.ask(*((queries.UNDO, Undo(entry=entry)) if step == "undo" else (queries.REDO, Redo(entry))))
    for stored in reversed(_entries(rig)):
        if stored.in_use:
            given = rig.service._history.find(stored.id).demonstration
            fresh.service._history.add(given, rig.service._history.find(stored.id).purpose, 0)
    expected, predicted = fresh.predict(), rig.predict()
    rig.service.close()
    fresh.service.close()
    assert type(predicted) is type(expected)
    if not isinstance(expected, Refused):
        np.testing.assert_array_equal(positions(predicted), positions(expected))
        assert predicted.prediction.known == expected.prediction.known
