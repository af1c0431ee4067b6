"""Whether a message, a request or a reply came where it belongs.

A transport was seen to hand samples to the receivers of another key after a link was cut, of another robot too. So
each says where it belongs, and the receiver compares.
"""

from __future__ import annotations

from typing import Any

import msgspec

from protocol.exceptions import Misplaced
from protocol.messages import Message
from protocol.queries import Query
from protocol.topics import Topic


def check_message(topic: Topic[Any], robot: str, message: Message, key: str | None = None) -> None:
    """Let a message pass that belongs to the robot's topic, from a process that may publish on it.

    Args:
        topic: that was subscribed to.
        robot: whose.
        message: as decoded.
        key: on which the transport says that it came; None where the transport has no keys.

    Raises:
        Misplaced: it names another robot, topic or key, or a process that does not publish this topic.
    """
    if (message.robot, message.topic) != (robot, topic.name):
        raise Misplaced(topic.name, f"belongs to {message.topic!r} of robot {message.robot!r}")
    if not topic.published_by(message.process):
        raise Misplaced(topic.name, f"comes from {message.process!r}: only the {topic.publisher} publishes it")
    if key is not None and key != topic.key(robot, message.process):
        raise Misplaced(topic.name, f"comes from {message.process!r} under the key {key}")


def announcement(query: Query[Any, Any], robot: str, type_: type[msgspec.Struct]) -> str:
    """What is announced with a request or a reply: its schema, and where it belongs."""
    return f"{type_.__name__}/1 {robot} {query.name}"


def check_announced(query: Query[Any, Any], robot: str, announced: str) -> str:
    """Let a request or a reply pass that belongs to the robot's query; the schema that it announces.

    Args:
        query: that is answered, or was asked.
        robot: whose.
        announced: by the sender; of a foreign one the schema alone, or nothing.

    Raises:
        Misplaced: it names another robot or query.
    """
    schema, *place = announced.split(" ")
    if place and place != [robot, query.name]:
        raise Misplaced(query.name, f"belongs to {' of robot '.join(repr(part) for part in reversed(place))}")
    return schema
