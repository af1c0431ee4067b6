"""The receiving end of a topic: what came is decoded, judged and stored, and nothing else happens."""

from __future__ import annotations

import threading
from collections import deque
from typing import Generic, NamedTuple, TypeVar

from protocol.codec import decode
from protocol.exceptions import ProtocolError
from protocol.messages import Message, TopicFigures
from protocol.placement import check_message
from protocol.topic import QoS, Topic
from services.bus.clocks import Clocks
from services.bus.freshness import Freshness, Judgement
from services.bus.identity import same_clock
from services.bus.tally import Drops, Tally

M = TypeVar("M", bound=Message)


class Received(NamedTuple, Generic[M]):
    """A message and when it came, in the receiver's clock."""

    message: M
    received_ns: int

    def age_s(self, now_ns: int) -> float:
        """Time since it came [s]."""
        return (now_ns - self.received_ns) / 1e9


class Subscription(Generic[M]):
    """The receiving end of a topic.

    The transport calls `receive` on its own threads; a service reads with `latest` or `take` in its step.

    Args:
        topic: that is received.
        robot: whose.
        own: the receiver's identity.
        clocks: of the machines that anything was heard from.
        call: set with every message that counts; None where nobody waits for one.
    """

    def __init__(
        self, topic: Topic[M], robot: str, own: int, clocks: Clocks, call: threading.Event | None = None
    ) -> None:
        self.topic = topic
        self._robot = robot
        self._own = own
        self._freshness = Freshness(topic.stale_after_ns, own, topic.rate_hz, clocks)
        self._lock = threading.Lock()
        self._latest: Received[M] | None = None
        self._kept: deque[Received[M]] = deque(maxlen=topic.kept)
        self._taken = False
        self._tally = Tally(topic.name)
        self._call = call

    @property
    def drops(self) -> Drops:
        """What was thrown away so far, by cause."""
        return self._tally.drops

    def receive(self, payload: bytes, schema: str, now_ns: int, key: str | None = None) -> None:
        """Decode, judge, store, call; nothing else happens here.

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
                self._tally.dropped(error, str(error))
                return
            judgement = self._judge(message, now_ns)
            if judgement is Judgement.IMPLAUSIBLE:
                fault = f"implausible on {self.topic.name}: {message.process!r} counts to {message.sequence}"
                self._tally.dropped(judgement, fault)
                return
            if judgement is not Judgement.FRESH:
                self._tally.dropped(judgement)
                return
            self._tally.came()
            if self._taken and len(self._kept) == self.topic.kept > 1:
                self._tally.crowded()
            self._latest = Received(message, now_ns)
            self._kept.append(self._latest)
        if self._call is not None:
            self._call.set()

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
        self._taken = True  # from now on what is not taken is lost; others look at the newest only
        if not self._kept:
            return []
        with self._lock:
            taken = list(self._kept)
            self._kept.clear()
        return taken

    def take_fault(self) -> str:
        """The newest reason for throwing a message away since the last call; empty where there is none."""
        return self._tally.take_fault()

    def figures(self, now_ns: int) -> TopicFigures:
        """Rate, age and latency since the last call, and all drops so far."""
        received, age, latency = self._latest, -1.0, -1.0
        if received is not None:
            age = received.age_s(now_ns)
            if same_clock(received.message.publisher, self._own):
                latency = (received.received_ns - received.message.stamp_ns) / 1e9
        return self._tally.figures(now_ns, age=age, latency=latency)
