"""The bus over Zenoh: one process' way to all others of its robot."""

from __future__ import annotations

import contextlib
import threading
import time
from collections.abc import Callable, Mapping
from typing import Any, TypeVar

import msgspec
import zenoh

from protocol.codec import decode_reply, encode_request
from protocol.exceptions import ProtocolError
from protocol.messages import Message, TopicFigures
from protocol.names import checked_name
from protocol.placement import announcement, check_announced
from protocol.queries import Query
from protocol.topic import VERSION, QoS, Topic
from services.bus.bus import Failed, Pending
from services.bus.clocks import Clocks
from services.bus.identity import new_publisher
from services.bus.outbox import Outbox
from services.bus.server import Server
from services.bus.subscription import Subscription
from services.bus.zenoh.commanders import Commanders, CommanderToken
from services.bus.zenoh.dialling import Opened
from services.bus.zenoh.encoding import announced, encoding
from services.bus.zenoh.lanes import Lanes, comes_again
from services.bus.zenoh.qos import MANNERS
from services.bus.zenoh.session import open_session
from services.certificates.credentials import Credentials
from services.process.clock import Clock
from services.process.exceptions import NameTaken, RouterUnreachable

M = TypeVar("M", bound=Message)
Req = TypeVar("Req", bound=msgspec.Struct)
Rep = TypeVar("Rep", bound=msgspec.Struct)


NAME_WAIT_S = 3.0
"""How long the token of a killed predecessor may linger before its name counts as taken."""

NAME_ASK_S = 0.5


class ZenohBus:
    """One process' way to all others of its robot, over a client's session.

    Who it is and how far its numbers have come is the bus'; what is declared is declared on every session of Zenoh's
    in turn.

    Args:
        lanes: to the router; the bus closes them.
        robot: whose topics these are.
        process: this process' name, the last chunk of the keys that it publishes on.
        clock: for stamps and receipt times.
    """

    def __init__(self, lanes: Lanes, robot: str, process: str, clock: Clock) -> None:
        self._lanes = lanes
        self._session = lanes.session
        self._robot = checked_name(robot)
        self._process = checked_name(process)
        self._clock = clock
        self._outbox = Outbox(new_publisher(), self._robot, self._process)
        self._clocks = Clocks(self.identity)
        self._inlets: list[Subscription[Any] | Server[Any, Any]] = []
        self._commanders: Commanders | None = None
        self._token: CommanderToken | None = None

    @property
    def identity(self) -> int:
        """This incarnation."""
        return self._outbox.identity

    def claim_name(self) -> None:
        """Announce this process on the network, once a predecessor's token has gone.

        Raises:
            NameTaken: another one of the name is there and stays there.
            TimeoutError: the router did not say whether there is one.
        """
        key = f"retouch/{VERSION}/{self._robot}/alive/{self._process}"
        deadline = time.monotonic() + NAME_WAIT_S
        while held := self._session.use(lambda opened: list(opened.session.liveliness().get(key, timeout=NAME_ASK_S))):
            if time.monotonic() > deadline:
                if any(reply.ok is not None for reply in held):
                    raise NameTaken(self._robot, self._process)
                raise TimeoutError
            time.sleep(0.1)
        self._session.declare(lambda session: session.liveliness().declare_token(key))

    def publish(self, topic: Topic[M], message: M) -> None:
        """Send to whoever subscribes."""
        payload = self._outbox.pack(topic, message, self._clock.now_ns())
        if payload is None:
            return
        datagrams = self._lanes.datagrams(topic)
        sent = datagrams is not None and datagrams.put(lambda session: self._put(session, topic, payload))
        if not sent or topic.qos is QoS.SAFETY:  # a stop goes every way there is
            self._lanes.stream(topic).use(lambda opened: self._publisher(opened, topic).put(payload))

    def subscribe(self, topic: Topic[M], call: threading.Event | None = None) -> Subscription[M]:
        """Receive what any process publishes on the topic."""
        subscription = Subscription(topic, self._robot, self.identity, self._clocks, call)

        def store(sample: zenoh.Sample) -> None:
            key = str(sample.key_expr)
            subscription.receive(sample.payload.to_bytes(), announced(sample.encoding), self._clock.now_ns(), key)

        key_expression = topic.key(self._robot, "*")
        datagrams = self._lanes.datagrams(topic)
        if datagrams is not None and topic.qos is not QoS.SAFETY:
            datagrams.subscribe(lambda session, hear: session.declare_subscriber(key_expression, hear), store)
        else:
            self._lanes.stream(topic).declare(lambda session: session.declare_subscriber(key_expression, store))
        self._inlets.append(subscription)
        return subscription

    def serve(self, query: Query[Req, Rep]) -> Server[Req, Rep]:
        """Answer a query."""
        server = Server(query, self._robot, self._clock)

        def store(call: zenoh.Query) -> None:
            payload = call.payload.to_bytes() if call.payload is not None else b""
            schema = announced(call.encoding) if call.encoding is not None else ""
            key = str(call.key_expr)
            respond = _responder(call, key, announcement(query, self._robot, query.reply))
            server.receive(payload, schema, respond, key.rpartition("/")[2])

        key_expression = query.key(self._robot)
        self._session.declare(lambda session: session.declare_queryable(key_expression, store, complete=True))
        self._inlets.append(server)
        return server

    def ask(self, query: Query[Req, Rep], request: Req, timeout_s: float = 2.0) -> Pending[Rep]:
        """Ask; the answer is settled on one of Zenoh's threads."""
        pending: Pending[Rep] = Pending()

        def settle(reply: zenoh.Reply) -> None:
            if reply.ok is None:
                pending.settle(Failed(f"{query.name} was not answered in {timeout_s:g} s"))
                return
            try:
                check_announced(query, self._robot, announced(reply.ok.encoding))
                pending.settle(decode_reply(query, reply.ok.payload.to_bytes()))
            except ProtocolError as error:
                pending.settle(Failed(str(error)))

        def end() -> None:
            shown = self._session.credentials
            if shown is None:
                pending.settle(
                    Failed(f"nobody answers {query.name}: is the {query.server} process of this robot running?")
                )
            else:
                reason = f"is the {query.server} there, and may {shown.subject} ask?"
                pending.settle(Failed(f"nobody answers {query.name}: {reason}"))

        try:
            payload = encode_request(query, request)
        except ProtocolError as error:
            pending.settle(Failed(str(error)))
            return pending
        transport = MANNERS[QoS.EVENT]
        self._session.use(
            lambda opened: opened.session.get(
                query.key(self._robot, self._process),
                zenoh.handlers.Callback(settle, end),
                payload=payload,
                encoding=encoding(announcement(query, self._robot, query.request)),
                timeout=timeout_s,
                congestion_control=transport.congestion_control,
                priority=transport.priority,
                express=transport.express,
            )
        )
        return pending

    def neighbours(self) -> Mapping[str, str]:
        """The other robots that were there since the first call, and the operator who commands each."""
        self._commanders = self._commanders or Commanders(self._session)
        return {robot: operator for robot, operator in self._commanders.now().items() if robot != self._robot}

    def tell_commander(self, operator: str) -> None:
        """Say, for this robot, that it is there and who commands it."""
        if self._token is None:
            self._token = CommanderToken(self._session, self._robot)
            self._token.start()
        self._token.tell(operator)

    def neighbour(self, robot: str) -> ZenohBus:
        """This process' way to another robot, over the same lanes."""
        return ZenohBus(self._lanes, robot, self._process, self._clock)

    def figures(self) -> tuple[TopicFigures, ...]:
        """What was received on each topic, and asked on each query, since the last call."""
        now = self._clock.now_ns()
        return (*(inlet.figures(now) for inlet in self._inlets), *self._outbox.figures())

    def faults(self) -> list[str]:
        """Why messages were thrown away, or not sent, since the last call; the newest reason for each key."""
        return [*(fault for inlet in self._inlets if (fault := inlet.take_fault())), *self._outbox.take_faults()]

    def close(self) -> None:
        """Leave the network."""
        if self._token is not None:
            self._token.end()
        self._lanes.close()

    def _put(self, session: zenoh.Session, topic: Topic[Any], payload: bytes) -> None:
        """Send a datagram; nothing is declared for it, since that could be lost."""
        transport = MANNERS[topic.qos]
        session.put(
            topic.key(self._robot, self._process),
            payload,
            encoding=encoding(topic.schema),
            priority=transport.priority,
            congestion_control=transport.congestion_control,
            express=transport.express,
        )

    def _publisher(self, opened: Opened, topic: Topic[Any]) -> zenoh.Publisher:
        key = topic.key(self._robot, self._process)  # the ways to several robots share a session
        publisher = opened.publishers.get(key)
        if publisher is None:
            transport = MANNERS[topic.qos]
            publisher = opened.publishers[key] = opened.session.declare_publisher(
                key,
                encoding=encoding(topic.schema),
                priority=transport.priority,
                congestion_control=transport.congestion_control,
                express=transport.express,
                reliability=_reliability(topic),
            )
        return publisher


