"""What is worth drawing: what is new, and what stays as it is only now and then."""

from __future__ import annotations

from typing import Generic, TypeVar

from protocol.messages import MasterState, Message, OperatorInput
from services.bus.subscription import Subscription

M = TypeVar("M", bound=Message)
H = TypeVar("H", OperatorInput, MasterState)


class News(Generic[M]):
    """A subscription that remembers what was taken.

    Args:
        subscription: where the messages come from.
        repeat_s: after how long the same message is news again [s]; never by default.
    """

    def __init__(self, subscription: Subscription[M], repeat_s: float = float("inf")) -> None:
        self._subscription = subscription
        self._repeat_ns = repeat_s * 1e9
        self._taken: tuple[int, int] | None = None
        self._taken_ns = 0

    @property
    def known(self) -> M | None:
        """The newest message, taken or not."""
        received = self._subscription.latest()
        return None if received is None else received.message

    def take(self, now_ns: int) -> M | None:
        """The newest message where it is news."""
        message = self.known
        if message is None:
            return None
        identity = (message.publisher, message.sequence)
        if identity == self._taken and now_ns - self._taken_ns < self._repeat_ns:
            return None
        self._taken, self._taken_ns = identity, now_ns
        return message


class NewsOfHolder(Generic[H]):
    """A subscription to what several people's processes tell, of which one may command.

    Args:
        subscription: where the messages come from.
    """

    def __init__(self, subscription: Subscription[H]) -> None:
        self._subscription: Subscription[H] = subscription

    def take(self, holder: str) -> H | None:
        """The newest message since the last call, of who holds the authority; anybody's where nobody does."""
        messages = [received.message for received in self._subscription.take()]
        theirs = [message for message in messages if holder in ("", message.holder)]
        return theirs[-1] if theirs else None


class Changes:
    """Says whether a value has changed, or stayed for so long that it is worth repeating.

    Args:
        repeat_s: after how long [s].
    """

    def __init__(self, repeat_s: float) -> None:
        self._repeat_ns = repeat_s * 1e9
        self._known: dict[str, tuple[object, int]] = {}

    def due(self, subject: str, value: object, now_ns: int) -> bool:
        """Whether the value of this subject is to be drawn now."""
        known = self._known.get(subject)
        if known is not None and known[0] == value and now_ns - known[1] < self._repeat_ns:
            return False
        self._known[subject] = (value, now_ns)
        return True
