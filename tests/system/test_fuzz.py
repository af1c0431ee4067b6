"""Messages that were changed on their way, at live processes: none ends, none moves or learns, each drop is counted."""

import random
from functools import partial
from itertools import islice

import msgspec
import pytest

from protocol import queries, topics
from protocol.codec import decode, decode_reply, decode_request, encode_request
from protocol.exceptions import ProtocolError
from services.process.processes import PROCESS_NAMES
from tests.protocol.filled import filled
from tests.protocol.mutation import mutated
from tests.system.exposed import TOPICS, drops
from tests.system.harness import eventually

pytestmark = [pytest.mark.system, pytest.mark.zenoh, pytest.mark.sim, pytest.mark.alone]

FEW, MANY = 200, 10_000
"""Of each topic."""

SHARE_ASKED = 20
"""One request for so many messages: whoever asks waits for the answer."""

AT_ONCE_BYTES = 300_000
"""Then it is waited until all has passed: a link that is full for long is closed."""

COUNTED_S = 120.0


def same(topic, sample, payload):
    """Whether it is read as a message that was heard already, or as none: another one's words would count.

    A stop counts whenever it is read.
    """
    try:
        message = decode(topic, payload)
    except ProtocolError:
        return True
    if topic is topics.EMERGENCY_STOP:
        return False
    numbers = [(one.publisher, one.sequence, one.stamp_ns, one.process) for one in (message, sample)]
    return numbers[0] == numbers[1]


def refused(query, payload):
    """Whether it is read as no request: one that is sound might be carried out."""
    try:
        decode_request(query, payload)
    except ProtocolError:
        return True
    return False


def changed(rng, sound, others, counts_for_nothing):
    """Changed messages without end, none of which counts."""
    while True:
        payload = mutated(rng, sound, others)
        if counts_for_nothing(payload):
            yield payload


@pytest.mark.parametrize("count", [FEW, pytest.param(MANY, marks=pytest.mark.long)])
def test_changed_messages_change_nothing_and_are_counted(network, unmoved, count):
    rng = random.Random(20261127)
    others = [sample for sample in network.samples.values() if len(sample) < AT_ONCE_BYTES]
    for topic in set(TOPICS) - {topics.EMERGENCY_STOP}:
        network.send(topic, [network.samples[topic.name]])  # what was heard already counts for nothing from now on
    network.passed()
    before = drops(network.witness.next_beats(PROCESS_NAMES))
    for topic in TOPICS:
        sound = network.samples[topic.name]
        sample = msgspec.msgpack.decode(sound, type=topic.type)
        sent = 0
        nothing = partial(same, topic, sample)
        for payload in islice(changed(rng, sound, others, nothing), count):
            network.send(topic, [payload])
            sent += len(payload)
            if sent > AT_ONCE_BYTES:
                network.passed()
                sent = 0
        network.passed()

    names = {topic.name for topic in TOPICS}

    def missing():
        after = drops(network.witness.next_beats(PROCESS_NAMES))
        fewer = {key: after[key].drops - figures.drops for key, figures in before.items() if key[1] in names}
        return {key: number for key, number in fewer.items() if number < count}

    eventually(lambda: not missing(), COUNTED_S, lambda: f"{count} drops are counted everywhere; fewer: {missing()}")


@pytest.mark.parametrize("count", [FEW // SHARE_ASKED, pytest.param(MANY // SHARE_ASKED, marks=pytest.mark.long)])
def test_changed_requests_are_refused(network, unmoved, count):
    rng = random.Random(20261128)
    sounds = {query: encode_request(query, filled(query.request)) for query in queries.QUERIES}
    for query, sound in sounds.items():
        for payload in islice(changed(rng, sound, list(sounds.values()), partial(refused, query)), count):
            (answer,) = network.stranger.get(query.key("robot1", "anybody"), payload, query.schema)
            reply = decode_reply(query, answer)
            assert isinstance(reply, queries.Refused), (query.name, payload[:80], reply)
    before, after = drops(unmoved), drops(network.witness.next_beats(PROCESS_NAMES))
    asked = [(query.server, query.name) for query in queries.QUERIES]
    assert {key: after[key].drops - before[key].drops for key in asked} == dict.fromkeys(asked, count)
