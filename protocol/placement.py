"""Whether a message, a request or a reply came where it belongs.

A transport was seen to hand samples to the receivers of another key after a link was cut, of another robot too. So
each says where it belongs, and the receiver compares.
"""

from __future__ import annotations

from functools import lru_cache
from typing import Any

import msgspec

from protocol.exceptions import Misplaced
from protocol.messages import Message
from protocol.queries import Query
from protocol.topic import Topic, publishes, source_key


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
    _check_place(topic.name, topic.publisher, robot, (message.robot, message.topic, message.process), key)


@lru_cache(maxsize=1024)  # of every message the same few; what is misplaced is not remembered, and judged anew
def _check_place(name: str, publisher: str, robot: str, named: tuple[str, str, str], key: str | None) -> None:
    named_robot, named_topic, process = named
    if (named_robot, named_topic) != (robot, name):
        raise Misplaced(name, f"belongs to {named_topic!r} of robot {named_robot!r}")
    if not publishes(publisher, process):
        raise Misplaced(name, f"comes from {process!r}: only the {publisher} publishes it")
    if key is not None and key != source_key(robot, name, process):
        raise Misplaced(name, f"comes from {process!r} under the key {key}")


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
