"""Another machine's clock against ours, by round trips: unlike the time of coming alone, they tell the time on the way.

A sample that says which of ours had come last before it, and how long before, has made a round trip with it. Half of
the fastest one is the way, give or take that half; the offset is known as well as that.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass

KEPT = 64
SPAN_NS = 100_000_000
"""Of the trips within each of these the fastest counts: a queue that stands for seconds is not taken for the way."""

ROUNDING_NS = 2_000_000
"""Clocks that drift apart, and stamps that are a little late: less tells no jump."""


@dataclass(frozen=True)
class Trip:
    """One round trip.

    Attributes:
        offset_ns: of the other clock against ours, as far as it is known from this trip alone [ns].
        there_and_back_ns: how long it took [ns].
    """

    offset_ns: int
    there_and_back_ns: int

    def agrees(self, other: Trip) -> bool:
        """Whether both can have been made with the same two clocks."""
        apart = abs(self.offset_ns - other.offset_ns)
        return apart <= (self.there_and_back_ns + other.there_and_back_ns) // 2 + ROUNDING_NS


class RoundTrips:
    """With one machine, the fastest of the newest ones."""

    def __init__(self) -> None:
        self._spans: deque[tuple[int, Trip]] = deque(maxlen=KEPT)

    @property
    def fastest(self) -> Trip | None:
        """Of those remembered; None before the first."""
        return min((trip for _, trip in self._spans), key=lambda trip: trip.there_and_back_ns, default=None)

    def hear(self, echoed_ns: int, held_ns: int, stamp_ns: int, received_ns: int) -> None:
        """A sample that echoes one of ours has come.

        Args:
            echoed_ns: our stamp on the newest sample that the other had heard [ns].
            held_ns: how long before its own it had heard that [ns].
            stamp_ns: its clock when it sent its own [ns].
            received_ns: our clock now [ns].
        """
        there_and_back = received_ns - echoed_ns - held_ns
        if there_and_back < 0 or held_ns < 0:
            return  # nobody answers before being asked
        trip = Trip((stamp_ns - held_ns - echoed_ns + stamp_ns - received_ns) // 2, there_and_back)
        if not all(trip.agrees(other) for _, other in self._spans):
            self._spans.clear()  # a clock has jumped, or its machine slept
        span = received_ns // SPAN_NS
        if self._spans and self._spans[-1][0] == span:
            _, other = self._spans.pop()
            trip = min(trip, other, key=lambda one: one.there_and_back_ns)
        self._spans.append((span, trip))

    def age_ns(self, stamp_ns: int, now_ns: int) -> int | None:
        """How long ago the other stamped something, as well as it is known [ns]; None before the first trip."""
        fastest = self.fastest
        return now_ns - stamp_ns + fastest.offset_ns if fastest is not None else None
