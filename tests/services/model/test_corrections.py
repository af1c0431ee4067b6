"""The model process learns a correction: at its condition, as far as it is believed, and its part only."""

import numpy as np
import pytest

from protocol import queries
from protocol.messages import Part, Purpose
from protocol.queries import Undo
from services.bus.arrays import motion_from_wire
from tests.services.model.rig import Rig, positions


def test_a_correction_changes_the_prediction_at_its_condition_and_undo_takes_it_back(rig):
    rig.teach(Purpose.INITIAL)
    before = positions(rig.predict())
    learnt = rig.teach(Purpose.UPDATE, bend=0.1)
    corrected = positions(rig.predict())
    undone = rig.ask(queries.UNDO, Undo())
    assert np.max(corrected[:, 2] - before[:, 2]) == pytest.approx(0.1, abs=0.01)
    np.testing.assert_allclose(positions(rig.predict()), before, atol=1e-12)
    assert (learnt.state.updates, undone.state.updates) == (1, 0)
    assert undone.state.version > learnt.state.version


def test_a_correction_that_is_half_believed_moves_the_prediction_half_the_way(rig):
    """Equation (18) with alpha = 0.5."""
    rig.teach(Purpose.INITIAL)
    before = rig.predict().prediction
    rig.teach(Purpose.UPDATE, bend=0.1, alpha=0.5)
    raised = positions(rig.predict())[:, 2] - motion_from_wire(before.motion)[0][:, 2]
    assert np.max(raised) == pytest.approx(0.05, abs=0.005)


@pytest.mark.parametrize("kind", ["adaptive", "promp"])
def test_a_correction_of_a_part_leaves_the_rest_now_and_when_it_is_learnt_anew(path, kind):
    rig = Rig(path, kind)
    rig.teach(Purpose.INITIAL)
    before = positions(rig.predict())
    rig.teach(Purpose.UPDATE, bend=0.1, part=Part(0.0, 0.5))
    corrected = positions(rig.predict())
    rig.service.close()
    again = Rig(path, kind)
    np.testing.assert_allclose(positions(again.predict()), corrected, atol=1e-12)
    again.service.close()
    raised = corrected[:, 2] - before[:, 2]
    assert raised[30] > 0.04
    np.testing.assert_allclose(raised[55:], 0.0, atol=3e-3)


def test_only_an_update_is_taken_back_unless_a_first_demonstration_is_meant(rig):
    rig.teach(Purpose.INITIAL)
    assert "no update" in rig.ask(queries.UNDO, Undo()).reason
    undone = rig.ask(queries.UNDO, Undo(purpose=Purpose.INITIAL))
    assert (undone.state.demonstrations, undone.state.version) == (0, 2)
    assert "teach" in rig.predict().reason
    assert "no first demonstration" in rig.ask(queries.UNDO, Undo(purpose=Purpose.INITIAL)).reason
