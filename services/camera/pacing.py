"""How many pictures a camera sends, and how good: as much as comes through without a queue before who looks at them.

A queue on the way delays commands as well, since all share the link. It is told by who looks; where it grows the
cameras send less at once, and a little more again and again where it is gone. For who begins to look on another machine
they begin with the least, and send twice as much again and again, no more than a fifth of all at a time, until their
pictures first come later: what the link carries is not known. After a queue that had to empty they do so up to a little
less than what made it.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import TypeVar

from protocol.topics import PICTURE_QUEUE
from services.bus.bus import Bus
from services.bus.identity import same_clock
from services.bus.senders import Senders

T = TypeVar("T")

LONG_S = 0.06
"""Pictures that usually come so much later than they could stand in a queue."""

SHORT_S = 0.035
"""Up to so much later is what sending them takes."""

FULL_S = 0.3
"""A queue as long as this has to empty first, with as little as there may be."""

LESS, MORE, TWICE = 0.6, 1.05, 2.0
MOST = 0.2
"""That is added at a time: what the link cannot carry of it stands in the queue until that is told."""

ADJUST_NS = 400_000_000
"""What was changed shows in what is told after so long."""

EARLY = 0.25
"""Of a picture's period: half of one lies between two steps, and a step comes a little early or late."""

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
        self._away: frozenset[str] = frozenset()
        self._left = 0
        self._until = 0.0
        self._rate_hz = rate_hz
        self._quality = quality
        self._queues = Senders(bus.subscribe(PICTURE_QUEUE), lambda queue: queue.process)
        self._adjusted_ns = 0
        self._due_ns = 0

    @property
    def quality(self) -> int:
        """Of the next picture."""
        return min(self._quality, max(LEAST_QUALITY, round(self._quality * math.sqrt(self.share))))

    def turns(self, now_ns: int, cameras: Sequence[T]) -> Sequence[T]:
        """Those of the cameras that send a picture now.

        On one machine that is all of them at once. On a link pictures that are sent together stand behind each other,
        and what comes next behind all of them: there each has its turn, one a step.
        """
        if not self._left and self.due(now_ns):
            self._left = len(cameras)
        first = len(cameras) - self._left
        self._left -= min(self._left, 1) if self._away else self._left
        return cameras[first : len(cameras) - self._left]

    def due(self, now_ns: int) -> bool:
        """Whether to send pictures now."""
        self._adjust(now_ns)
        period_ns = round(1e9 / (self._rate_hz * math.sqrt(self.share)))
        # A step that comes a little early is this picture's all the same.
        if now_ns < self._due_ns - round(EARLY / self._rate_hz * 1e9):
            return False
        # Nothing is made up for: what is sent together stands in a queue.
        self._due_ns = (self._due_ns if now_ns - self._due_ns < period_ns else now_ns) + period_ns
        return True

    def _adjust(self, now_ns: int) -> None:
        """By the worst that is told; nobody who looks is as good as no queue."""
        queues = {name: told.message for name, told in self._queues.there(now_ns).items()}
        away = frozenset(name for name, queue in queues.items() if not same_clock(queue.publisher, self._own))
        begun, self._away = bool(away - self._away), away
        if not begun and now_ns - self._adjusted_ns < ADJUST_NS:
            return
        self._adjusted_ns = now_ns
        late_s = max((queue.late for queue in queues.values()), default=0.0)
        if begun:
            self.share, self._until = LEAST, 1.0
        elif late_s > FULL_S:
            if self.share > LEAST:
                self._until = LESS * self.share
            self.share = LEAST
        elif late_s > LONG_S:
            self.share = self._until = max(LEAST, LESS * self.share)
        elif late_s < SHORT_S:
            if late_s > 0.5 * SHORT_S:
                self._until = min(self._until, self.share)
            self.share = min(1.0, max(MORE * self.share, min(TWICE * self.share, self.share + MOST, self._until)))
        else:
            self.share = self._until = max(LEAST, self.share / MORE**2)
