"""The bus: publish, subscribe, ask, answer. What every service sees of the transport."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, Generic, Protocol, TypeVar

import msgspec

from protocol.codec import decode, decode_request, encode_reply
from protocol.exceptions import Misplaced, OversizedMessage, ProtocolError, WrongVersion
from protocol.messages import Message, TopicFigures
from protocol.placement import check_announced, check_message
from protocol.queries import Query, Refused
from protocol.topics import QoS, Topic
from services.bus.clocks import Clocks
from services.bus.freshness import Freshness, Judgement
from services.bus.identity import same_clock

M = TypeVar("M", bound=Message)
Req = TypeVar("Req", bound=msgspec.Struct)
Rep = TypeVar("Rep", bound=msgspec.Struct)

CALLS_KEPT = 64


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


@dataclass(frozen=True)
class Call(Generic[Req, Rep]):
    """A request that waits for its answer."""

    query: Query[Req, Rep]
    request: Req
    respond: Callable[[bytes], None]

    def reply(self, reply: Rep | Refused) -> None:
        """Answer, once."""
        self.respond(encode_reply(self.query, reply))


class Server(Generic[Req, Rep]):
    """The answering end of a query.

    The transport calls `receive` on its own threads; a service takes and answers in its step.

    Args:
        query: that is answered.
        robot: whose.
    """

    def __init__(self, query: Query[Req, Rep], robot: str) -> None:
        self._query = query
        self._robot = robot
        self._calls: deque[Call[Req, Rep]] = deque()
        self.drops = Drops()
        self._fault = ""
        self._count = 0
        self._counted_from_ns = 0

    def receive(self, payload: bytes, announced: str, respond: Callable[[bytes], None]) -> None:
        """Queue the request; what is no request, or one too many, is refused at once."""
        try:
            schema = check_announced(self._query, self._robot, announced)
            request = decode_request(self._query, payload, schema)
        except ProtocolError as error:
            self.drops.count(error)
            self._fault = str(error)
            respond(encode_reply(self._query, Refused(self._fault)))
            return
        if len(self._calls) >= CALLS_KEPT:
            respond(encode_reply(self._query, Refused(f"too many requests wait for {self._query.name}")))
            return
        self._count += 1
        self._calls.append(Call(self._query, request, respond))

    def take(self) -> list[Call[Req, Rep]]:
        """The requests since the last call."""
        taken = []
        while self._calls:
            taken.append(self._calls.popleft())
        return taken

    def take_fault(self) -> str:
        """The newest reason for refusing bytes that are no request since the last call; empty where there is none."""
        fault, self._fault = self._fault, ""
        return fault

    def figures(self, now_ns: int) -> TopicFigures:
        """Requests a second since the last call, and all that were none so far."""
        count, since = self._count, self._counted_from_ns
        self._count, self._counted_from_ns = 0, now_ns
        rate = count / ((now_ns - since) / 1e9) if since and now_ns > since else 0.0
        return TopicFigures(topic=self._query.name, rate_hz=rate, age=-1.0, latency=-1.0, **vars(self.drops))


@dataclass(frozen=True)
class Failed:
    """No answer: nobody serves the query, it took too long, or what came back was no answer."""

    reason: str


class Pending(Generic[Rep]):
    """An answer to come. `poll` never waits."""

    def __init__(self) -> None:
        self._outcome: Rep | Refused | Failed | None = None

    def settle(self, outcome: Rep | Refused | Failed) -> None:
        """Called by the transport; the first outcome stays."""
        if self._outcome is None:
            self._outcome = outcome

    def poll(self) -> Rep | Refused | Failed | None:
        """The outcome, or None while it is still to come."""
        return self._outcome


class Bus(Protocol):
    """One process' way to all others of its robot."""

    @property
    def identity(self) -> int:
        """This incarnation, as it stands in every message."""
        ...

    def publish(self, topic: Topic[M], message: M) -> None:
        """Send to whoever subscribes; identity, sequence and stamp are filled in."""
        ...

    def subscribe(self, topic: Topic[M]) -> Subscription[M]:
        """Receive what any process publishes on the topic."""
        ...

    def serve(self, query: Query[Req, Rep]) -> Server[Req, Rep]:
        """Answer a query."""
        ...

    def ask(self, query: Query[Req, Rep], request: Req, timeout_s: float = 2.0) -> Pending[Rep]:
        """Ask; returns at once."""
        ...

    def figures(self) -> tuple[TopicFigures, ...]:
        """What was received on each topic, and asked on each query, since the last call."""
        ...

    def faults(self) -> list[str]:
        """What was thrown away since the last call as malformed, oversized or of another version."""
        ...

    def close(self) -> None:
        """Leave the network."""
        ...


@dataclass
class Outbox:
    """Fills in what every message carries.

    Attributes:
        identity: of this incarnation.
        robot: whose topics it publishes on.
        process: its name; empty for a test that speaks for whoever publishes a topic.
    """

    identity: int
    robot: str
    process: str
    _sequences: dict[str, int] = field(default_factory=dict)
    _lock: threading.Lock = field(default_factory=threading.Lock)

    def stamp(self, topic: Topic[M], message: M, now_ns: int) -> M:
        """The message with all that names its sender, and sequence and stamp.

        Raises:
            Misplaced: this process does not publish the topic.
        """
        process = self.process or (topic.publisher if topic.publisher != "any" else "anybody")
        if not topic.published_by(process):
            raise Misplaced(topic.name, f"comes from {process!r}: only the {topic.publisher} publishes it")
        with self._lock:
            sequence = self._sequences.get(topic.name, 0) + 1
            self._sequences[topic.name] = sequence
        changes: dict[str, Any] = {
            "robot": self.robot,
            "topic": topic.name,
            "process": process,
            "publisher": self.identity,
            "sequence": sequence,
            "stamp_ns": now_ns,
        }
        return msgspec.structs.replace(message, **changes)
