"""When each topic is due, at the rate that the registry gives it."""

from __future__ import annotations

from typing import Any

from protocol.topic import Topic


class Schedule:
    """Counts in absolute periods from the first time that it is asked, so that rates do not drift."""

    def __init__(self) -> None:
        self._next_ns: dict[str, int] = {}

    def due(self, topic: Topic[Any], now_ns: int, share: float = 1.0) -> bool:
        """Whether to publish the topic now; then it is due again one period later, without making up for any.

        Args:
            topic: that is published.
            now_ns: the time.
            share: of the topic's rate at which it is published now.
        """
        due_ns = self._next_ns.setdefault(topic.name, now_ns)
        if now_ns < due_ns:
            return False
        period = round(1e9 / (share * topic.rate_hz))
        behind = (now_ns - due_ns) // period
        self._next_ns[topic.name] = due_ns + (behind + 1) * period
        return True
