"""The answering end of a query: requests wait for the service's step, and what is asked twice is done once."""

from __future__ import annotations

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass
from typing import Any, Generic, TypeVar

import msgspec

from protocol.codec import decode_request, encode_reply
from protocol.exceptions import ProtocolError
from protocol.messages import TopicFigures
from protocol.placement import check_announced
from protocol.queries import Change, Query, Refused
from services.bus.answers import Answers, Respond
from services.bus.tally import Drops, Tally
from services.process.clock import Clock

Req = TypeVar("Req", bound=msgspec.Struct)
Rep = TypeVar("Rep", bound=msgspec.Struct)

CALLS_KEPT = 64


@dataclass(frozen=True)
class Call(Generic[Req, Rep]):
    """A request that waits for its answer.

    Attributes:
        query: that was asked.
        request: what for.
        respond: takes the encoded answer.
        asker: the process that asks, as the network knows it; empty for a test that speaks for anybody.
    """

    query: Query[Req, Rep]
    request: Req
    respond: Callable[[bytes], None]
    asker: str = ""

    def reply(self, reply: Rep | Refused) -> None:
        """Answer, once; an answer that does not fit the query's bound becomes a refusal that says so."""
        self.respond(_encoded(self.query, reply))


class Server(Generic[Req, Rep]):
    """The answering end of a query.

    The transport calls `receive` on its own threads; a service takes and answers in its step.

    Args:
        query: that is answered.
        robot: whose.
        clock: by which answers grow old.
    """

    def __init__(self, query: Query[Req, Rep], robot: str, clock: Clock) -> None:
        self._query = query
        self._robot = robot
        self._clock = clock
        self._lock = threading.Lock()
        self._calls: deque[Call[Req, Rep]] = deque()
        self._answers = Answers()
        self._tally = Tally(query.name)

    @property
    def drops(self) -> Drops:
        """What was no request so far, by cause."""
        return self._tally.drops

    def receive(self, payload: bytes, announced: str, respond: Respond, asker: str = "") -> None:
        """Queue the request, or answer it as before; what is no request, or one too many, is refused at once.

        Args:
            payload: as received.
            announced: by the asker.
            respond: takes the encoded answer.
            asker: the process that asks, by the key that the transport names.
        """
        try:
            schema = check_announced(self._query, self._robot, announced)
            request = decode_request(self._query, payload, schema)
        except ProtocolError as error:
            self._tally.dropped(error, str(error))
            respond(_encoded(self._query, Refused(str(error))))
            return
        self._tally.came()
        number = request.request if isinstance(request, Change) else 0
        with self._lock:
            first = not number or self._answers.open(number, respond, self._clock.now_ns())
            full = first and len(self._calls) >= CALLS_KEPT
            if full and number:
                self._answers.drop(number)
            elif first:
                self._calls.append(Call(self._query, request, self._keeping(number) if number else respond, asker))
        if full:
            self._tally.crowded(f"crowded on {self._query.name}: {CALLS_KEPT} requests wait already")
            respond(_encoded(self._query, Refused(f"too many requests wait for {self._query.name}")))
        elif not first:
            self._hand_out(number)

    def take(self) -> list[Call[Req, Rep]]:
        """The requests since the last call."""
        if not self._calls:
            return []
        with self._lock:
            taken = list(self._calls)
            self._calls.clear()
        return taken

    def take_fault(self) -> str:
        """The newest reason for refusing bytes that are no request since the last call; empty where there is none."""
        return self._tally.take_fault()

    def figures(self, now_ns: int) -> TopicFigures:
        """Requests a second since the last call, and all that were none so far."""
        return self._tally.figures(now_ns)

    def _keeping(self, number: int) -> Respond:
        return lambda payload: self._hand_out(number, payload)

    def _hand_out(self, number: int, payload: bytes | None = None) -> None:
        with self._lock:
            answer = self._answers.close(number, payload)
        if answer is not None:
            kept, waiting = answer
            for respond in waiting:
                respond(kept)


def _encoded(query: Query[Any, Any], reply: Any) -> bytes:
    try:
        return encode_reply(query, reply)
    except ProtocolError as error:
        return encode_reply(query, Refused(str(error)))
