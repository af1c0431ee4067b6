"""The bus over real Zenoh obeys the laws of the bus, and people can look at it and stop it."""

import os
import re
import signal

import msgpack
import numpy as np
import pytest

from protocol import queries, topics
from protocol.codec import decode_reply, encode
from protocol.messages import AuthorityRenewal, EmergencyStop, MasterState, ModelState, Purpose, SafetyState
from services.bus.arrays import motion_to_wire
from services.bus.bus import Failed
from services.bus.zenoh import connect
from services.process.clock import SystemClock
from services.process.exceptions import BusError, NameTaken
from tests.system.harness import Command, Witness, eventually, free_endpoint
from tests.system.stranger import Stranger

pytestmark = [pytest.mark.system, pytest.mark.zenoh]

WITHIN_S = 10.0
MOMENT_S = 2.0


@pytest.fixture
def stranger(router):
    """A program that is none of ours."""
    with Stranger(router) as one:
        yield one


def answering(server, reply):
    """A condition that answers what has come; true once something has."""

    def answered():
        calls = server.take()
        for call in calls:
            call.reply(reply)
        return calls

    return answered


def heard(sender, topic, message, subscription):
    """Publish until the subscription has heard it: the network takes a moment to know who listens."""

    def there():
        sender.publish(topic, message)
        return subscription.latest()

    return eventually(there, WITHIN_S, f"{topic.name} is heard").message


def test_the_latest_wins(bus):
    sender, subscription = bus("model"), bus("b").subscribe(topics.MODEL_STATE)
    states = [
        ModelState(kind="adaptive", version=version, demonstrations=1, updates=0, scene="s") for version in range(4)
    ]
    heard(sender, topics.MODEL_STATE, states[0], subscription)

    def told():
        for state in states[1:]:
            sender.publish(topics.MODEL_STATE, state)
        return comes(subscription, lambda state: state.version == 3)

    eventually(told, WITHIN_S, "the last one comes")
    assert len(subscription.take()) == 1


def comes(subscription, is_it):
    """Whether it comes within a moment; what is sent once may be lost, where a link is busy or has just been cut."""
    try:
        return eventually(lambda: is_it(subscription.latest().message), MOMENT_S, "it comes")
    except AssertionError:
        return False


def test_what_a_topic_keeps_comes_whole_and_in_order(bus):
    sender, subscription = bus("station"), bus("b").subscribe(topics.AUTHORITY_RENEWAL)
    heard(sender, topics.AUTHORITY_RENEWAL, AuthorityRenewal(holder="a", epoch=0), subscription)
    sent = list(range(1, topics.AUTHORITY_RENEWAL.kept + 1))

    def kept():
        subscription.take()
        for epoch in sent:
            sender.publish(topics.AUTHORITY_RENEWAL, AuthorityRenewal(holder="a", epoch=epoch))
            # One at a time: of a burst the transport drops what it has no room for, rather than let the sender wait.
            if not comes(subscription, lambda renewal, epoch=epoch: renewal.epoch == epoch):
                return []
        return [received.message.epoch for received in subscription.take()]

    assert eventually(kept, 3 * WITHIN_S, "none of them is lost on the way") == sent


def test_a_message_says_who_sent_it_and_when(bus):
    sender, receiver = bus("master-ann"), bus("b")
    before = SystemClock().now_ns()
    message = heard(sender, topics.MASTER_STATE, MasterState(), receiver.subscribe(topics.MASTER_STATE))
    assert message.publisher == sender.identity != receiver.identity
    assert (message.robot, message.topic, message.process) == ("robot1", "cmd/master_state", "master-ann")
    assert before <= message.stamp_ns <= SystemClock().now_ns()
    (figures,) = receiver.figures()
    assert 0.0 <= figures.latency < 1.0


@pytest.mark.parametrize(
    ("payload", "schema", "cause"),
    [
        (b"\xc1", "", "malformed"),
        (b"\0" * (topics.MASTER_STATE.max_bytes + 1), "", "oversized"),
        (b"\x80", "MasterState/9", "wrong_version"),
    ],
)
def test_what_is_thrown_away_is_counted_and_named_and_nothing_else_happens(bus, stranger, payload, schema, cause):
    receiver = bus("b")
    subscription = receiver.subscribe(topics.MASTER_STATE)
    key = topics.MASTER_STATE.key("robot1", "a")
    stranger.listened(key)
    stranger.put(key, payload, schema)
    eventually(lambda: getattr(subscription.drops, cause) == 1, WITHIN_S, "it is counted")
    assert subscription.latest() is None
    assert "cmd/master_state" in receiver.faults()[0]


