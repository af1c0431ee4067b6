"""The model process: what it has acknowledged is on disk, and what it cannot do it refuses."""

import sqlite3
from dataclasses import replace
from datetime import UTC, datetime

import msgspec
import numpy as np
import pytest

from lfd.exceptions import StorageError
from lfd.models.model import Way
from lfd.store import connection
from lfd.store.database import DemonstrationStore
from protocol import messages, queries, topics
from protocol.messages import Part, Pose
from protocol.queries import AddDemonstration, Kind, Learnt, Predicted, Undo
from services.bus.arrays import motion_from_wire, motion_to_wire
from services.bus.memory import MemoryNetwork
from services.model.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration, ModelSection, RobotSection

START = Pose((0.5, 0.0, 0.4), (1.0, 0.0, 0.0, 0.0))
OBJECT = (0.85, 0.05, 0.55)


class Rig:
    """A model process on a memory bus."""

    def __init__(self, path, kind="adaptive", scene="dishwasher"):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.configuration = Configuration(
            robot=RobotSection(scene=scene), model=ModelSection(kind=kind, database=str(path))
        )
        self.service = build(self.network.bus(), self.clock, self.configuration)
        self.asker = self.network.bus()

    def ask(self, query, request):
        pending = self.asker.ask(query, request)
        self.service.step(self.clock.now_ns())
        return pending.poll()

    def teach(self, kind, bend=0.0, at=OBJECT, duration=10.0, **more):
        t = np.linspace(0.0, 1.0, 40)[:, None]
        path = np.array(START.position) + t * (np.array(at) - START.position) + np.sin(np.pi * t) * [0.0, 0.0, bend]
        motion = motion_to_wire(path, np.tile(START.orientation, (40, 1)), duration)
        given = {"scene": "dishwasher", **more}
        return self.ask(queries.ADD_DEMONSTRATION, AddDemonstration(kind, motion, at, **given))

    def described(self):
        return self.ask(queries.DESCRIBE, queries.Describe()).state

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
    undone = rig.ask(queries.UNDO, Undo())
    assert np.max(corrected[:, 2] - before[:, 2]) == pytest.approx(0.1, abs=0.01)
    np.testing.assert_allclose(positions(rig.predict()), before, atol=1e-12)
    assert (learnt.state.updates, undone.state.updates) == (1, 0)
    assert undone.state.version > learnt.state.version


def test_a_correction_that_is_half_believed_moves_the_prediction_half_the_way(rig):
    """Equation (18) with alpha = 0.5."""
    rig.teach(Kind.INITIAL)
    before = rig.predict().prediction
    rig.teach(Kind.UPDATE, bend=0.1, alpha=0.5)
    raised = positions(rig.predict())[:, 2] - motion_from_wire(before.motion)[0][:, 2]
    assert np.max(raised) == pytest.approx(0.05, abs=0.005)


def test_a_prediction_says_how_much_of_it_is_known(rig):
    for y in (0.05, 0.1):
        rig.teach(Kind.INITIAL, at=(0.85, y, 0.55))
    shares = [rig.predict((0.85, y, 0.55)).prediction.known for y in (0.05, 0.15, 0.3, 0.5)]
    assert shares[0] == 1.0
    assert shares == sorted(shares, reverse=True)
    assert shares[-1] < 0.1


def test_a_prediction_says_which_of_several_ways_it_takes(rig, monkeypatch):
    rig.teach(Kind.INITIAL)
    predict = type(rig.service._model).predict
    monkeypatch.setattr(
        type(rig.service._model), "predict", lambda *asked: replace(predict(*asked), known=0.6, way=Way(1, 2, 0.8))
    )
    prediction = rig.predict().prediction
    assert prediction.way == messages.Way(1, 2, 0.8)
    assert prediction.known == 0.6


