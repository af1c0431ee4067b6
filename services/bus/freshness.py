"""Which samples count: late, future-stamped, out-of-order and repeated ones do not.

Age is judged by the receiver's monotonic clock. On one machine stamps compare directly. From another machine only the
transit above the fastest one seen is known, since the clocks' offset is not; a jump of more than `OFFSET_JUMP_NS` below
the fastest transit is a stamp from the future, anything less a better estimate of the offset. Clocks drift apart, so
the fastest transit is forgotten at `DRIFT`, faster than any quartz drifts.
"""

from __future__ import annotations

from collections import OrderedDict
from dataclasses import dataclass
from enum import Enum

from services.bus.identity import same_clock

FUTURE_TOLERANCE_NS = 5_000_000
OFFSET_JUMP_NS = 5_000_000_000
DRIFT = 2e-4
PUBLISHERS_REMEMBERED = 16


class Judgement(Enum):
    """What becomes of a sample."""

    FRESH = "fresh"
    STALE = "stale"
    REPEATED = "repeated"
    FUTURE = "future"


@dataclass
class _Publisher:
    sequence: int
    fastest_transit_ns: int
    received_ns: int


class Freshness:
    """Judges the samples of one topic, publisher by publisher.

    Args:
        stale_after_ns: age at which a sample counts as lost; None where every message counts however late.
        own: the receiver's identity, by which it knows whose clock it shares.
    """

    def __init__(self, stale_after_ns: int | None, own: int) -> None:
        self._stale_after_ns = stale_after_ns
        self._own = own
        self._publishers: OrderedDict[int, _Publisher] = OrderedDict()

    def judge(self, publisher: int, sequence: int, stamp_ns: int, received_ns: int) -> Judgement:
        """Judge a sample and remember it where it is fresh."""
        transit = received_ns - stamp_ns
        comparable = same_clock(publisher, self._own)
        if comparable and transit < -FUTURE_TOLERANCE_NS:
            return Judgement.FUTURE
        known = self._publishers.get(publisher)
        if known is None:
            late = comparable and self._is_late(transit)
            if not late:
                self._remember(publisher, _Publisher(sequence, 0 if comparable else transit, received_ns))
            return Judgement.STALE if late else Judgement.FRESH
        if not comparable and transit < known.fastest_transit_ns - OFFSET_JUMP_NS:
            return Judgement.FUTURE
        if sequence <= known.sequence:
            return Judgement.REPEATED
        if not comparable:
            forgotten = known.fastest_transit_ns + int(DRIFT * (received_ns - known.received_ns))
            known.fastest_transit_ns = min(forgotten, transit)
            known.received_ns = received_ns
        if self._is_late(transit - known.fastest_transit_ns):
            return Judgement.STALE
        # Only a fresh sample counts the sender on: a late one with a made-up number must not silence its true sender.
        known.sequence = sequence
        return Judgement.FRESH

    def _is_late(self, age_ns: int) -> bool:
        return self._stale_after_ns is not None and age_ns > self._stale_after_ns

    def _remember(self, publisher: int, state: _Publisher) -> None:
        self._publishers[publisher] = state
        if len(self._publishers) > PUBLISHERS_REMEMBERED:
            self._publishers.popitem(last=False)
