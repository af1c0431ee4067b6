"""The model process predicts, and says how much of it is known; what it cannot predict it refuses."""

from dataclasses import replace

import msgspec
import numpy as np

from lfd.models.adaptive.adaptation import AdaptiveProMP
from lfd.models.model import Way
from protocol import messages, topics
from protocol.messages import Purpose
from protocol.queries import Predicted
from tests.services.model.rig import OBJECT, START, positions


def test_without_a_demonstration_there_is_no_prediction(rig):
    assert "teach" in rig.predict().reason


def test_a_prediction_leads_from_the_start_to_the_object(rig):
    rig.teach(Purpose.INITIAL)
    predicted = rig.predict()
    assert isinstance(predicted, Predicted)
    np.testing.assert_allclose(positions(predicted)[[0, -1]], [START.position, OBJECT], atol=1e-3)


def test_a_prediction_is_announced_with_the_version_that_made_it(rig):
    subscription = rig.network.bus().subscribe(topics.PREDICTION)
    version = rig.teach(Purpose.INITIAL).state.version
    predicted = rig.predict().prediction
    announced = subscription.latest().message
    assert (announced.id, announced.motion) == (predicted.id, predicted.motion)
    assert announced.model_version == version


def test_every_prediction_has_an_id_of_its_own(rig):
    rig.teach(Purpose.INITIAL)
    identities = {rig.predict().prediction.id for _ in range(5)}
    assert len(identities) == 5
    assert 0 not in identities


def test_the_newest_prediction_is_repeated_for_whoever_did_not_hear_it(rig):
    rig.teach(Purpose.INITIAL)
    rig.predict()
    newest = rig.predict().prediction
    late = rig.network.bus().subscribe(topics.PREDICTION)
    for _ in range(300):
        rig.clock.advance(0.01)
        rig.service.step(rig.clock.now_ns())
    assert [received.message.id for received in late.take()] == [newest.id] * 3


def test_a_prediction_says_how_much_of_it_is_known(rig):
    for y in (0.05, 0.1):
        rig.teach(Purpose.INITIAL, at=(0.85, y, 0.55))
    shares = [rig.predict((0.85, y, 0.55)).prediction.known for y in (0.05, 0.15, 0.3, 0.5)]
    assert shares[0] == 1.0
    assert shares == sorted(shares, reverse=True)
    assert shares[-1] < 0.1


def test_a_prediction_says_which_of_several_ways_it_takes(rig, monkeypatch):
    rig.teach(Purpose.INITIAL)
    predict = AdaptiveProMP.predict
    monkeypatch.setattr(
        AdaptiveProMP, "predict", lambda *asked: replace(predict(*asked), known=0.6, way=Way(1, 2, 0.8))
    )
    prediction = rig.predict().prediction
    assert prediction.way == messages.Way(1, 2, 0.8)
    assert prediction.known == 0.6


def test_nothing_is_predicted_for_a_robot_that_stands_in_another_scene(rig):
    rig.teach(Purpose.INITIAL)
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


def test_a_prediction_that_no_robot_can_take_is_refused_and_the_process_goes_on(rig):
    """The logarithm of the duration is carried on in a straight line beyond the demonstrations."""
    rig.teach(Purpose.INITIAL, duration=0.1)
    rig.teach(Purpose.INITIAL, at=(0.85, 0.1, 0.55), duration=3600.0)
    assert "duration" in rig.predict(at=(0.85, 0.9, 0.55)).reason
    assert isinstance(rig.predict(), Predicted)


def test_nothing_is_predicted_for_a_target_beyond_the_reach(rig):
    rig.teach(Purpose.INITIAL)
    assert "(850.000, 50.000, 550.000)" in rig.predict(at=(850.0, 50.0, 550.0)).reason
