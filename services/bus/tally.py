"""What comes in, counted: how often, and what was thrown away of it and why."""

from __future__ import annotations

import threading
from dataclasses import dataclass

from protocol.exceptions import Misplaced, OversizedMessage, ProtocolError, WrongVersion
from protocol.messages import TopicFigures
from services.bus.freshness import Judgement

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
    crowded: int = 0

    def count(self, cause: ProtocolError | Judgement) -> None:
        """One more was thrown away."""
        name = cause.value if isinstance(cause, Judgement) else _CAUSES.get(type(cause), "malformed")
        setattr(self, name, getattr(self, name) + 1)


class Tally:
    """Of one topic or query. Safe to use from several threads.

    Args:
        name: of the topic or query.
    """

    def __init__(self, name: str) -> None:
        self.drops = Drops()
        self._name = name
        self._lock = threading.Lock()
        self._fault = ""
        self._count = 0
        self._counted_from_ns = 0

    def came(self) -> None:
        """One has come that counts."""
        with self._lock:
            self._count += 1

    def dropped(self, cause: ProtocolError | Judgement, fault: str = "") -> None:
        """One was thrown away.

        Args:
            cause: why.
            fault: the same for people; empty for what happens on every network.
        """
        with self._lock:
            self.drops.count(cause)
            self._fault = fault or self._fault

    def crowded(self, fault: str = "") -> None:
        """One that counts, or would, was given up for others that came with it; see `dropped`."""
        with self._lock:
            self.drops.crowded += 1
            self._fault = fault or self._fault

    def take_fault(self) -> str:
        """The newest fault since the last call; empty where there is none."""
        with self._lock:
            fault, self._fault = self._fault, ""
        return fault

    def figures(self, now_ns: int, *, age: float = -1.0, latency: float = -1.0) -> TopicFigures:
        """How many came a second since the last call, and all drops so far.

        Args:
            now_ns: the time.
            age: of the newest one [s]; negative for none.
            latency: of the newest one [s]; negative where it is not known.
        """
        with self._lock:
            count, since = self._count, self._counted_from_ns
            self._count, self._counted_from_ns = 0, now_ns
            drops = vars(self.drops).copy()
        rate = count / ((now_ns - since) / 1e9) if since and now_ns > since else 0.0
        return TopicFigures(topic=self._name, rate_hz=rate, age=age, latency=latency, **drops)
