"""How many pictures a camera sends, and how good: as much as comes through without a queue before who looks at them.

A queue on the way delays commands as well, since all share the link. It is told by who looks; where it grows the
cameras send less at once, and a little more again and again where it is gone. For who begins to look on another machine
they begin with the least, and send twice as much again and again until the first queue: what the link carries is not
known.
"""

from __future__ import annotations

import math

from protocol.topics import PICTURE_QUEUE
from services.bus.bus import Bus
from services.bus.identity import same_clock
from services.bus.senders import Senders

LONG_S = 0.06
"""Pictures that usually come so much later than they could stand in a queue."""

SHORT_S = 0.035
"""Up to so much later is what sending them takes."""

FULL_S = 0.3
"""A queue as long as this has to empty first, with as little as there may be."""

LESS, MORE, TWICE = 0.6, 1.05, 2.0
ADJUST_NS = 400_000_000
"""What was changed shows in what is told after so long."""

LEAST = 0.04
"""Of the bytes that the configuration asks for: a fifth of the pictures, of the least quality."""

LEAST_QUALITY = 25


class Pacing:
    """Follows who looks.

    Args:
        bus: on which they tell.
        rate_hz: of the pictures, at most.
        quality: of them as JPEG, at most.

    Attributes:
        share: of what the configuration asks for, that is sent now.
    """

    def __init__(self, bus: Bus, rate_hz: float, quality: int) -> None:
        self.share = 1.0
        self._own = bus.identity
        self._known: frozenset[str] = frozenset()
        self._more = MORE
        self._rate_hz = rate_hz
        self._quality = quality
        self._queues = Senders(bus.subscribe(PICTURE_QUEUE), lambda queue: queue.process)
        self._adjusted_ns = 0
        self._due_ns = 0

    @property
    def quality(self) -> int:
        """Of the next picture."""
        return min(self._quality, max(LEAST_QUALITY, round(self._quality * math.sqrt(self.share))))

    def due(self, now_ns: int) -> bool:
        """Whether to send pictures now."""
        if now_ns - self._adjusted_ns >= ADJUST_NS:
            self._adjusted_ns = now_ns
            self._adjust(now_ns)
        period_ns = round(1e9 / (self._rate_hz * math.sqrt(self.share)))
        # A step that comes a little early is this picture's all the same.
        if now_ns < self._due_ns - round(0.5e9 / self._rate_hz):
            return False
        self._due_ns = max(self._due_ns + period_ns, now_ns)
        return True

    def _adjust(self, now_ns: int) -> None:
        """By the worst that is told; nobody who looks is as good as no queue."""
        queues = {name: told.message for name, told in self._queues.there(now_ns).items()}
        away = frozenset(name for name, queue in queues.items() if not same_clock(queue.publisher, self._own))
        late_s = max((queue.late for queue in queues.values()), default=0.0)
        if away - self._known or late_s > FULL_S:
            self.share, self._more = LEAST, TWICE
        elif late_s > LONG_S:
            self.share, self._more = max(LEAST, LESS * self.share), MORE
        elif late_s < SHORT_S:
            self.share = min(1.0, self._more * self.share)
        self._known = away