def _reliability(topic: Topic[Any]) -> zenoh.Reliability:
    """Between routers, what comes again within a moment travels as datagrams; a stop does not count on that."""
    again = comes_again(topic) and topic.qos is not QoS.SAFETY
    return zenoh.Reliability.BEST_EFFORT if again else zenoh.Reliability.RELIABLE


def _responder(call: zenoh.Query, key: str, says: str) -> Callable[[bytes], None]:
    def respond(payload: bytes) -> None:
        with contextlib.suppress(zenoh.ZError):  # whoever asked has gone
            call.reply(key, payload, encoding=encoding(says))
        call.drop()  # type: ignore[no-untyped-call]  # Zenoh's stub leaves it bare

    return respond


def connect(
    endpoint: str,
    robot: str,
    process: str,
    clock: Clock,
    *,
    timeout_s: float = 30.0,
    credentials: Credentials | None = None,
) -> ZenohBus:
    """A bus for one process, its name claimed.

    Args:
        endpoint: of the router.
        robot: whose topics these are.
        process: this process' name.
        clock: for stamps and receipt times.
        timeout_s: how long to wait for the router [s].
        credentials: to show to it; None where it asks for none.

    Raises:
        BusError: see `open_session`.
        NameTaken: the robot has such a process already.
    """
    bus = ZenohBus(Lanes(open_session(endpoint, timeout_s, credentials=credentials)), robot, process, clock)
    try:
        bus.claim_name()
    except TimeoutError:
        bus.close()
        raise RouterUnreachable(endpoint, NAME_WAIT_S, "it took the connection and says nothing") from None
    except BaseException:
        bus.close()
        raise
    return bus
