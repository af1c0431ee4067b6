"""What an entry changes: the predictions with it against those without it, at its place and over the scene."""

import numpy as np
import pytest

from protocol import queries
from protocol.messages import Purpose
from protocol.queries import Compare, Predicted, Redo, Undo
from services.bus.arrays import from_wire, motion_from_wire
from services.model.comparison import PLACES
from tests.services.model.rig import Rig, positions

STEPS = PLACES**2 + 10
NEAR, FAR = (0.83, -0.08, 0.553), (0.88, 0.22, 0.553)


def _compared(rig, entry):
    """The effect, once there have been enough steps for those that come first."""
    for _ in range(3 * STEPS):
        if (effect := rig.ask(queries.COMPARE, Compare(entry)).effect) is not None:
            return effect
    return None


@pytest.fixture
def taught(rig):
    rig.teach(Purpose.INITIAL)
    rig.teach(Purpose.INITIAL, at=FAR)
    rig.without = positions(rig.predict(NEAR))
    rig.teach(Purpose.UPDATE, bend=0.1, at=NEAR)
    rig.with_it = positions(rig.predict(NEAR))
    return rig


def test_the_motion_at_its_place_is_told_with_and_without_it(taught):
    effect = _compared(taught, 3)
    np.testing.assert_array_equal(motion_from_wire(effect.with_it)[0], taught.with_it)
    np.testing.assert_array_equal(motion_from_wire(effect.without_it)[0], taught.without)
    assert effect.object_position == NEAR


def test_the_field_says_where_predictions_were_moved_and_how_far_and_what_is_known(taught):
    field = _compared(taught, 3).field
    moved, known, before = (from_wire(a) for a in (field.moved, field.known, field.known_without))
    assert (field.axes, field.lower, field.upper) == ((0, 1), NEAR[:2], FAR[:2])
    assert moved.shape == known.shape == before.shape == (PLACES, PLACES)
    assert moved[0, 0] == pytest.approx(0.1, abs=0.01)
    assert moved[-1, -1] < moved[0, 0]
    assert np.all((known >= 0.0) & (known <= 1.0))
    assert known[0, 0] >= before[0, 0]


def test_the_effect_of_a_change_is_made_before_anybody_asks_and_no_step_makes_all_of_it(taught):
    assert taught.ask(queries.COMPARE, Compare(3)).effect is None
    assert isinstance(taught.predict(), Predicted)
    assert _compared(taught, 3) is not None
    taught.ask(queries.UNDO, Undo(entry=3))
    for _ in range(STEPS):
        taught.service.step(taught.clock.now_ns())
    assert taught.ask(queries.COMPARE, Compare(3)).effect is not None


def test_who_asks_last_waits_for_no_others(taught):
    for entry in (1, 2, 3):
        assert taught.ask(queries.COMPARE, Compare(entry)).effect is None
    for _ in range(STEPS):
        taught.service.step(taught.clock.now_ns())
    assert taught.ask(queries.COMPARE, Compare(3)).effect is not None
    assert taught.ask(queries.COMPARE, Compare(1)).effect is None


def test_what_was_taken_back_is_compared_as_what_it_would_change(taught):
    in_use = _compared(taught, 3)
    taught.ask(queries.UNDO, Undo(entry=3))
    assert _compared(taught, 3) == in_use


def test_an_effect_is_that_in_the_model_of_now(taught):
    alone = _compared(taught, 3)
    taught.teach(Purpose.UPDATE, bend=0.1, at=NEAR)
    beside_the_same = _compared(taught, 3)
    largest = [np.max(from_wire(effect.field.moved)) for effect in (alone, beside_the_same)]
    assert largest[1] < 0.5 * largest[0]
    taught.ask(queries.UNDO, Undo(entry=4))
    taught.ask(queries.REDO, Redo(4))
    assert _compared(taught, 3) == beside_the_same


def test_without_the_only_demonstration_nothing_is_predicted(rig):
    rig.teach(Purpose.INITIAL)
    effect = _compared(rig, 1)
    assert (effect.without_it, effect.field) == (None, None)
    np.testing.assert_array_equal(motion_from_wire(effect.with_it)[0], positions(rig.predict()))
    rig.ask(queries.UNDO, Undo(entry=1))
    assert _compared(rig, 1) == effect


def test_an_entry_that_is_not_there_is_refused(rig):
    assert "no entry 5" in rig.ask(queries.COMPARE, Compare(5)).reason


def test_a_scene_without_an_object_is_compared_over_its_conditions(path):
    rig = Rig(path, scene="particle")
    end = tuple((rig.service._scene.start.position + np.array([0.4, 0.0, 0.0])).tolist())
    begin = tuple(rig.service._scene.start.position.tolist())
    for purpose, bend in ((Purpose.INITIAL, 0.0), (Purpose.UPDATE, 0.02)):
        rig.teach(purpose, bend, end, start=begin, scene="particle", condition=(0.0, 0.05))
    field = _compared(rig, 2).field
    rig.service.close()
    assert field.axes == (0, 1)
    assert np.max(from_wire(field.moved)) > 0.005
