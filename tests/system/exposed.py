"""A whole system that waits for its operator, and a stranger on its network who knows what passes there."""

import secrets
from contextlib import contextmanager

import msgpack
import msgspec
import numpy as np

from protocol import messages, topics
from protocol.codec import encode
from protocol.messages import Phase
from services.bus.identity import new_publisher
from services.bus.outbox import Outbox
from services.process.clock import SystemClock
from services.process.config import load
from services.process.processes import PROCESS_NAMES
from tests import cameras
from tests.system.harness import START_S, Command, Witness, configured, eventually, free_endpoint
from tests.system.somebody import Somebody
from tests.system.stranger import Stranger

EPISODE_S = 60.0
MARK = "mark"
STILL_RAD = 1e-3

TOPICS = tuple(topic for topic in cameras.TOPICS if topic not in (topics.PROBE, topics.LOAD))
"""But for those that only who sends them hears: no process of these does."""

SOURCE_OF_ANY = "robot"
"""Under whose name a stranger sends what any process may publish."""


class Network:
    """A whole system that waits for its operator, a stranger on its network, and what passed on each topic."""

    def __init__(self, up, witness, stranger, samples, marks):
        self.up = up
        self.witness = witness
        self.stranger = stranger
        self.samples = samples
        self._marks = marks

    def send(self, topic, payloads, schema=None):
        """Under the key of a process that publishes the topic, as a stranger can."""
        source = topic.publisher if topic.publisher != "any" else SOURCE_OF_ANY
        for payload in payloads:
            self.stranger.put(topic.key("robot1", source), payload, topic.schema if schema is None else schema)

    def passed(self):
        """Wait until what was sent has gone through the router: a link that is full for long is closed."""
        mark = secrets.token_bytes(8)
        self.stranger.put(MARK, mark)
        eventually(lambda: self._marks and self._marks[-1].payload == mark, START_S, "what was sent has passed")

    def publish(self, topic, message):
        """A sound message, of a sender that nobody knows."""
        process = topic.publisher if topic.publisher != "any" else SOURCE_OF_ANY
        stamped = Outbox(new_publisher(), "robot1", process).stamp(topic, message, SystemClock().now_ns())
        self.send(topic, [encode(topic, stamped)])


def decides(witness, attempts):
    teaching = witness.teaching
    return teaching is not None and teaching.phase == "deciding" and len(teaching.attempts) == attempts


def subject(key):
    """The topic's name in a key expression."""
    return "/".join(key.split("/")[3:-1])


@contextmanager
def exposed(folder):
    """The system, after one prediction was executed, and what passed on each of its topics."""
    endpoint = free_endpoint()
    configuration = configured(folder, endpoint, station="autonomous_s = 5.0")
    station = load(configuration).station
    with (
        Command("up", "--fresh", "--no-browser", "--config", configuration, folder=folder) as up,
        Witness(endpoint) as witness,
        Stranger(endpoint) as stranger,
        Stranger(endpoint) as hearer,
        Somebody(station.host, station.port) as somebody,
    ):
        newest = {}
        stranger.watch("retouch/@v1/robot1/**", lambda passing: newest.update({subject(passing.key): passing.payload}))
        up.until(lambda: decides(witness, attempts=0), START_S, "the operator is asked")
        somebody.press("execute")
        up.until(lambda: decides(witness, attempts=1), EPISODE_S, "a prediction is executed, and the operator is asked")
        # Nobody presses a stop or asks for the robot, and on one machine no picture queues.
        unsaid = {topics.EMERGENCY_STOP.name, topics.AUTHORITY_REQUEST.name, topics.PICTURE_QUEUE.name}
        passed = {topic.name for topic in TOPICS} - unsaid
        up.until(lambda: passed <= set(newest), START_S, "something has passed on every topic")
        samples = dict(newest)
        press = messages.EmergencyStop(
            robot="robot1", topic=topics.EMERGENCY_STOP.name, pressed=True, by="stranger", sequence=1
        )
        samples[topics.EMERGENCY_STOP.name] = encode(topics.EMERGENCY_STOP, press)
        request = messages.AuthorityRequest(holder="station-b", number=1)
        asking = Outbox(new_publisher(), "robot1", "station")
        asked = asking.stamp(topics.AUTHORITY_REQUEST, request, SystemClock().now_ns())
        samples[topics.AUTHORITY_REQUEST.name] = encode(topics.AUTHORITY_REQUEST, asked)
        looking = Outbox(new_publisher(), "robot1", SOURCE_OF_ANY)
        queue = looking.stamp(topics.PICTURE_QUEUE, messages.PictureQueue(), SystemClock().now_ns())
        samples[topics.PICTURE_QUEUE.name] = encode(topics.PICTURE_QUEUE, queue)
        for topic in TOPICS:
            if topic.publisher == "any":
                fields = msgpack.unpackb(samples[topic.name]) | {"process": SOURCE_OF_ANY}
                samples[topic.name] = msgpack.packb(fields)
        marks = hearer.listen(MARK)
        stranger.listened(MARK)
        network = Network(up, witness, stranger, samples, marks)
        # A process that came up after the only prediction was made has not heard it yet.
        network.send(topics.PREDICTION, [samples[topics.PREDICTION.name]])
        # Nobody repeats these, so that nobody is asked for long, and no camera waits for anybody.
        for said in (topics.AUTHORITY_REQUEST, topics.PICTURE_QUEUE):
            network.send(said, [samples[said.name]])
        yield network


@contextmanager
def nothing_changes(network):
    """All processes live on as the same ones, the robot stands, the authority and the model are as they were.

    Gives the heartbeats from before.
    """
    witness = network.witness
    before = witness.next_beats(PROCESS_NAMES)
    authority, model, robot = map(witness.next, (topics.AUTHORITY_STATE, topics.MODEL_STATE, topics.ROBOT_STATE))
    yield before
    after = witness.next_beats(PROCESS_NAMES)
    assert {name: beat.pid for name, beat in after.items()} == {name: beat.pid for name, beat in before.items()}
    told = lambda state: msgspec.structs.replace(state, publisher=0, sequence=0, stamp_ns=0)  # noqa: E731
    assert told(witness.next(topics.MODEL_STATE)) == told(model)
    holder = witness.next(topics.AUTHORITY_STATE)
    assert (holder.holder, holder.epoch) == (authority.holder, authority.epoch)
    standing = witness.next(topics.ROBOT_STATE)
    assert standing.phase is Phase.IDLE
    assert standing.episode == robot.episode
    assert np.abs(np.subtract(standing.q, robot.q)).max() < STILL_RAD
    assert not witness.next(topics.SAFETY_STATE).emergency_stop
    assert "Traceback" not in network.up.out + network.up.err


def drops(beats):
    """(process, topic) to what was dropped so far."""
    return {(name, figures.topic): figures for name, beat in beats.items() for figures in beat.topics}
