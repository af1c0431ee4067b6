"""Nothing that arrives on a network stops a process, moves the robot or changes what is known."""

import random
import secrets
from collections import Counter

import msgpack
import msgspec
import numpy as np
import pytest

from protocol import messages, queries, topics
from protocol.codec import decode_reply, encode
from protocol.messages import Array, Phase, Purpose
from services.bus.identity import new_publisher
from services.bus.outbox import Outbox
from services.process.clock import SystemClock
from services.process.config import load
from services.process.processes import PROCESS_NAMES
from tests.system import garbage
from tests.system.harness import START_S, Command, Witness, configured, eventually, free_endpoint
from tests.system.somebody import Somebody
from tests.system.stranger import Stranger

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

ROUNDS = 12
QUIET_BEATS = 4
EPISODE_S = 60.0
MARK = "mark"
STILL_RAD = 1e-3


TOPICS = tuple(topic for topic in topics.TOPICS if topic not in (topics.PROBE, topics.LOAD))
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
    return "/".join(key.split("/")[3:5])


@pytest.fixture(scope="module")
def network(tmp_path_factory):
    folder = tmp_path_factory.mktemp("garbage")
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


@pytest.fixture
def unmoved(network):
    """All processes live on as the same ones, the robot stands, the authority and the model are as they were."""
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


def test_every_topic_drops_and_counts_what_is_no_message(network, unmoved):
    rng = random.Random(1)
    for _ in range(QUIET_BEATS):
        started = network.witness.next_beats({"robot"})["robot"]
    quiet = periods_kept(unmoved["robot"], started)
    sent = Counter()
    for _ in range(ROUNDS):
        for topic in TOPICS:
            sample = network.samples[topic.name]
            for cause, payloads in garbage.by_cause(topic, sample, rng).items():
                network.send(topic, payloads, schema=garbage.ANOTHER_VERSION if cause == "wrong_version" else None)
                sent[topic.name, cause] += len(payloads)
            network.passed()
            foreign = topic.key("robot1", "stranger").replace("@v1", "@v9")
            network.stranger.put(foreign, sample, topic.schema)
    assert sent.total() > 10_000

    before = drops(unmoved)
    assert {topic for _, topic in before} >= {topic.name for topic in TOPICS if topic is not topics.HEARTBEAT}

    def missing():
        after = drops(network.witness.next_beats(PROCESS_NAMES))
        return [
            (process, topic, cause, count, counted)
            for (process, topic), figures in before.items()
            for (sent_on, cause), count in sent.items()
            if sent_on == topic and (counted := getattr(after[process, topic], cause) - getattr(figures, cause)) < count
        ]

    eventually(lambda: not missing(), 20.0, lambda: f"every drop is counted; missing are {missing()}")
    during = periods_kept(started, network.witness.next_beats({"robot"})["robot"])
    assert during > 0.8 * quiet, f"the robot kept {during:.0%} of its control periods, {quiet:.0%} without garbage"


def periods_kept(earlier, later):
    """Share of the control periods between two heartbeats in which the robot stepped."""
    return (later.ticks - earlier.ticks) / (later.rate_hz * (later.stamp_ns - earlier.stamp_ns) / 1e9)


def test_every_query_refuses_what_is_no_request(network, unmoved):
    rng = random.Random(2)
    sent = {}
    for query in queries.QUERIES:
        sample = msgpack.packb(
            {"epoch": "none", "holder": 7, "by": 7, "kind": 7, "prediction": 7, "object_position": 7, "before": "none"}
        )
        wrong = [
            *garbage.no_messages(query.max_bytes),
            *(garbage.fuzz(rng, 4096) for _ in range(garbage.REPEATS)),
            b"\0" * (query.max_bytes + 1),
        ]
        if query.request not in (queries.Undo, queries.Describe):  # which have no field that could be wrong
            wrong.append(sample)
        for payload, schema in [*((payload, query.schema) for payload in wrong), (sample, garbage.ANOTHER_VERSION)]:
            (answer,) = network.stranger.get(query.key("robot1", "anybody"), payload, schema)
            reply = decode_reply(query, answer)
            assert isinstance(reply, queries.Refused), (query.name, payload[:80], reply)
        sent[query.server, query.name] = len(wrong) + 1
    before, after = drops(unmoved), drops(network.witness.next_beats(PROCESS_NAMES))
    counted = {key: after[key].drops - before[key].drops for key in sent}
    assert counted == sent


