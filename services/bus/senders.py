"""The newest message of each of a topic's senders: one that fell silent is forgotten."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Generic, TypeVar

from protocol.messages import Message
from services.bus.subscription import Received, Subscription

M = TypeVar("M", bound=Message)


class Senders(Generic[M]):
    """Follows the senders of a topic that keeps what comes between two steps.

    Args:
        subscription: to the topic.
        name: of a message's sender; None for one that is not followed.
    """

    def __init__(self, subscription: Subscription[M], name: Callable[[M], str | None]) -> None:
        self._subscription = subscription
        self._name = name
        self._newest: dict[str, Received[M]] = {}

    def there(self, now_ns: int) -> Mapping[str, Received[M]]:
        """The newest message of each sender that is heard now, by the sender's name."""
        for received in self._subscription.take():
            name = self._name(received.message)
            if name is not None:
                self._newest[name] = received
        limit = self._subscription.topic.stale_after_ns
        self._newest = {
            name: received
            for name, received in self._newest.items()
            if limit is None or now_ns - received.received_ns <= limit
        }
        return self._newest