@pytest.mark.parametrize("kind", ["adaptive", "promp"])
def test_a_correction_of_a_part_leaves_the_rest_now_and_when_it_is_learnt_anew(path, kind):
    rig = Rig(path, kind)
    rig.teach(Kind.INITIAL)
    before = positions(rig.predict())
    rig.teach(Kind.UPDATE, bend=0.1, part=Part(0.0, 0.5))
    corrected = positions(rig.predict())
    rig.service.close()
    again = Rig(path, kind)
    np.testing.assert_allclose(positions(again.predict()), corrected, atol=1e-12)
    again.service.close()
    raised = corrected[:, 2] - before[:, 2]
    assert raised[30] > 0.04
    np.testing.assert_allclose(raised[55:], 0.0, atol=3e-3)


def test_a_model_does_not_begin_with_a_part_of_a_motion(rig):
    assert "whole motions" in rig.teach(Kind.INITIAL, part=Part(0.0, 0.5)).reason
    assert "whole motions" in rig.teach(Kind.UPDATE, part=Part(0.0, 0.5)).reason
    assert rig.described().version == 0


def test_a_correction_is_stored_whole_with_its_author_its_time_and_how_far_it_is_believed(rig, path):
    began = datetime.now(UTC).timestamp()
    rig.teach(Kind.INITIAL)
    rig.teach(Kind.UPDATE, bend=0.1, operator="anna", alpha=0.5)
    with DemonstrationStore(path) as store:
        first, correction = (stored.demonstration for stored in store.active())
    assert (first.provenance.author, first.provenance.confidence) == ("", 1.0)
    assert (correction.provenance.author, correction.provenance.confidence) == ("anna", 0.5)
    assert began <= first.provenance.at_s <= correction.provenance.at_s <= datetime.now(UTC).timestamp()
    assert np.max(correction.trajectory.positions[:, 2] - first.trajectory.positions[:, 2]) == pytest.approx(0.1, 0.01)


def test_a_restarted_process_believes_what_it_learnt_as_far_as_before(rig, path):
    rig.teach(Kind.INITIAL)
    rig.teach(Kind.UPDATE, bend=0.1, alpha=0.5)
    before = positions(rig.predict())
    rig.service.close()
    again = Rig(path)
    np.testing.assert_allclose(positions(again.predict()), before, atol=1e-9)
    again.service.close()


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


def test_only_an_update_is_taken_back_unless_a_first_demonstration_is_meant(rig):
    rig.teach(Kind.INITIAL)
    assert "no update" in rig.ask(queries.UNDO, Undo()).reason
    undone = rig.ask(queries.UNDO, Undo(kind=Kind.INITIAL))
    assert (undone.state.demonstrations, undone.state.version) == (0, 2)
    assert "teach" in rig.predict().reason
    assert "no first demonstration" in rig.ask(queries.UNDO, Undo(kind=Kind.INITIAL)).reason


@pytest.mark.parametrize("restarted", [False, True])
def test_what_is_asked_twice_is_done_once_and_answered_the_same(path, restarted):
    """The reply was lost, or the process killed before it could give one."""
    rig = Rig(path)
    rig.teach(Kind.INITIAL)
    added = rig.teach(Kind.UPDATE, bend=0.1, request=11)
    undone = rig.ask(queries.UNDO, Undo(request=12))
    later = rig.teach(Kind.UPDATE, bend=0.05)
    again = Rig(path) if restarted else rig
    assert again.teach(Kind.UPDATE, bend=0.1, request=11) == added
    assert again.ask(queries.UNDO, Undo(request=12)) == undone
    assert again.described() == later.state
    again.service.close()


def test_requests_without_a_number_are_each_done(rig):
    rig.teach(Kind.INITIAL)
    assert [rig.teach(Kind.UPDATE).state.updates for _ in range(2)] == [1, 2]


def test_a_demonstration_of_another_scene_is_refused_by_both_names(rig):
    reason = rig.teach(Kind.INITIAL, scene="table").reason
    assert "table" in reason
    assert "dishwasher" in reason
    assert "--scene table" in reason
    assert rig.described().version == 0


def test_the_state_says_what_the_model_is_good_for_before_it_knows_anything(rig):
    assert (rig.described().scene, rig.described().robot_kind) == ("dishwasher", "tiago")


