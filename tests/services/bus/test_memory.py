"""The memory bus obeys the laws of the bus."""

import numpy as np
import pytest

from protocol import queries, topics
from protocol.codec import decode_reply, encode
from protocol.messages import EmergencyStop, MasterState, ModelState, Motion, Pose, Prediction
from services.bus.arrays import to_wire
from services.bus.bus import Failed
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock


@pytest.fixture
def clock():
    return ManualClock()


@pytest.fixture
def network(clock):
    return MemoryNetwork(clock)


def test_the_latest_wins(network, clock):
    sender, receiver = network.bus(), network.bus()
    subscription = receiver.subscribe(topics.MODEL_STATE)
    for version in (1, 2, 3):
        state = ModelState(kind="adaptive", version=version, demonstrations=1, updates=0, scene="s")
        sender.publish(topics.MODEL_STATE, state)
    assert subscription.fresh(clock.now_ns()).version == 3
    assert len(subscription.take()) == 1


def test_what_a_topic_keeps_comes_in_order(network):
    sender, receiver = network.bus(), network.bus()
    subscription = receiver.subscribe(topics.EMERGENCY_STOP)
    for name in ("a", "b", "c"):
        sender.publish(topics.EMERGENCY_STOP, EmergencyStop(pressed=True, by=name))
    assert [r.message.by for r in subscription.take()] == ["a", "b", "c"]
    assert subscription.take() == []


def test_a_sample_ages_on_the_receivers_clock(network, clock):
    sender, receiver = network.bus(), network.bus()
    subscription = receiver.subscribe(topics.MASTER_STATE)
    sender.publish(topics.MASTER_STATE, MasterState())
    clock.advance(0.099)
    assert subscription.fresh(clock.now_ns()) is not None
    clock.advance(0.002)
    assert subscription.fresh(clock.now_ns()) is None
    assert subscription.latest() is not None


@pytest.mark.parametrize(
    ("payload", "schema", "cause"),
    [
        (b"\xc1", "", "malformed"),
        (b"\0" * (topics.MASTER_STATE.max_bytes + 1), "", "oversized"),
        (b"", "MasterState/9", "wrong_version"),
    ],
)
def test_what_is_thrown_away_is_counted_and_named_and_nothing_else_happens(network, clock, payload, schema, cause):
    receiver = network.bus()
    subscription = receiver.subscribe(topics.MASTER_STATE)
    network.deliver(topics.MASTER_STATE, payload, schema)
    assert subscription.latest() is None
    assert getattr(subscription.figures(clock.now_ns()), cause) == 1
    assert "cmd/master_state" in receiver.faults()[0]
    assert receiver.faults() == []


@pytest.mark.parametrize(
    "changed",
    [
        {"robot": "robot2"},
        {"robot": ""},
        {"topic": "cmd/operator_input"},
        {"topic": ""},
        {"process": "station"},
        {"process": "masterly"},
        {"process": "master/*"},
        {"process": ""},
    ],
    ids=str,
)
def test_a_message_that_belongs_elsewhere_is_dropped_counted_and_named(network, clock, changed):
    receiver = network.bus()
    subscription = receiver.subscribe(topics.MASTER_STATE)
    place = {"robot": "robot1", "topic": "cmd/master_state", "process": "master-ann"}
    network.deliver(topics.MASTER_STATE, encode(topics.MASTER_STATE, MasterState(**(place | changed))))
    assert subscription.latest() is None
    assert subscription.figures(clock.now_ns()).misplaced == 1
    assert "misplaced on cmd/master_state" in receiver.faults()[0]
    network.deliver(topics.MASTER_STATE, encode(topics.MASTER_STATE, MasterState(**place, sequence=1)))
    assert subscription.latest() is not None


def test_a_message_under_another_key_than_it_names_is_misplaced(network, clock):
    subscription = network.bus().subscribe(topics.MASTER_STATE)
    place = {"robot": "robot1", "topic": "cmd/master_state", "process": "master-ann"}
    payload = encode(topics.MASTER_STATE, MasterState(**place, sequence=1))
    for robot, source in (("robot2", "master-ann"), ("robot1", "master")):
        subscription.receive(payload, "", clock.now_ns(), topics.MASTER_STATE.key(robot, source))
    assert subscription.latest() is None
    assert subscription.drops.misplaced == 2
    subscription.receive(payload, "", clock.now_ns(), topics.MASTER_STATE.key("robot1", "master-ann"))
    assert subscription.latest() is not None


def test_a_process_publishes_its_own_topics_and_nobody_else_s(network):
    subscription = network.bus().subscribe(topics.MASTER_STATE)
    network.bus("master-ann").publish(topics.MASTER_STATE, MasterState())
    message = subscription.latest().message
    assert (message.robot, message.topic, message.process) == ("robot1", "cmd/master_state", "master-ann")
    station = network.bus("station")
    station.publish(topics.MASTER_STATE, MasterState(engaged=True))
    assert not subscription.latest().message.engaged
    assert "only the master publishes" in station.faults()[0]
    assert station.figures()[0].misplaced == 1


