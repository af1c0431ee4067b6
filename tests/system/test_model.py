"""The model process, killed as a computer's failure would: what was asked twice is done once, and said the same."""

import numpy as np
import pytest

from protocol import queries
from protocol.queries import Kind, Undo
from services.bus.arrays import motion_to_wire
from tests.system.harness import Command, Witness, configured

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

OBJECT = (0.85, 0.05, 0.55)


def demonstration(kind, request):
    positions = np.linspace((0.5, 0.0, 0.4), OBJECT, 40)
    motion = motion_to_wire(positions, np.tile((1.0, 0.0, 0.0, 0.0), (40, 1)), 10.0)
    return queries.AddDemonstration(kind, motion, OBJECT, "dishwasher", request=request)


def test_a_request_that_is_repeated_after_kill_9_changes_nothing_and_is_answered_the_same(tmp_path, router):
    configuration = configured(tmp_path, router, model=f'database = "{tmp_path / "model.sqlite"}"')
    asked = (
        (queries.ADD_DEMONSTRATION, demonstration(Kind.INITIAL, 1)),
        (queries.ADD_DEMONSTRATION, demonstration(Kind.UPDATE, 2)),
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
        for kind in (Kind.INITIAL, Kind.UPDATE):
            witness.asked(queries.ADD_DEMONSTRATION, demonstration(kind, 0))
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
