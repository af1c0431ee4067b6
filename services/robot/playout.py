"""Plays a hand's motion out as the hand made it, though its samples come irregularly.

Samples that come as they may make the arm stop and catch up. Played out a little later, as late as most of them come,
they are there when they are due, and what is between two of them is interpolated (R. Ramjee et al., Adaptive playout
mechanisms for packetized audio applications in wide-area networks, INFOCOM 1994). A way that is regular is not delayed.

Only where the hand is counts so: whether it is there, its presses and every stop go past this.
"""

from __future__ import annotations

import math
from collections import deque
from typing import NamedTuple

import msgspec

from protocol.messages import MasterState, Vector3
from services.bus.subscription import Received

MOST_NS = 150_000_000
"""No motion is played out later than this after the fastest could have been."""

OLDEST_NS = 200_000_000
"""Way and delay together: a sample that is played out is younger, so that no hold comes of it."""

REGULAR_NS = 20_000_000
"""A sample that is the newest for so long, two periods of the master's, was not waited for."""

SPAN_NS = 2_000_000_000
"""Samples of this long say how late they come."""

COVERED = 0.98
"""Share of the samples that are to be there when they are due."""

SLOWER, FASTER = 0.5, 0.25
"""By which share of itself the motion is slowed down while the delay grows, and sped up while it shrinks."""

JUMP_NS = 500_000_000
"""Further off it was no jitter: the clocks have jumped, or somebody was asleep."""


class _Way(NamedTuple):
    """How a sample came.

    Attributes:
        received_ns: when [ns].
        transit_ns: from the master's stamp, with what lies between the clocks [ns].
        until_next_ns: from the stamp of the one before: so long that one was the newest [ns].
    """

    received_ns: int
    transit_ns: int
    until_next_ns: int


class Playout:
    """Of one hand's samples, in the order in which it made them.

    Attributes:
        delay_ns: by how much later than the fastest could be they are to be played out [ns].
    """

    def __init__(self) -> None:
        self.delay_ns = 0
        self._publisher = 0
        self._ways: deque[_Way] = deque()
        self._heard_ns = self._transit_ns = self._fastest_ns = 0
        self._samples: deque[MasterState] = deque()
        self._offset_ns: int | None = None
        self._played_ns = 0

    def clear(self) -> None:
        """Nobody's hand counts now: what it did before is not played out any more."""
        self._samples.clear()
        self._offset_ns = None

    def hear(self, received: Received[MasterState], way_ns: int) -> None:
        """A sample has come.

        Args:
            received: the sample.
            way_ns: how long it was on its way, as far as that is known [ns].
        """
        message = received.message
        way = _Way(received.received_ns, received.received_ns - message.stamp_ns, received.received_ns - self._heard_ns)
        if message.publisher != self._publisher or abs(way.transit_ns - self._transit_ns) > JUMP_NS:
            self._publisher = message.publisher
            self._ways.clear()
            self.clear()
        else:
            self._ways.append(way)
        self._heard_ns, self._transit_ns = message.stamp_ns, way.transit_ns
        while self._ways and way.received_ns - self._ways[0].received_ns > SPAN_NS:
            self._ways.popleft()
        if message.engaged:
            self._samples.append(message)
        else:
            self.clear()
        self._fastest_ns = min((way.transit_ns for way in self._ways), default=0)
        self.delay_ns = self._wanted_ns(way_ns)

    def play(self, newest: Received[MasterState], now_ns: int) -> Received[MasterState]:
        """What counts now: the newest sample, or what the hand did a little earlier.

        Args:
            newest: sample that was heard; when it came tells whether the hand is there.
            now_ns: the time [ns].
        """
        if not newest.message.engaged or not self._ways:
            return newest
        wanted = self._fastest_ns + self.delay_ns
        self._approach(wanted, now_ns)
        due_ns = now_ns - (self._offset_ns if self._offset_ns is not None else wanted)
        while len(self._samples) > 1 and self._samples[1].stamp_ns <= due_ns:
            self._samples.popleft()
        if not self._samples or due_ns >= self._samples[-1].stamp_ns:
            return newest
        return Received(self._between(due_ns), newest.received_ns)

    def _wanted_ns(self, way_ns: int) -> int:
        """So late that nearly always there is a sample that is due later, where that is worth it."""
        if not self._ways:
            return 0
        gaps = sorted(way.until_next_ns for way in self._ways)
        late = gaps[math.ceil(COVERED * (len(gaps) - 1))] - self._fastest_ns
        if late <= REGULAR_NS:
            return 0
        return max(0, min(late, MOST_NS, OLDEST_NS - way_ns))

    def _approach(self, wanted: int, now_ns: int) -> None:
        """Let the delay become what it has to be, without a jump of what is played."""
        passed = max(0, now_ns - self._played_ns)
        self._played_ns = now_ns
        if self._offset_ns is None or abs(wanted - self._offset_ns) > JUMP_NS:
            self._offset_ns = wanted
            return
        step = wanted - self._offset_ns
        self._offset_ns += max(-round(FASTER * passed), min(round(SLOWER * passed), step))

    def _between(self, due_ns: int) -> MasterState:
        """The hand at a moment between two samples, or at the first."""
        first = self._samples[0]
        if len(self._samples) < 2 or due_ns <= first.stamp_ns:
            return first
        second = self._samples[1]
        share = (due_ns - first.stamp_ns) / (second.stamp_ns - first.stamp_ns)
        return msgspec.structs.replace(
            first,
            displacement=_mixed(first.displacement, second.displacement, share),
            velocity=_mixed(first.velocity, second.velocity, share),
            rotation=_mixed(first.rotation, second.rotation, share),
        )


def _mixed(first: Vector3, second: Vector3, share: float) -> Vector3:
    """Between two vectors that lie near to each other."""
    x, y, z = (one + share * (other - one) for one, other in zip(first, second, strict=True))
    return x, y, z
