"""Whatever becomes of a message on its way, the codec reads it or refuses it, and nothing else happens."""

import random
from collections import Counter

import pytest

from protocol import queries, topics
from protocol.codec import decode, decode_reply, decode_request, encode, encode_reply, encode_request
from protocol.exceptions import ProtocolError
from protocol.queries import Refused
from tests.protocol.filled import filled
from tests.protocol.mutation import mutated

SHORT, LONG = 30_000, 1_000_000


def readers():
    """What reads each kind of message, its sound bytes, and what comes of them."""
    for topic in topics.TOPICS:
        sound = encode(topic, filled(topic.type))
        yield topic.name, lambda payload, topic=topic: decode(topic, payload), sound, topic.type
    for query in queries.QUERIES:
        request = encode_request(query, filled(query.request))
        yield query.name, lambda payload, query=query: decode_request(query, payload), request, query.request
        reply = encode_reply(query, filled(query.reply))
        yield f"{query.name}, reply", lambda payload, query=query: decode_reply(query, payload), reply, object


@pytest.mark.parametrize("count", [SHORT, pytest.param(LONG, marks=pytest.mark.long)])
def test_a_message_that_was_changed_is_read_or_refused(count, capsys):
    rng = random.Random(20261127)
    kinds = list(readers())
    sounds = [sound for _, _, sound, _ in kinds]
    outcomes = Counter()
    for number in range(count):
        name, read, sound, type_ = kinds[number % len(kinds)]
        payload = mutated(rng, sound, sounds)
        try:
            message = read(payload)
        except ProtocolError as error:
            outcomes[name, type(error).__name__] += 1
        else:
            assert isinstance(message, type_ | Refused if type_ is not object else object)
            outcomes[name, "read"] += 1
    with capsys.disabled():
        told = Counter({outcome: 0 for _, outcome in outcomes})
        for (_, outcome), times in outcomes.items():
            told[outcome] += times
        print(f"\n{count} messages of {len(kinds)} kinds: {dict(told)}")  # noqa: T201 (coverage, for whoever runs it)
    assert told["read"] > count / 100, "the changes are too coarse"
    assert told["MalformedMessage"] > count / 2, "the changes are too small"
    assert {name for name, _ in outcomes} == {name for name, *_ in kinds}
