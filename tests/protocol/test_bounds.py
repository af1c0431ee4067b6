"""A sound message with the longest texts and lists passes, and one that is longer is cut until it does."""

import enum
import types
import typing

import msgspec
import pytest

from protocol import messages, queries, topics
from protocol.codec import decode, decode_reply, encode, encode_reply
from protocol.messages import Array, Motion, Part, Pose, Way, Waypoint

WIDEST = "\U0001f916"  # four bytes, the most that a character takes
TINY = {
    Pose: Pose((1e9, 1e9, 1e9), (1.0, 0.0, 0.0, 0.0)),
    Waypoint: Waypoint((1e9, 1e9, 1e9), (1.0, 0.0, 0.0, 0.0), 0.123456789),
    Array: Array("<f8", (1, 2), b"\0" * 16),
    Motion: Motion(Array("<f8", (2, 3), b"\0" * 48), Array("<f8", (2, 4), b"\0" * 64), 1.0),
    Part: Part(0.25, 0.75),
    Way: Way(9_999, 10_000, 0.123456789),
    bool: True,
    float: 1e9,
    bytes: b"",
}
"""What is as small as it can be where its publisher bounds it: arrays, motions, pictures."""


def largest(type_, longer=0):
    """The value of a type whose texts and lists are as long as they may be, or longer."""
    origin, arguments = typing.get_origin(type_), typing.get_args(type_)
    if origin is typing.Annotated:
        return _bounded(*arguments, longer)
    if origin is typing.Union or origin is types.UnionType:
        return largest(next(a for a in arguments if a is not type(None)), longer)
    if origin is tuple:
        return tuple(largest(a, longer) for a in arguments)
    return TINY[type_] if type_ in TINY else _largest_of(type_, longer)


def _bounded(type_, meta, longer):
    if type_ is str:
        return WIDEST * (meta.max_length + longer)
    if typing.get_origin(type_) is tuple:
        return (largest(typing.get_args(type_)[0], longer),) * (meta.max_length + longer)
    return largest(type_, longer) if meta.le is None else type_(meta.le)


def _largest_of(type_, longer):
    if issubclass(type_, enum.Enum):
        return max(type_, key=lambda member: len(member.value))
    hints = typing.get_type_hints(type_, include_extras=True)
    return type_(**{field: largest(hints[field], longer) for field in type_.__struct_fields__})


@pytest.mark.parametrize("longer", [0, 1, 1000])
@pytest.mark.parametrize("topic", topics.TOPICS, ids=lambda t: t.name)
def test_no_text_or_list_keeps_a_message_from_its_readers(topic, longer):
    message = largest(topic.type, longer)
    read = decode(topic, encode(topic, message), topic.schema)
    if not longer:
        assert read == message


@pytest.mark.parametrize("longer", [0, 1, 1000])
@pytest.mark.parametrize("query", queries.QUERIES, ids=lambda q: q.name)
def test_no_text_or_list_keeps_a_reply_from_its_asker(query, longer):
    for reply in (largest(query.reply, longer), largest(queries.Refused, longer)):
        read = decode_reply(query, encode_reply(query, reply))
        assert type(read) is type(reply)
        if not longer:
            assert read == reply


@pytest.mark.parametrize("query", queries.QUERIES, ids=lambda q: q.name)
def test_the_longest_request_fits_its_bound(query):
    assert len(msgspec.msgpack.encode(largest(query.request))) <= query.max_bytes


def test_what_is_cut_says_so_and_what_fits_is_left_alone():
    stop = messages.EmergencyStop(pressed=True, by="ann", reason="x" * 5000)
    read = decode(topics.EMERGENCY_STOP, encode(topics.EMERGENCY_STOP, stop))
    assert read.reason == "x" * 4095 + "…"
    assert (read.by, read.pressed) == ("ann", True)


def test_a_text_between_two_bounds_is_whole_and_only_what_is_too_long_is_cut():
    """All texts of a message are looked at together, each is cut by its own bound."""
    stop = messages.EmergencyStop(pressed=True, by="b" * 65, reason="x" * 200)
    read = decode(topics.EMERGENCY_STOP, encode(topics.EMERGENCY_STOP, stop))
    assert (read.by, read.reason) == ("b" * 63 + "…", "x" * 200)
