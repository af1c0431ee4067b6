"""Messages to bytes and back, with size bounds; nothing malformed passes."""

from __future__ import annotations

from typing import Any, TypeVar

import msgspec

from protocol.exceptions import MalformedMessage, OversizedMessage, WrongVersion
from protocol.fitting import fit
from protocol.messages import Message
from protocol.queries import QUERIES, Query, Refused
from protocol.topic import Topic
from protocol.topics import TOPICS

M = TypeVar("M", bound=Message)
Req = TypeVar("Req", bound=msgspec.Struct)
Rep = TypeVar("Rep", bound=msgspec.Struct)

_ENCODER = msgspec.msgpack.Encoder()

_READ: list[Any] = [topic.type for topic in TOPICS]
_READ += [type_ for query in QUERIES for type_ in (query.request, query.reply | Refused)]

_DECODERS: dict[Any, msgspec.msgpack.Decoder[Any]] = {type_: msgspec.msgpack.Decoder(type_) for type_ in _READ}
"""All of them before the first message: msgspec lets other threads see a description of a struct that it has not
finished, and a decoder that follows one ends the process (segmentation fault, msgspec 0.22)."""


def encode(topic: Topic[M], message: M) -> bytes:
    """The message as a MessagePack map, its texts cut to what readers let pass.

    Raises:
        OversizedMessage: it is larger than the topic allows.
        MalformedMessage: it holds what no message can.
    """
    return _encode(topic.name, fit(message), topic.max_bytes)


def decode(topic: Topic[M], payload: bytes, schema: str = "") -> M:
    """The message in the payload.

    Args:
        topic: that it came on.
        payload: as received.
        schema: as announced by the sender; empty where a foreign sender announced none.

    Raises:
        OversizedMessage: before anything is decoded.
        WrongVersion: the sender announced another schema.
        MalformedMessage: the payload is no such message.
    """
    _check_schema(topic.name, schema, topic.schema)
    message: M = _decode(topic.name, payload, topic.max_bytes, topic.type)
    return message


def encode_request(query: Query[Req, Rep], request: Req) -> bytes:
    """The request as a MessagePack map.

    Raises:
        OversizedMessage: it is larger than the query allows.
        MalformedMessage: it holds what no message can.
    """
    return _encode(query.name, request, query.max_bytes)


def decode_request(query: Query[Req, Rep], payload: bytes, schema: str = "") -> Req:
    """The request in the payload; raises as `decode`."""
    _check_schema(query.name, schema, query.schema)
    request: Req = _decode(query.name, payload, query.max_bytes, query.request)
    return request


def encode_reply(query: Query[Req, Rep], reply: Rep | Refused) -> bytes:
    """The reply as a MessagePack map whose field `reply` says which one it is, its texts cut as a message's.

    Raises:
        OversizedMessage: it is larger than the query allows.
        MalformedMessage: it holds what no message can.
    """
    return _encode(query.name, fit(reply), query.max_bytes)


def decode_reply(query: Query[Req, Rep], payload: bytes) -> Rep | Refused:
    """The reply in the payload; raises as `decode`."""
    reply: Rep | Refused = _decode(query.name, payload, query.max_bytes, query.reply | Refused)
    return reply


def _encode(subject: str, struct: msgspec.Struct, bound: int) -> bytes:
    try:
        payload = _ENCODER.encode(struct)
    except (TypeError, ValueError, OverflowError) as error:  # a lone surrogate, a number of more than 64 bits
        raise MalformedMessage(subject, str(error)) from None
    return _bounded(subject, payload, bound)


def _bounded(subject: str, payload: bytes, bound: int) -> bytes:
    if len(payload) > bound:
        raise OversizedMessage(subject, len(payload), bound)
    return payload


def _check_schema(subject: str, announced: str, expected: str) -> None:
    if announced and announced != expected:
        raise WrongVersion(subject, announced, expected)


def _decode(subject: str, payload: bytes, bound: int, type_: Any) -> Any:
    _bounded(subject, payload, bound)
    try:
        return _DECODERS[type_].decode(payload)
    except (ValueError, RecursionError) as error:  # a text that is no UTF-8 among them
        raise MalformedMessage(subject, str(error)) from None