@pytest.mark.parametrize(
    ("robot", "source", "process"),
    [("robot2", "master", "master"), ("robot1", "master", "master-ann"), ("robot1", "station", "station")],
    ids=["another robot's", "another process' key", "not its publisher's"],
)
def test_a_sample_under_a_key_that_is_not_its_own_is_dropped_and_counted(bus, stranger, robot, source, process):
    subscription = bus("robot").subscribe(topics.MASTER_STATE)
    message = MasterState(robot=robot, topic=topics.MASTER_STATE.name, process=process, sequence=1)
    key = topics.MASTER_STATE.key("robot1", source)
    stranger.listened(key)
    stranger.put(key, encode(topics.MASTER_STATE, message))
    eventually(lambda: subscription.drops.misplaced == 1, WITHIN_S, "it is counted")
    assert subscription.latest() is None


def test_a_request_of_another_robot_is_refused(bus, stranger):
    server = bus("model").serve(queries.UNDO)
    stranger.answered(queries.UNDO.key("robot1", "anybody"))
    (answer,) = stranger.get(queries.UNDO.key("robot1", "anybody"), b"\x80", "Undo/1 robot2 model/undo")
    assert "robot 'robot2'" in decode_reply(queries.UNDO, answer).reason
    assert server.take() == []


def test_a_change_that_is_asked_twice_is_made_once(bus, stranger):
    server, asker = bus("model").serve(queries.UNDO), bus("station")
    stranger.answered(queries.UNDO.key("robot1", "anybody"))
    request = queries.Undo(request=12345)
    for _ in range(2):
        lost = asker.ask(queries.UNDO, request, timeout_s=0.2)
        assert isinstance(eventually(lost.poll, WITHIN_S, "it is not answered"), Failed)
    (call,) = server.take()
    call.reply(queries.Refused("nothing to take back"))
    again = asker.ask(queries.UNDO, request)
    assert eventually(again.poll, WITHIN_S, "the kept answer") == queries.Refused("nothing to take back")
    assert server.take() == []


def test_a_question_is_answered_and_a_refusal_is_an_answer(bus, stranger):
    server, asker = bus("model").serve(queries.UNDO), bus("station")
    stranger.answered(queries.UNDO.key("robot1", "anybody"))
    for reply in (
        queries.Refused("nothing to take back"),
        queries.Learnt(ModelState(kind="adaptive", version=3, demonstrations=2, updates=1, scene="table")),
    ):
        pending = asker.ask(queries.UNDO, queries.Undo())
        eventually(answering(server, reply), WITHIN_S, "the question comes")
        assert eventually(pending.poll, WITHIN_S, "the answer comes") == reply


def test_a_question_that_nobody_answers_fails_at_once_and_says_whom_it_misses(bus):
    pending = bus("station").ask(queries.UNDO, queries.Undo(), timeout_s=WITHIN_S)
    outcome = eventually(pending.poll, WITHIN_S / 2, "the failure")
    assert isinstance(outcome, Failed)
    assert "model" in outcome.reason


def test_a_question_whose_server_is_silent_fails_in_time(bus, stranger):
    server = bus("model").serve(queries.UNDO)
    stranger.answered(queries.UNDO.key("robot1", "anybody"))
    pending = bus("station").ask(queries.UNDO, queries.Undo(), timeout_s=0.5)
    outcome = eventually(pending.poll, WITHIN_S, "the failure")
    assert isinstance(outcome, Failed)
    assert server.take(), "the question had come"


def test_a_name_is_taken_until_its_holder_leaves(bus, router):
    holder = bus("robot")
    with pytest.raises(NameTaken, match="robot1"):
        connect(router, "robot1", "robot", SystemClock())
    bus("robot", robot="robot2")
    holder.close()
    bus("robot")


def test_a_router_that_is_not_there_is_an_error_in_time():
    endpoint = free_endpoint()
    with pytest.raises(BusError, match=re.escape(endpoint)):
        connect(endpoint, "robot1", "robot", SystemClock(), timeout_s=0.5)


