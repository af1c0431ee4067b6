"""Nothing that arrives on a network stops a process, moves the robot or changes what is known."""

import random
from collections import Counter

import msgpack
import msgspec
import numpy as np
import pytest

from protocol import messages, queries, topics
from protocol.codec import decode_reply
from protocol.messages import Array, Purpose
from services.process.processes import PROCESS_NAMES
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE
from tests.system import garbage
from tests.system.exposed import TOPICS, drops
from tests.system.harness import eventually

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

ROUNDS = 12
QUIET_BEATS = 4


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

    # Who missed the last of what is said no more finds it late instead of repeated: both are counted together.
    for topic in TOPICS:
        sent[topic.name, "repeated"] += sent[topic.name, "stale"]

    def counted(figures, cause):
        return getattr(figures, cause) + figures.stale * (cause == "repeated")

    def missing():
        after = drops(network.witness.next_beats(PROCESS_NAMES))
        return [
            (process, topic, cause, count, more)
            for (process, topic), figures in before.items()
            for (sent_on, cause), count in sent.items()
            if sent_on == topic and (more := counted(after[process, topic], cause) - counted(figures, cause)) < count
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
        # No field of these could be wrong.
        if query.request not in (queries.Undo, queries.Describe, queries.ListSkills):
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
    world, image = decode[topics.WORLD_STATE.name], decode[HEAD_IMAGE.name]
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
        *((HEAD_IMAGE, replace(image, data=data)) for data in bytes_of_no_picture),
        *((WRIST_IMAGE, replace(image, data=data, camera="wrist")) for data in bytes_of_no_picture),
        (HEAD_IMAGE, replace(image, intrinsics=(0.0, 0.0, 0.0, 0.0))),
        (HEAD_IMAGE, replace(image, width=2**53, height=0, camera="/../..")),
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
