"""The bus: publish, subscribe, ask, answer. What every service sees of the transport."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field
from typing import Any, Generic, Protocol, TypeVar

import msgspec

from protocol.exceptions import Misplaced
from protocol.messages import Message, TopicFigures
from protocol.queries import Query, Refused
from protocol.topics import Topic
from services.bus.server import Server
from services.bus.subscription import Subscription

M = TypeVar("M", bound=Message)
Req = TypeVar("Req", bound=msgspec.Struct)
Rep = TypeVar("Rep", bound=msgspec.Struct)


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