def test_a_database_of_another_scene_is_refused_by_both_names_and_untouched(path):
    first = Rig(path)
    first.teach(Kind.INITIAL)
    first.service.close()
    for scene in ("table", "particle"):
        with pytest.raises(StorageError, match=rf"model\.sqlite.*dishwasher.*{scene}") as caught:
            Rig(path, scene=scene)
        assert "\n" not in str(caught.value)
    again = Rig(path)
    assert again.described().demonstrations == 1
    again.service.close()


def test_nothing_is_predicted_for_a_robot_that_stands_in_another_scene(rig):
    rig.teach(Kind.INITIAL)
    box = (0.0, 0.0, 0.0)
    stands = messages.SceneState(
        name="table",
        variant="clear",
        boxes=(),
        object_size=box,
        ellipsoid_radii=box,
        kicked_over_thresholds=box,
        start=START,
        object_region=(box, box),
    )
    rig.asker.publish(topics.SCENE_STATE, stands)
    assert "scene table" in rig.predict().reason
    rig.asker.publish(topics.SCENE_STATE, msgspec.structs.replace(stands, name="dishwasher"))
    assert isinstance(rig.predict(), Predicted)


@pytest.mark.parametrize(
    ("beyond", "said"),
    [
        ({"at": (850.0, 50.0, 550.0)}, "the motion passes"),
        ({"bend": -2.0}, "the motion passes"),
        ({"condition": (900.0, 0.0, 0.0)}, "condition"),
        ({"condition": (0.1, 0.2)}, "condition"),
        ({"duration": 1e-300}, "from 0.1 to 3600 s"),
    ],
)
def test_a_motion_that_the_robot_cannot_have_made_is_refused_and_nothing_is_learnt(rig, beyond, said):
    assert said in rig.teach(Kind.INITIAL, **beyond).reason
    assert rig.described().version == 0


def test_a_prediction_that_no_robot_can_take_is_refused_and_the_process_goes_on(rig):
    """The logarithm of the duration is carried on in a straight line beyond the demonstrations."""
    rig.teach(Kind.INITIAL, duration=0.1)
    rig.teach(Kind.INITIAL, at=(0.85, 0.1, 0.55), duration=3600.0)
    assert "duration" in rig.predict(at=(0.85, 0.9, 0.55)).reason
    assert isinstance(rig.predict(), Predicted)


def test_nothing_is_predicted_for_a_target_beyond_the_reach(rig):
    rig.teach(Kind.INITIAL)
    assert "(850.000, 50.000, 550.000)" in rig.predict(at=(850.0, 50.0, 550.0)).reason


def test_a_motion_that_is_no_number_is_refused_and_nothing_is_learnt(rig):
    motion = motion_to_wire(np.full((5, 3), np.nan), np.tile(START.orientation, (5, 1)), 10.0)
    reply = rig.ask(queries.ADD_DEMONSTRATION, AddDemonstration(Kind.INITIAL, motion, OBJECT, "dishwasher"))
    assert "finite" in reply.reason
    described = rig.ask(queries.DESCRIBE, queries.Describe())
    assert isinstance(described, Learnt)
    assert described.state.version == 0


def test_a_file_that_is_no_database_is_named_in_one_line(path):
    path.write_bytes(b"this is no database, whatever its name says" * 100)
    with pytest.raises(StorageError, match=r"model\.sqlite") as caught:
        Rig(path)
    assert "\n" not in str(caught.value)


def test_a_database_that_somebody_writes_to_costs_the_change_only_and_the_next_one_succeeds(rig, path, monkeypatch):
    monkeypatch.setattr(connection, "BUSY_TIMEOUT", 0.01)
    rig.service.close()
    rig = Rig(path)
    learnt = rig.teach(Kind.INITIAL)
    holder = sqlite3.connect(path, isolation_level=None)
    holder.execute("BEGIN IMMEDIATE")
    assert "another process holds it" in rig.teach(Kind.UPDATE, bend=0.1, request=7).reason
    for _ in range(3):
        rig.clock.advance(1.0)
        assert isinstance(rig.predict(), Predicted)
    assert rig.described() == learnt.state
    holder.execute("ROLLBACK")
    holder.close()
    assert rig.teach(Kind.UPDATE, bend=0.1, request=8).state.updates == 1
    rig.service.close()
