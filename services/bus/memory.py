"""The bus in one process, for tests: same codec, same judgement of freshness, a clock that is moved by hand."""

from __future__ import annotations

import threading
from collections.abc import Mapping
from typing import Any, TypeVar

import msgspec

from protocol.codec import decode_reply, encode_request
from protocol.exceptions import ProtocolError
from protocol.messages import Message, TopicFigures
from protocol.placement import announcement
from protocol.queries import Query
from protocol.topic import Topic
from services.bus.bus import Failed, Pending
from services.bus.clocks import Clocks
from services.bus.identity import new_publisher
from services.bus.outbox import Outbox
from services.bus.server import Server
from services.bus.subscription import Subscription
from services.process.clock import Clock

M = TypeVar("M", bound=Message)
Req = TypeVar("Req", bound=msgspec.Struct)
Rep = TypeVar("Rep", bound=msgspec.Struct)


class MemoryNetwork:
    """What the buses of a test have in common.

    Args:
        clock: that all of them share.
        robot: whose network it is.
    """

    def __init__(self, clock: Clock, robot: str = "robot1") -> None:
        self.clock = clock
        self.robot = robot
        self.others: dict[str, MemoryNetwork] = {}
        self.commander = ""
        self.subscriptions: list[Subscription[Any]] = []
        self.servers: dict[str, Server[Any, Any]] = {}

    def bus(self, process: str = "") -> MemoryBus:
        """A new process' way in.

        Args:
            process: its name; without one it speaks for whichever process publishes a topic.
        """
        return MemoryBus(self, process)

    def join(self, other: MemoryNetwork) -> None:
        """Be on one network with another robot's."""
        self.others[other.robot], other.others[self.robot] = other, self

    def deliver(self, topic: Topic[Any], payload: bytes, schema: str = "") -> None:
        """Put bytes on a topic, as any program on a network could."""
        for subscription in self.subscriptions:
            if subscription.topic.name == topic.name:
                subscription.receive(payload, schema, self.clock.now_ns())


class MemoryBus:
    """The bus of one process under test."""

    def __init__(self, network: MemoryNetwork, process: str) -> None:
        self._network = network
        self._process = process
        self._outbox = Outbox(new_publisher(), network.robot, process)
        self._clocks = Clocks(self.identity)
        self._own: list[Subscription[Any]] = []
        self._servers: list[Server[Any, Any]] = []

    @property
    def identity(self) -> int:
        """This incarnation."""
        return self._outbox.identity

    def publish(self, topic: Topic[M], message: M) -> None:
        """Deliver at once."""
        payload = self._outbox.pack(topic, message, self._network.clock.now_ns())
        if payload is not None:
            self._network.deliver(topic, payload, topic.schema)

    def subscribe(self, topic: Topic[M], call: threading.Event | None = None) -> Subscription[M]:
        """Receive what is published from now on."""
        subscription = Subscription(topic, self._network.robot, self.identity, self._clocks, call)
        self._network.subscriptions.append(subscription)
        self._own.append(subscription)
        return subscription

    def serve(self, query: Query[Req, Rep]) -> Server[Req, Rep]:
        """Answer a query."""
        server = Server(query, self._network.robot, self._network.clock)
        self._network.servers[query.name] = server
        self._servers.append(server)
        return server

    def ask(self, query: Query[Req, Rep], request: Req, timeout_s: float = 2.0) -> Pending[Rep]:
        """Queue the request; a timeout cannot happen in memory, an absent server is a failure."""
        del timeout_s
        pending: Pending[Rep] = Pending()
        server = self._network.servers.get(query.name)
        if server is None:
            pending.settle(Failed(f"nobody answers {query.name}"))
            return pending
        try:
            payload = encode_request(query, request)
        except ProtocolError as error:
            pending.settle(Failed(str(error)))
            return pending
        announced = announcement(query, self._network.robot, query.request)
        server.receive(payload, announced, lambda reply: pending.settle(decode_reply(query, reply)), self._process)
        return pending

    def neighbours(self) -> Mapping[str, str]:
        """The robots whose networks are one with this one's."""
        return {robot: network.commander for robot, network in self._network.others.items()}

    def tell_commander(self, operator: str) -> None:
        """Say who commands the network's robot."""
        self._network.commander = operator

    def neighbour(self, robot: str) -> MemoryBus:
        """The same process' way to another robot."""
        return self._network.others[robot].bus(self._process)

    def figures(self) -> tuple[TopicFigures, ...]:
        """What was received since the last call."""
        now = self._network.clock.now_ns()
        return (*(inlet.figures(now) for inlet in self._inlets), *self._outbox.figures())

    def faults(self) -> list[str]:
        """What was thrown away since the last call."""
        return [*(fault for inlet in self._inlets if (fault := inlet.take_fault())), *self._outbox.take_faults()]

    @property
    def _inlets(self) -> list[Subscription[Any] | Server[Any, Any]]:
        return [*self._own, *self._servers]

    def close(self) -> None:
        """Leave."""
        for subscription in self._own:
            self._network.subscriptions.remove(subscription)
        self._own = []
