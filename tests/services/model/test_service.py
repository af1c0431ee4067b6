"""The model process: what it has acknowledged is on disk, and what it cannot do it refuses."""

import numpy as np
import pytest

from protocol import queries, topics
from protocol.messages import Pose
from protocol.queries import AddDemonstration, Kind, Learnt, Predicted, Refused
from services.bus.arrays import motion_from_wire, motion_to_wire
from services.bus.memory import MemoryNetwork
from services.model.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration, ModelSection
from services.process.exceptions import ServiceError

START = Pose((0.5, 0.0, 0.4), (1.0, 0.0, 0.0, 0.0))
OBJECT = (0.85, 0.05, 0.55)


class Rig:
    """A model process on a memory bus."""

    def __init__(self, path, kind="adaptive"):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.configuration = Configuration(model=ModelSection(kind=kind, database=str(path)))
        self.service = build(self.network.bus(), self.clock, self.configuration)
        self.asker = self.network.bus()

    def ask(self, query, request):
        pending = self.asker.ask(query, request)
        self.service.step(self.clock.now_ns())
        return pending.poll()

    def teach(self, kind, bend=0.0, at=OBJECT, **more):
        t = np.linspace(0.0, 1.0, 40)[:, None]
        path = np.array(START.position) + t * (np.array(at) - START.position) + np.sin(np.pi * t) * [0.0, 0.0, bend]
        motion = motion_to_wire(path, np.tile(START.orientation, (40, 1)), 10.0)
        return self.ask(queries.ADD_DEMONSTRATION, AddDemonstration(kind, motion, at, "dishwasher", **more))

    def predict(self, at=OBJECT):
        return self.ask(queries.PREDICT, queries.Predict(at, START))


@pytest.fixture
def path(tmp_path):
    return tmp_path / "model.sqlite"


@pytest.fixture
def rig(path):
    rig = Rig(path)
    yield rig
    rig.service.close()


def positions(predicted):
    return motion_from_wire(predicted.prediction.motion)[0]


def test_without_a_demonstration_there_is_no_prediction(rig):
    assert "teach" in rig.predict().reason


def test_a_prediction_leads_from_the_start_to_the_object(rig):
    rig.teach(Kind.INITIAL)
    predicted = rig.predict()
    assert isinstance(predicted, Predicted)
    np.testing.assert_allclose(positions(predicted)[[0, -1]], [START.position, OBJECT], atol=1e-3)


def test_a_prediction_is_announced_with_the_version_that_made_it(rig):
    subscription = rig.network.bus().subscribe(topics.PREDICTION)
    version = rig.teach(Kind.INITIAL).state.version
    predicted = rig.predict().prediction
    announced = subscription.latest().message
    assert (announced.id, announced.motion) == (predicted.id, predicted.motion)
    assert announced.model_version == version


def test_every_prediction_has_an_id_of_its_own(rig):
    rig.teach(Kind.INITIAL)
    identities = {rig.predict().prediction.id for _ in range(5)}
    assert len(identities) == 5
    assert 0 not in identities


def test_the_newest_prediction_is_repeated_for_whoever_did_not_hear_it(rig):
    rig.teach(Kind.INITIAL)
    rig.predict()
    newest = rig.predict().prediction
    late = rig.network.bus().subscribe(topics.PREDICTION)
    for _ in range(300):
        rig.clock.advance(0.01)
        rig.service.step(rig.clock.now_ns())
    assert [received.message.id for received in late.take()] == [newest.id] * 3


def test_a_correction_changes_the_prediction_at_its_condition_and_undo_takes_it_back(rig):
    rig.teach(Kind.INITIAL)
    before = positions(rig.predict())
    learnt = rig.teach(Kind.UPDATE, bend=0.1)
    corrected = positions(rig.predict())
    undone = rig.ask(queries.UNDO, queries.Undo())
    assert np.max(corrected[:, 2] - before[:, 2]) == pytest.approx(0.1, abs=0.01)
    np.testing.assert_allclose(positions(rig.predict()), before, atol=1e-12)
    assert (learnt.state.updates, undone.state.updates) == (1, 0)
    assert undone.state.version > learnt.state.version


def test_a_correction_that_is_half_believed_moves_the_prediction_half_the_way(rig):
    """Equation (18) with alpha = 0.5."""
    rig.teach(Kind.INITIAL)
    before = rig.predict().prediction
    rig.teach(Kind.UPDATE, bend=0.1, prediction=before.motion, alpha=0.5)
    raised = positions(rig.predict())[:, 2] - motion_from_wire(before.motion)[0][:, 2]
    assert np.max(raised) == pytest.approx(0.05, abs=0.005)


def test_a_model_of_another_condition_refuses_the_motion(rig):
    rig.teach(Kind.INITIAL)
    assert "condition" in rig.teach(Kind.UPDATE, condition=(0.1, 0.2)).reason


@pytest.mark.parametrize("kind", ["adaptive", "promp"])
def test_a_new_process_predicts_as_the_one_that_was_killed(path, kind):
    first = Rig(path, kind)
    first.teach(Kind.INITIAL)
    first.teach(Kind.INITIAL, at=(0.8, -0.1, 0.55))
    first.teach(Kind.UPDATE, bend=0.1)
    expected = first.predict()
    second = Rig(path, kind)
    try:
        again = second.predict()
        assert again.prediction.model_version == expected.prediction.model_version
        np.testing.assert_array_equal(positions(again), positions(expected))
    finally:
        first.service.close()
        second.service.close()


def test_the_initial_demonstrations_are_never_undone(rig):
    rig.teach(Kind.INITIAL)
    assert isinstance(rig.ask(queries.UNDO, queries.Undo()), Refused)


def test_a_motion_that_is_no_number_is_refused_and_nothing_is_learnt(rig):
    motion = motion_to_wire(np.full((5, 3), np.nan), np.tile(START.orientation, (5, 1)), 10.0)
    reply = rig.ask(queries.ADD_DEMONSTRATION, AddDemonstration(Kind.INITIAL, motion, OBJECT, "dishwasher"))
    assert "finite" in reply.reason
    described = rig.ask(queries.DESCRIBE, queries.Describe())
    assert isinstance(described, Learnt)
    assert described.state.version == 0


def test_a_file_that_is_no_database_is_named_in_one_line(path):
    path.write_bytes(b"this is no database, whatever its name says" * 100)
    with pytest.raises(ServiceError, match=r"model\.sqlite") as caught:
        Rig(path)
    assert "\n" not in str(caught.value)
