"""What the workflow knows before anything has happened, and that a step's state stays what it was."""

from dataclasses import FrozenInstanceError, fields

import pytest

from protocol import queries
from protocol.messages import Mode
from services.station.workflow.closure import Closure, Failure
from services.station.workflow.state import Episode, Owed, Phase, Place, Workflow
from services.station.workflow.view import Answer, Ask, Step, View
from tests.services.station.workflow.site import BY_HAND
from tests.services.station.workflow.test_closure import CLOSED

VALUES = [
    Place(),
    BY_HAND,
    Episode(1, 1),
    Owed(Phase.LEARNING, 1),
    Workflow(),
    Closure(),
    Failure(CLOSED[0]),
    Ask(queries.UNDO, queries.Undo(request=1), 1),
    Answer(1, queries.Accepted()),
    View(now_s=1.0, number=1),
    Step(Workflow()),
]


@pytest.mark.parametrize("value", VALUES, ids=lambda value: type(value).__name__)
def test_what_a_step_has_said_does_not_change_afterwards(value):
    for field in fields(value):
        with pytest.raises(FrozenInstanceError):
            setattr(value, field.name, None)


def test_a_run_that_begins_has_asked_for_nothing_and_holds_and_owes_nothing():
    state = Workflow()
    assert state.phase is Phase.WAITING
    assert not any((state.question, state.intent, state.retry_s, state.refusals, state.wants, state.pressed))
    assert not any((state.watches, state.epoch, state.holding, state.confirmed, state.episode, state.owed))
    assert not any((state.taught, state.last, state.refinements, state.updates, state.attempts, state.let_go))
    assert not any((state.since_s, state.granted_s, state.heard_s, state.closure.closed))
    assert state.offered == frozenset()


def test_an_episode_that_was_told_has_no_number_yet_and_is_not_asked_to_end():
    assert Episode(request=1, robot=1) == Episode(request=1, robot=1, number=0, finishing=False)


@pytest.mark.parametrize(("mode", "seconds"), [(Mode.AUTONOMOUS, 10.0), (Mode.REFINE, 20.0)])
def test_a_refinement_has_twice_the_time(mode, seconds):
    assert BY_HAND.duration_s(mode) == seconds


def test_a_finished_run_holds_no_authority():
    assert Workflow(phase=Phase.DECIDING, epoch=7, holding=True).held_epoch == 7
    assert Workflow(phase=Phase.FINISHED, epoch=7, holding=True).held_epoch == 0


def test_nothing_is_pressed_or_held_where_nothing_is_said_of_it():
    view = View(now_s=1.0, number=1)
    assert view.present
    assert not any((view.steering, view.stopping, view.latched, view.actions, view.scene_s, view.seen_s))
