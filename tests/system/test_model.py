"""The model process, killed as a computer's failure would: what was asked twice is done once, and said the same."""

import sqlite3
from contextlib import closing

import numpy as np
import pytest

from lfd.motion.demonstration import Demonstration
from lfd.motion.trajectory import Trajectory
from lfd.store.database import DemonstrationStore
from lfd.store.stored import Binding, Purpose
from protocol import messages, queries
from protocol.queries import Undo
from services.bus.arrays import motion_to_wire
from tests.system.harness import Command, Witness, configured

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

OBJECT = (0.85, 0.05, 0.55)


def demonstration(purpose, request):
    positions = np.linspace((0.5, 0.0, 0.4), OBJECT, 40)
    motion = motion_to_wire(positions, np.tile((1.0, 0.0, 0.0, 0.0), (40, 1)), 10.0)
    return queries.AddDemonstration(purpose, motion, OBJECT, "dishwasher", request=request)


def test_a_request_that_is_repeated_after_kill_9_changes_nothing_and_is_answered_the_same(tmp_path, router):
    configuration = configured(tmp_path, router, model=f'database = "{tmp_path / "model.sqlite"}"')
    asked = (
        (queries.ADD_DEMONSTRATION, demonstration(messages.Purpose.INITIAL, 1)),
        (queries.ADD_DEMONSTRATION, demonstration(messages.Purpose.UPDATE, 2)),
        (queries.UNDO, Undo(request=3)),
    )
    answers = []
    with Witness(router) as witness:
        for _ in range(2):
            with Command("model", "--config", configuration, folder=tmp_path) as model:
                witness.asked(queries.DESCRIBE, queries.Describe())
                answers.append([witness.asked(query, request).state for query, request in asked])
                model.process.kill()
        with Command("model", "--config", configuration, folder=tmp_path):
            assert witness.asked(queries.DESCRIBE, queries.Describe()).state.version == 3
    assert [(a.version, a.demonstrations, a.updates) for a in answers[0]] == [(1, 1, 0), (2, 1, 1), (3, 1, 0)]
    assert answers[1] == answers[0]


def test_what_was_taught_is_taken_back_from_the_command_line(tmp_path, router):
    configuration = configured(tmp_path, router, model=f'database = "{tmp_path / "model.sqlite"}"')
    with Command("model", "--config", configuration, folder=tmp_path), Witness(router) as witness:
        for purpose in (messages.Purpose.INITIAL, messages.Purpose.UPDATE):
            witness.asked(queries.ADD_DEMONSTRATION, demonstration(purpose, 0))
        for left in ((1, 0), (0, 0)):
            with Command("teach", "--undo", "--config", configuration, folder=tmp_path) as teach:
                assert teach.ended(20.0) == 0, teach.tail()
            state = witness.asked(queries.DESCRIBE, queries.Describe()).state
            assert (state.demonstrations, state.updates) == left
        with Command("teach", "--undo", "--config", configuration, folder=tmp_path) as teach:
            assert teach.ended(20.0) != 0
        assert "no first demonstration" in teach.err


def test_teaching_another_scene_than_the_running_models_is_refused_by_both_names(tmp_path, router):
    configuration = configured(tmp_path, router, model=f'database = "{tmp_path / "model.sqlite"}"')
    with Command("model", "--config", configuration, folder=tmp_path), Witness(router) as witness:
        witness.asked(queries.DESCRIBE, queries.Describe())
        with Command("teach", "--scene", "table", "--undo", "--config", configuration, folder=tmp_path) as teach:
            assert teach.ended(20.0) != 0
        assert "dishwasher" in teach.err
        assert "table" in teach.err


@pytest.mark.parametrize(
    ("file", "code", "said"),
    [("notes", 2, "not readable"), ("of the table", 2, "scene table"), ("held", 3, "holds it")],
)
def test_a_database_that_cannot_be_used_ends_the_process_in_one_line_and_the_code_tells_why(
    tmp_path, router, file, code, said
):
    path = tmp_path / "model.sqlite"
    configuration = configured(tmp_path, router, model=f'database = "{path}"')
    if file == "of the table":
        with DemonstrationStore(path) as store:
            motion = Trajectory(np.linspace((0.5, 0, 0.4), OBJECT, 9), np.tile((1.0, 0, 0, 0), (9, 1)), 5.0)
            store.add(Demonstration.reaching(motion, np.array(OBJECT)), Purpose.INITIAL, Binding("table", "tiago"))
    with closing(sqlite3.connect(path, isolation_level=None)) as holder:
        if file == "held":
            holder.execute("BEGIN EXCLUSIVE")
        if file == "notes":
            path.write_bytes(b"these are notes" * 100)
        with Command("model", "--config", configuration, folder=tmp_path) as model:
            assert model.ended(30.0) == code, model.tail()
        (line,) = [line for line in model.err.splitlines() if not line.startswith("INFO")]
        assert str(path) in line
        assert said in line
