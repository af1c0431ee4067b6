"""What goes out: every message says who sent it, where it belongs and when."""

from __future__ import annotations

import itertools
import threading
from collections.abc import Iterator
from typing import Any, NamedTuple, TypeVar

import msgspec

from protocol.codec import encode
from protocol.exceptions import Misplaced, ProtocolError
from protocol.messages import Message, TopicFigures
from protocol.topic import Topic
from services.bus.tally import Drops

M = TypeVar("M", bound=Message)


class _Sender(NamedTuple):
    """Of one topic: what names its sender in every message, and the numbers of these."""

    names: dict[str, Any]
    numbers: Iterator[int]


class Outbox:
    """Makes a process' messages ready to be sent. Safe to use from several threads.

    Args:
        identity: of this incarnation.
        robot: whose topics it publishes on.
        process: its name; empty for a test that speaks for whoever publishes a topic.
    """

    def __init__(self, identity: int, robot: str, process: str) -> None:
        self.identity = identity
        self._robot = robot
        self._process = process
        self._lock = threading.Lock()
        self._senders: dict[str, _Sender] = {}
        self._unsent: dict[str, Drops] = {}
        self._faults: dict[str, str] = {}

    def pack(self, topic: Topic[M], message: M, now_ns: int) -> bytes | None:
        """The message as it is sent; None, counted and named, for one that no reader would let pass."""
        try:
            return encode(topic, self.stamp(topic, message, now_ns))
        except ProtocolError as error:
            with self._lock:
                self._unsent.setdefault(topic.name, Drops()).count(error)
                self._faults[topic.name] = f"not sent: {error}"
            return None

    def stamp(self, topic: Topic[M], message: M, now_ns: int) -> M:
        """The message with all that names its sender, and sequence and stamp.

        Raises:
            Misplaced: this process does not publish the topic.
        """
        sender = self._senders.get(topic.name)
        if sender is None:  # of two threads one begins to count
            sender = self._senders.setdefault(topic.name, self._sender(topic))
        return msgspec.structs.replace(message, **sender.names, sequence=next(sender.numbers), stamp_ns=now_ns)

    def _sender(self, topic: Topic[Any]) -> _Sender:
        process = self._process or (topic.publisher if topic.publisher != "any" else "anybody")
        if not topic.published_by(process):
            raise Misplaced(topic.name, f"comes from {process!r}: only the {topic.publisher} publishes it")
        names = {"robot": self._robot, "topic": topic.name, "process": process, "publisher": self.identity}
        return _Sender(names, itertools.count(1))

    def figures(self) -> tuple[TopicFigures, ...]:
        """Of the topics on which messages could not be sent: how many so far, by cause."""
        with self._lock:
            return tuple(
                TopicFigures(topic=name, rate_hz=0.0, age=-1.0, latency=-1.0, **vars(drops))
                for name, drops in self._unsent.items()
            )

    def take_faults(self) -> list[str]:
        """The newest reason for not sending a message since the last call, one for each topic."""
        with self._lock:
            faults, self._faults = list(self._faults.values()), {}
        return faults
