"""The receiving end of a topic: what came is decoded, judged and stored, and nothing else happens."""

from __future__ import annotations

import threading
from collections import deque
from dataclasses import dataclass
from typing import Generic, TypeVar

from protocol.codec import decode
from protocol.exceptions import Misplaced, OversizedMessage, ProtocolError, WrongVersion
from protocol.messages import Message, TopicFigures
from protocol.placement import check_message
from protocol.topics import QoS, Topic
from services.bus.clocks import Clocks
from services.bus.freshness import Freshness, Judgement
from services.bus.identity import same_clock

M = TypeVar("M", bound=Message)


@dataclass(frozen=True)
class Received(Generic[M]):
    """A message and when it came, in the receiver's clock."""

    message: M
    received_ns: int

    def age_s(self, now_ns: int) -> float:
        """Time since it came [s]."""
        return (now_ns - self.received_ns) / 1e9


_CAUSES: dict[type[ProtocolError], str] = {
    OversizedMessage: "oversized",
    WrongVersion: "wrong_version",
    Misplaced: "misplaced",
}


@dataclass
class Drops:
    """What was thrown away, by cause."""

    malformed: int = 0
    oversized: int = 0
    wrong_version: int = 0
    stale: int = 0
    repeated: int = 0
    future: int = 0
    implausible: int = 0
    misplaced: int = 0

    def count(self, cause: ProtocolError | Judgement) -> None:
        """One more was thrown away."""
        name = cause.value if isinstance(cause, Judgement) else _CAUSES.get(type(cause), "malformed")
        setattr(self, name, getattr(self, name) + 1)


class Subscription(Generic[M]):
    """The receiving end of a topic.

    The transport calls `receive` on its own threads; a service reads with `latest` or `take` in its step.

    Args:
        topic: that is received.
        robot: whose.
        own: the receiver's identity.
        clocks: of the machines that anything was heard from.
    """

    def __init__(self, topic: Topic[M], robot: str, own: int, clocks: Clocks) -> None:
        self.topic = topic
        self.drops = Drops()
        self._robot = robot
        self._fault = ""
        self._own = own
        self._freshness = Freshness(topic.stale_after_ns, own, topic.rate_hz, clocks)
        self._lock = threading.Lock()
        self._latest: Received[M] | None = None
        self._kept: deque[Received[M]] = deque(maxlen=topic.kept)
        self._count = 0
        self._counted_from_ns = 0

    def receive(self, payload: bytes, schema: str, now_ns: int, key: str | None = None) -> None:
        """Decode, judge, store; nothing else happens here.

        Args:
            payload: as received.
            schema: as announced by the sender.
            now_ns: the time.
            key: that the transport names; None where it has no keys.
        """
        with self._lock:
            try:
                message = decode(self.topic, payload, schema)
                check_message(self.topic, self._robot, message, key)
            except ProtocolError as error:
                self.drops.count(error)
                self._fault = str(error)
                return
            judgement = self._judge(message, now_ns)
            if judgement is not Judgement.FRESH:
                self.drops.count(judgement)
                if judgement is Judgement.IMPLAUSIBLE:
                    self._fault = f"implausible on {self.topic.name}: {message.process!r} counts to {message.sequence}"
                return
            self._count += 1
            self._latest = Received(message, now_ns)
            self._kept.append(self._latest)

    def _judge(self, message: M, now_ns: int) -> Judgement:
        if self.topic.qos is QoS.SAFETY:  # a stop counts whatever its stamp, and twice is not too often
            return Judgement.FRESH
        return self._freshness.judge(message.publisher, message.sequence, message.stamp_ns, now_ns, message.process)

    def latest(self) -> Received[M] | None:
        """The newest message that counts, however old it has become since."""
        return self._latest

    def fresh(self, now_ns: int) -> M | None:
        """The newest message, where it is younger than the topic's time to become stale."""
        received = self._latest
        limit = self.topic.stale_after_ns
        if received is None or (limit is not None and now_ns - received.received_ns > limit):
            return None
        return received.message

    def take(self) -> list[Received[M]]:
        """The messages since the last call, in order, at most as many as the topic keeps."""
        with self._lock:
            taken = list(self._kept)
            self._kept.clear()
        return taken

    def take_fault(self) -> str:
        """The newest reason for throwing a message away since the last call; empty where there is none."""
        with self._lock:
            fault, self._fault = self._fault, ""
        return fault

    def figures(self, now_ns: int) -> TopicFigures:
        """Rate, age and latency since the last call, and all drops so far."""
        with self._lock:
            received, count, since = self._latest, self._count, self._counted_from_ns
            self._count, self._counted_from_ns = 0, now_ns
            drops = Drops(**vars(self.drops))
        age, latency = -1.0, -1.0
        if received is not None:
            age = received.age_s(now_ns)
            if same_clock(received.message.publisher, self._own):
                latency = (received.received_ns - received.message.stamp_ns) / 1e9
        rate = count / ((now_ns - since) / 1e9) if since and now_ns > since else 0.0
        return TopicFigures(topic=self.topic.name, rate_hz=rate, age=age, latency=latency, **vars(drops))