def test_a_command_without_authority_is_refused(network, unmoved):
    predicted = prediction_of(network.samples)
    for query, request in (
        (queries.EXECUTE, queries.Execute(0, messages.Mode.AUTONOMOUS, predicted.id, 10.0, request=1)),
        (queries.RESET, queries.Reset(0)),
        (queries.FINISH, queries.Finish(0)),
        (queries.RELEASE, queries.ReleaseAuthority("station", 0)),
        (queries.ACQUIRE, queries.AcquireAuthority("stranger")),
        (queries.RELEASE_STOP, queries.ReleaseStop("stranger")),
        (queries.UNDO, queries.Undo()),
        (
            queries.ADD_DEMONSTRATION,
            queries.AddDemonstration(Purpose.UPDATE, garbage.hollow(predicted.motion), (0.7, 0.0, 0.5), "x"),
        ),
    ):
        outcome = network.witness.ask(query, request)
        assert isinstance(outcome, queries.Refused), (query.name, outcome)
        assert outcome.reason


def prediction_of(samples):
    """The prediction that was executed."""
    return msgspec.msgpack.decode(samples[topics.PREDICTION.name], type=messages.Prediction)


def test_sound_messages_with_senseless_content_stop_nobody(network, unmoved):
    decode = {
        topic.name: msgspec.msgpack.decode(network.samples[topic.name], type=topic.type)
        for topic in TOPICS
        if topic.name in network.samples
    }
    replace = msgspec.structs.replace
    world, image = decode[topics.WORLD_STATE.name], decode[topics.HEAD_IMAGE.name]
    prediction, execution = decode[topics.PREDICTION.name], decode[topics.EXECUTION.name]
    scene, robot = decode[topics.SCENE_STATE.name], decode[topics.ROBOT_STATE.name]
    result = decode[topics.EPISODE_RESULT.name]
    motion = prediction.motion
    odd = (
        Array("<f8", (), np.float64(1.0).tobytes()),
        Array("<f8", (0,), b""),
        Array("<f8", (3, 5), bytes(120)),
        Array("|u1", (2, 3), bytes(6)),
        garbage.nonsense(2, 3),
    )
    bytes_of_no_picture = (b"", b"\xff\xd8\xff", b"no picture" * 100, image.data[: len(image.data) // 2])
    senseless = [
        *((topics.WORLD_STATE, replace(world, qpos=array)) for array in odd),
        *((topics.PREDICTION, replace(prediction, deviations=array)) for array in odd),
        *((topics.HEAD_IMAGE, replace(image, data=data)) for data in bytes_of_no_picture),
        *((topics.WRIST_IMAGE, replace(image, data=data, camera="wrist")) for data in bytes_of_no_picture),
        (topics.HEAD_IMAGE, replace(image, intrinsics=(0.0, 0.0, 0.0, 0.0))),
        (topics.HEAD_IMAGE, replace(image, width=2**53, height=0, camera="/../..")),
        (topics.PREDICTION, replace(prediction, motion=garbage.hollow(motion))),
        (topics.EXECUTION, replace(execution, prediction=2**53, progress=-1e9)),
        (
            topics.EPISODE_RESULT,
            replace(result, request=0, prediction=0, commanded=garbage.hollow(motion), reason="x" * 4096),
        ),
        (topics.SCENE_STATE, replace(scene, name="nowhere", variant="none", variants=(), boxes=())),
        (topics.SCENE_STATE, replace(scene, ellipsoid_radii=(0.0, -1.0, 1e9), object_size=(-1.0, 0.0, 1e9))),
        (topics.ROBOT_STATE, replace(robot, joint_names=("a",), q=(), qd=(1e9,), hold_reason="\0\x1b[2J\n")),
        (topics.ROBOT_STATE, replace(robot, joint_names=(), q=(1e9,) * 64, clamped=("",) * 16)),
        (topics.OBJECT_POSE, replace(decode[topics.OBJECT_POSE.name], tag=2**53, error=-1e9)),
        (topics.MASTER_STATE, replace(decode[topics.MASTER_STATE.name], displacement=(1e9, 1e9, 1e9), engaged=True)),
        (topics.MASTER_STATE, replace(decode[topics.MASTER_STATE.name], rotation=(1e9, -1e9, 1e9), engaged=True)),
        (
            topics.OPERATOR_INPUT,
            messages.OperatorInput(
                keys=("\0",) * 32, focused=True, controllers=(messages.Controller("x" * 64, axes=(1e3,) * 16),) * 4
            ),
        ),
        (topics.AUTHORITY_RENEWAL, messages.AuthorityRenewal(holder="stranger", epoch=2**53)),
        (topics.EMERGENCY_STOP, messages.EmergencyStop(pressed=False, by="")),
        (
            topics.RECORDING,
            messages.Recording(path="\0", viewer_url="javascript:alert(1)", recording_id=""),
        ),
        (topics.HEARTBEAT, replace(unmoved["robot"], process="\x1b[31m", pid=0, host="[/]", rate_hz=-1e9)),
    ]
    for _ in range(3):
        for topic, message in senseless:
            network.publish(topic, message)
        network.witness.next_beats(PROCESS_NAMES)
