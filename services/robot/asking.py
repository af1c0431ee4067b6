"""Who asks for the authority that another one holds: one at a time, for as long as it says so."""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass, replace

from protocol.messages import SILENCE_GIVES_S, AuthorityRequest
from protocol.names import person

UNSAID_NS = 1_000_000_000
"""Whoever has not said for so long that it asks does not ask any more."""

DECLINED_KEPT = 16
"""So many requests that were declined are remembered: what is still under way of them asks nothing."""


@dataclass(frozen=True)
class Question:
    """A request for the authority.

    Attributes:
        number: of the request.
        holder: the station that asks.
        operator: the person who asks, as the station says.
        person: the same, as the network knows it.
        since_ns: when it began.
        said_ns: when it was said last.
    """

    number: int
    holder: str
    operator: str
    person: str
    since_ns: int
    said_ns: int

    @property
    def who(self) -> str:
        """Asks, for people."""
        return self.operator or self.holder


class Asking:
    """Follows the requests for the authority; times are the robot's monotonic clock.

    Attributes:
        question: that is asked now; None for none.
    """

    def __init__(self) -> None:
        self.question: Question | None = None
        self._declined: deque[int] = deque(maxlen=DECLINED_KEPT)

    @property
    def kept_from(self) -> int:
        """Number of the request that was declined last; 0 for none."""
        return self._declined[-1] if self._declined else 0

    def hear(self, request: AuthorityRequest, received_ns: int) -> None:
        """Somebody asks, or asks on; whoever comes second waits, and what was declined asks nothing."""
        question = self.question
        if not request.number or request.number in self._declined:
            return
        if question is None:
            self.question = Question(
                request.number, request.holder, request.operator, person(request.process), received_ns, received_ns
            )
        elif question.number == request.number:
            self.question = replace(question, said_ns=max(question.said_ns, received_ns))

    def decline(self) -> None:
        """The authority is kept from who asks for it."""
        if self.question is not None:
            self._declined.append(self.question.number)
        self.question = None

    def forget(self) -> None:
        """Nobody has to ask any more."""
        self.question = None

    def expire(self, now_ns: int) -> None:
        """Forget who does not ask any more."""
        if self.question is not None and now_ns - self.question.said_ns > UNSAID_NS:
            self.question = None

    def left_s(self, now_ns: int) -> float:
        """Until silence answers [s]; 0 where nobody asks."""
        if self.question is None:
            return 0.0
        return max(0.0, SILENCE_GIVES_S - (now_ns - self.question.since_ns) / 1e9)