def demonstration():
    positions = np.linspace((0.5, 0.0, 0.4), (0.85, 0.05, 0.55), 75)
    motion = motion_to_wire(positions, np.tile((1.0, 0.0, 0.0, 0.0), (75, 1)), 10.0)
    return queries.AddDemonstration(Purpose.INITIAL, motion, (0.85, 0.05, 0.55), "dishwasher")


def test_two_robots_under_one_router_do_not_hear_each_other(tmp_path, router):
    with (
        Command("model", "--connect", router, "--robot", "left", folder=tmp_path),
        Command("model", "--connect", router, "--robot", "right", folder=tmp_path),
        Witness(router, "left") as left,
        Witness(router, "right") as right,
        Witness(router, "none") as none,
    ):
        beats = [witness.next_beats({"model"}, 30.0)["model"] for witness in (left, right)]
        assert beats[0].pid != beats[1].pid
        left.asked(queries.ADD_DEMONSTRATION, demonstration())
        assert left.asked(queries.DESCRIBE, queries.Describe()).state.version == 1
        assert right.asked(queries.DESCRIBE, queries.Describe()).state.version == 0
        left.next(topics.MODEL_STATE, lambda state: state.version == 1)
        assert right.next_beats({"model"})["model"].pid == beats[1].pid
        assert right.next(topics.MODEL_STATE).version == 0
        assert isinstance(none.ask(queries.DESCRIBE, queries.Describe()), Failed)
        assert none.beats() == {}


def test_the_other_robots_of_a_network_are_heard_and_stopped_each_by_itself(bus):
    station, garage, kitchen = bus("station-ann"), bus("robot", robot="garage"), bus("robot")
    stops = garage.subscribe(topics.EMERGENCY_STOP)
    stops_here = kitchen.subscribe(topics.EMERGENCY_STOP)

    def seen():
        for robot in (garage, kitchen):
            robot.tell_commander("")
            robot.publish(topics.SAFETY_STATE, SafetyState(emergency_stop=False))
        return station.neighbours()

    assert eventually(seen, WITHIN_S, "the garage is there") == {"garage": ""}
    other = station.neighbour("garage")
    safety = other.subscribe(topics.SAFETY_STATE)
    message = heard(other, topics.EMERGENCY_STOP, EmergencyStop(pressed=True, by="ann"), stops)
    assert (message.robot, message.process, message.by) == ("garage", "station-ann", "ann")
    eventually(lambda: seen() and safety.latest(), WITHIN_S, "the garage is heard by its own name")
    assert safety.latest().message.robot == "garage"
    assert stops_here.take() == []


def test_everybody_finds_a_router_that_was_killed_again(tmp_path):
    endpoint = free_endpoint()
    with (
        Command("router", "--listen", endpoint, folder=tmp_path) as first,
        Command("model", "--connect", endpoint, folder=tmp_path) as model,
        Command("master", "--connect", endpoint, folder=tmp_path) as master,
        Witness(endpoint) as witness,
    ):
        before = witness.next_beats({"model", "master"}, 30.0)
        os.kill(first.process.pid, signal.SIGKILL)
        first.ended(WITHIN_S)
        assert isinstance(witness.ask(queries.DESCRIBE, queries.Describe(), 1.0), Failed)
        with Command("router", "--listen", endpoint, folder=tmp_path):
            after = witness.next_beats({"model", "master"}, 15.0)
            assert {name: beat.pid for name, beat in after.items()} == {name: beat.pid for name, beat in before.items()}
            assert witness.asked(queries.DESCRIBE, queries.Describe()).state.version == 0
            for command in (model, master):
                assert command.process.poll() is None
            with pytest.raises(NameTaken):
                connect(endpoint, "robot1", "model", SystemClock())


def test_a_newer_version_of_a_message_with_one_field_more_is_read(bus, stranger):
    subscription = bus("b").subscribe(topics.MASTER_STATE)
    place = {"robot": "robot1", "topic": topics.MASTER_STATE.name, "process": "master"}
    fields = {"publisher": 1, "sequence": 1, "stamp_ns": 1, "engaged": True, "colour": "a field of the next version"}
    key = topics.MASTER_STATE.key("robot1", "master")
    stranger.listened(key)
    stranger.put(key, msgpack.packb(place | fields), topics.MASTER_STATE.schema)
    eventually(subscription.latest, WITHIN_S, "it is read")
    assert subscription.latest().message.engaged
