"""The newest predictions are known by their ids."""

from protocol import topics
from services.bus.arrays import motion_to_wire
from services.bus.memory import MemoryNetwork
from services.bus.predictions import KEPT, Predictions
from services.process.clock import ManualClock
from tests.services.predictions import announce, prediction


def motion(x):
    return motion_to_wire([[0.0, 0.0, 0.0], [x, 0.0, 0.0]], [[1.0, 0.0, 0.0, 0.0]] * 2, 1.0)


def heard():
    network = MemoryNetwork(ManualClock())
    model, robot = network.bus(), network.bus()
    return model, Predictions(robot)


def test_a_motion_is_known_by_the_id_that_it_was_announced_under():
    model, predictions = heard()
    first, second = announce(model, motion(1.0)), announce(model, motion(2.0))
    assert predictions.motion(first) == motion(1.0)
    assert predictions.motion(second) == motion(2.0)
    assert predictions.motion(first + second + 1) is None


def test_a_repeated_prediction_is_the_same_one_and_no_other_motion_takes_its_id():
    model, predictions = heard()
    identity = announce(model, motion(1.0))
    announce(model, motion(2.0), identity)
    assert predictions.motion(identity) == motion(1.0)
    announce(model, motion(3.0), identity)
    assert predictions.motion(identity) == motion(1.0)


def test_the_newest_ones_stay_known_and_no_more():
    model, predictions = heard()
    identities = [announce(model, motion(float(i + 1))) for i in range(2 * KEPT)]
    assert predictions.motion(identities[-KEPT - 1]) is None
    assert predictions.motion(identities[-KEPT]) == motion(float(KEPT + 1))
    assert predictions.motion(identities[-1]) == motion(2.0 * KEPT)


def test_the_newest_one_is_known_before_anybody_asks_for_it():
    model, predictions = heard()
    assert predictions.newest() is None
    announce(model, motion(1.0))
    last = announce(model, motion(2.0))
    assert predictions.newest().id == last
    assert predictions.find(last) == predictions.newest()


def test_what_has_no_id_is_no_prediction_that_can_be_named():
    model, predictions = heard()
    model.publish(topics.PREDICTION, prediction(motion(1.0), identity=0))
    assert predictions.motion(0) is None
