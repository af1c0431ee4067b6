"""Nothing malformed passes the codec, and any language can read what does."""

import contextlib
import subprocess
import sys

import msgpack
import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol import messages, queries, topics
from protocol.codec import decode, decode_reply, decode_request, encode, encode_reply, encode_request
from protocol.exceptions import MalformedMessage, OversizedMessage, ProtocolError, WrongVersion
from tests.protocol.filled import filled

by_topic = pytest.mark.parametrize("topic", topics.TOPICS, ids=lambda t: t.name)
by_query = pytest.mark.parametrize("query", queries.QUERIES, ids=lambda q: q.name)


@by_topic
def test_a_message_survives_the_wire(topic, fill):
    message = fill(topic.type)
    assert decode(topic, encode(topic, message), topic.schema) == message


@by_topic
def test_plain_msgpack_reads_every_message_as_a_map_of_its_fields(topic, fill):
    plain = msgpack.unpackb(encode(topic, fill(topic.type)))
    assert set(plain) == set(topic.type.__struct_fields__)


@by_topic
def test_plain_msgpack_writes_every_message(topic, fill):
    message = fill(topic.type)
    foreign = msgpack.packb(msgspec.to_builtins(message, builtin_types=(bytes,)))
    assert decode(topic, foreign) == message


@by_topic
def test_a_newer_sender_with_one_more_field_is_understood(topic, fill):
    plain = msgpack.unpackb(encode(topic, fill(topic.type)))
    assert decode(topic, msgpack.packb({**plain, "added_later": 1})) == fill(topic.type)


@by_query
def test_a_request_and_its_reply_survive_the_wire(query, fill):
    request, reply = fill(query.request), fill(query.reply)
    assert decode_request(query, encode_request(query, request), query.schema) == request
    assert decode_reply(query, encode_reply(query, reply)) == reply


@by_query
def test_a_refusal_is_told_from_a_reply(query):
    refused = queries.Refused("because")
    assert decode_reply(query, encode_reply(query, refused)) == refused


def test_no_decoder_is_made_while_messages_come_in():
    """One thread that makes a decoder while another decodes the same struct for the first time ends the process."""
    script = """
import msgspec
from protocol import codec, exceptions, queries, topics

msgspec.msgpack.Decoder = None
read = [(codec.decode, topic) for topic in topics.TOPICS]
read += [(do, query) for query in queries.QUERIES for do in (codec.decode_request, codec.decode_reply)]
for do, subject in read:
    try:
        do(subject, b"\\xc0")
    except exceptions.MalformedMessage:
        pass
"""
    told = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=False)
    assert told.returncode == 0, told.stderr


@by_topic
def test_another_version_is_refused_before_it_is_decoded(topic):
    with pytest.raises(WrongVersion):
        decode(topic, b"whatever", f"{topic.type.__name__}/2")


@by_topic
def test_an_oversized_message_is_refused_before_it_is_decoded(topic):
    with pytest.raises(OversizedMessage) as caught:
        decode(topic, b"\0" * (topic.max_bytes + 1))
    assert caught.value.bound == topic.max_bytes


@given(garbage=st.binary(max_size=200))
def test_garbage_is_malformed_and_nothing_else(garbage):
    for topic in topics.TOPICS:
        with pytest.raises(MalformedMessage):
            decode(topic, b"\xc1" + garbage)


@by_topic
@given(at=st.integers(min_value=0, max_value=10**6), flip=st.integers(min_value=0, max_value=255))
def test_a_damaged_message_decodes_or_is_a_protocol_error(topic, at, flip):
    whole = bytearray(encode(topic, filled(topic.type)))
    whole[at % len(whole)] ^= flip
    for payload in (bytes(whole), bytes(whole[: at % len(whole)])):
        with contextlib.suppress(ProtocolError):
            assert isinstance(decode(topic, payload), topic.type)


@by_topic
def test_a_name_that_is_no_text_is_malformed(topic, fill):
    whole = encode(topic, fill(topic.type))
    field = whole.index(b"\xa5robot") + 6
    with pytest.raises(MalformedMessage):
        decode(topic, whole[:field] + b"\xa1\xff" + whole[field + 1 + (whole[field] & 31) :])


def test_a_master_without_rotation_is_one_that_does_not_turn():
    earlier = msgpack.packb({"displacement": [0.1, 0.0, 0.0], "engaged": True, "device": "stylus"})
    expected = messages.MasterState(displacement=(0.1, 0.0, 0.0), engaged=True, device="stylus")
    assert decode(topics.MASTER_STATE, earlier) == expected
    assert expected.rotation == (0.0, 0.0, 0.0)


@pytest.mark.parametrize("number", [float("nan"), float("inf"), -float("inf"), 1e10])
def test_numbers_that_are_no_measurement_do_not_pass(number):
    payload = encode(topics.MASTER_STATE, messages.MasterState(displacement=(0.0, number, 0.0)))
    with pytest.raises(MalformedMessage):
        decode(topics.MASTER_STATE, payload)


def test_an_orientation_must_be_a_unit_quaternion():
    with pytest.raises(ValueError, match="norm 2"):
        messages.Pose((0.0, 0.0, 0.0), (2.0, 0.0, 0.0, 0.0))


@pytest.mark.parametrize("region", [((), (1.0,)), ((0.1,), ()), ((0.1, 0.2), (0.2, 0.1))])
def test_a_region_reaches_from_its_least_corner_to_its_greatest(region, fill):
    scene = fill(messages.SceneState)
    with pytest.raises(ValueError, match="a region cannot reach from"):
        msgspec.structs.replace(scene, condition_region=region)


def test_an_array_must_have_as_many_bytes_as_its_shape_says():
    with pytest.raises(ValueError, match="24 bytes"):
        messages.Array("<f8", (2, 3), b"\0" * 24)


def test_deeply_nested_garbage_is_malformed():
    with pytest.raises(MalformedMessage):
        decode(topics.ROBOT_STATE, b"\x81\xa1q" + b"\x91" * 10_000 + b"\xc0")
