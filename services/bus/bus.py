"""The bus: publish, subscribe, ask, answer. What every service sees of the transport."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from dataclasses import dataclass
from typing import Generic, Protocol, TypeVar

import msgspec

from protocol.messages import Message, TopicFigures
from protocol.queries import Query, Refused
from protocol.topic import Topic
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
        """Send to whoever subscribes, all that names the sender filled in; what cannot be sent is a fault, and told."""
        ...

    def subscribe(self, topic: Topic[M], call: threading.Event | None = None) -> Subscription[M]:
        """Receive what any process publishes on the topic; each message that counts sets `call`, where there is one."""
        ...

    def serve(self, query: Query[Req, Rep]) -> Server[Req, Rep]:
        """Answer a query."""
        ...

    def ask(self, query: Query[Req, Rep], request: Req, timeout_s: float = 2.0) -> Pending[Rep]:
        """Ask; returns at once."""
        ...

    def neighbours(self) -> Mapping[str, str]:
        """The other robots that were there since the first call, and the operator who commands each; empty for nobody.

        One that has gone is as it was told last.
        """
        ...

    def tell_commander(self, operator: str) -> None:
        """Say, for this robot, that it is there and who commands it; empty for nobody."""
        ...

    def neighbour(self, robot: str) -> Bus:
        """This process' way to another robot; it ends with this one."""
        ...

    def figures(self) -> tuple[TopicFigures, ...]:
        """What was received on each topic, and asked on each query, since the last call."""
        ...

    def faults(self) -> list[str]:
        """Why messages were thrown away, or not sent, since the last call; the newest reason for each key."""
        ...

    def close(self) -> None:
        """Leave the network."""
        ...