def huge():
    """A prediction that no topic and no query lets pass."""
    motion = Motion(to_wire(np.zeros((9_000, 3))), to_wire(np.zeros((9_000, 4))), 1.0)
    return Prediction(
        motion=motion, deviations=to_wire(np.zeros((99_000, 3))), model_version=1, object_position=(0.0, 0.0, 0.0)
    )


def test_what_cannot_be_sent_is_counted_and_named_and_nothing_else_happens(network):
    bus = network.bus("model")
    state = ModelState(kind="\ud800", version=1, demonstrations=1, updates=0, scene="table")
    bus.publish(topics.MODEL_STATE, state)
    bus.publish(topics.PREDICTION, huge())
    first, second = bus.figures()
    assert (first.topic, first.malformed) == ("model/state", 1)
    assert (second.topic, second.oversized) == ("model/prediction", 1)
    assert [fault[:40] for fault in bus.faults()] == [
        "not sent: malformed message on model/sta",
        "not sent: message on model/prediction ha",
    ]
    assert bus.faults() == []


def test_a_request_that_cannot_be_sent_fails_and_nothing_else_happens(network):
    server = network.bus().serve(queries.RELEASE_STOP)
    failed = network.bus().ask(queries.RELEASE_STOP, queries.ReleaseStop("\ud800")).poll()
    assert isinstance(failed, Failed)
    assert server.take() == []


def test_an_answer_that_does_not_fit_is_a_refusal_that_says_so(network):
    server = network.bus().serve(queries.PREDICT)
    here = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
    pending = network.bus().ask(queries.PREDICT, queries.Predict((0.0, 0.0, 0.0), here))
    for call in server.take():
        call.reply(queries.Predicted(huge()))
    assert "bytes, at most" in pending.poll().reason


def test_a_stop_counts_whatever_its_stamp_and_however_often_it_comes(network, clock):
    subscription = network.bus().subscribe(topics.EMERGENCY_STOP)
    place = {"robot": "robot1", "topic": topics.EMERGENCY_STOP.name, "process": "cli-1"}
    for stamp_ns in (0, 2**62, clock.now_ns(), clock.now_ns()):
        press = EmergencyStop(pressed=True, by="ann", sequence=2**53, stamp_ns=stamp_ns, **place)
        network.deliver(topics.EMERGENCY_STOP, encode(topics.EMERGENCY_STOP, press))
    assert len(subscription.take()) == 4


@pytest.mark.parametrize("announced", ["Undo/1 robot2 model/undo", "Undo/1 robot1 model/describe", "Undo/1 robot1"])
def test_a_request_that_belongs_elsewhere_is_refused_and_counted(network, announced):
    bus, answers = network.bus(), []
    server = bus.serve(queries.UNDO)
    server.receive(b"\x80", announced, answers.append)
    assert server.take() == []
    assert isinstance(decode_reply(queries.UNDO, answers[0]), queries.Refused)
    assert server.drops.misplaced == 1
    server.receive(b"\x80", "Undo/1 robot1 model/undo", answers.append)
    assert len(server.take()) == 1


def test_a_question_is_answered(network):
    server = network.bus().serve(queries.UNDO)
    pending = network.bus().ask(queries.UNDO, queries.Undo())
    assert pending.poll() is None
    for call in server.take():
        call.reply(queries.Refused("nothing to take back"))
    assert pending.poll() == queries.Refused("nothing to take back")


def test_what_is_no_request_is_refused_counted_and_named(network, clock):
    bus = network.bus()
    server, answers = bus.serve(queries.UNDO), []
    for payload, schema in ((b"\xc1", ""), (bytes(queries.UNDO.max_bytes + 1), ""), (b"\x80", "Undo/9")):
        server.receive(payload, schema, answers.append)
    assert server.take() == []
    assert len(answers) == 3
    (figures,) = bus.figures()
    assert (figures.malformed, figures.oversized, figures.wrong_version) == (1, 1, 1)
    assert "model/undo" in bus.faults()[0]
    assert bus.faults() == []


def test_a_question_that_nobody_answers_fails(network):
    assert isinstance(network.bus().ask(queries.UNDO, queries.Undo()).poll(), Failed)


def test_rate_and_latency_are_measured(network, clock):
    sender, receiver = network.bus(), network.bus()
    subscription = receiver.subscribe(topics.MASTER_STATE)
    subscription.figures(clock.now_ns())
    for _ in range(100):
        clock.advance(0.01)
        sender.publish(topics.MASTER_STATE, MasterState())
    figures = subscription.figures(clock.now_ns())
    assert figures.rate_hz == pytest.approx(100.0)
    assert figures.latency == 0.0
