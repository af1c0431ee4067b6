"""Which samples count: late, future-stamped, out-of-order and repeated ones do not.

Age is judged by the receiver's clock, see `Clocks`. A sample is newer than another of its publisher's where its number
or its stamp is higher: a number or a stamp that somebody made up cannot outrun the true sender, whose next sample is
stamped later, or numbered higher. Who has been heard is remembered by process and for as long as its samples
could be replayed; publishers that somebody invents find no room rather than take the place of those that are there.
"""

from __future__ import annotations

from enum import Enum
from typing import NamedTuple

from services.bus.clocks import NEAR_NS, Clocks

FUTURE_TOLERANCE_NS = 5_000_000
"""Two processes of a machine read the same clock, but not at the same moment."""

FASTEST = 10
"""Times the topic's rate at which nobody publishes."""

AT_ONCE = 100_000
"""Messages that a sender may have sent however short it has been there."""

EVENTS_REMEMBERED_NS = 60_000_000_000
"""What counts however late it is may be repeated after this."""

INCARNATIONS = 16
PROCESSES = 256


class Judgement(Enum):
    """What becomes of a sample."""

    FRESH = "fresh"
    STALE = "stale"
    REPEATED = "repeated"
    FUTURE = "future"
    IMPLAUSIBLE = "implausible"


class _Newest(NamedTuple):
    """Of one publisher."""

    sequence: int
    stamp_ns: int
    received_ns: int

    def outdates(self, sequence: int, stamp_ns: int) -> bool:
        """It is the same sample, or one from before."""
        before = sequence < self.sequence and stamp_ns <= self.stamp_ns
        return before or sequence == self.sequence


class Freshness:
    """Judges the samples of one topic, publisher by publisher.

    Args:
        stale_after_ns: age at which a sample counts as lost; None where every message counts however late.
        own: the receiver's identity, by which it knows whose clock it shares.
        rate_hz: of the topic, by which numbers are told that nobody can have come to.
        clocks: of the machines, where several topics are judged by the same ones.

    Attributes:
        age_ns: of the sample that was judged last [ns]; of another machine's above that of its fastest.
    """

    def __init__(self, stale_after_ns: int | None, own: int, rate_hz: float, clocks: Clocks | None = None) -> None:
        self._stale_after_ns = stale_after_ns
        self._remembered_ns = EVENTS_REMEMBERED_NS if stale_after_ns is None else stale_after_ns
        self._most_a_ns = FASTEST * rate_hz / 1e9
        self._clocks = clocks or Clocks(own)
        self.age_ns = 0
        self._processes: dict[str, dict[int, _Newest]] = {}

    def judge(self, publisher: int, sequence: int, stamp_ns: int, received_ns: int, process: str = "") -> Judgement:
        """Judge a sample and remember it where it is fresh.

        Args:
            publisher: the sender's incarnation.
            sequence: its number of the sample.
            stamp_ns: its clock when it sent the sample [ns].
            received_ns: our clock now [ns].
            process: the sender's name.
        """
        incarnations = self._processes.get(process)
        newest = incarnations.get(publisher) if incarnations is not None else None
        if newest is not None and newest.outdates(sequence, stamp_ns):
            return Judgement.REPEATED
        # What is repeated says nothing about clocks.
        age = self.age_ns = self._clocks.age_ns(publisher, stamp_ns, received_ns)
        if age < -FUTURE_TOLERANCE_NS and (age < -NEAR_NS or self._clocks.shared_with(publisher)):
            return Judgement.FUTURE
        if self._stale_after_ns is not None and age > self._stale_after_ns:
            return Judgement.STALE
        if sequence > AT_ONCE + self._most_a_ns * stamp_ns:
            return Judgement.IMPLAUSIBLE
        return self._remember(process, publisher, _Newest(sequence, stamp_ns, received_ns))

    def _remember(self, process: str, publisher: int, newest: _Newest) -> Judgement:
        incarnations = self._processes.get(process)
        if incarnations is None:
            if len(self._processes) >= PROCESSES:
                self._forget_processes(newest.received_ns)
            if len(self._processes) >= PROCESSES:
                return Judgement.IMPLAUSIBLE
            incarnations = self._processes[process] = {}
        if publisher not in incarnations and len(incarnations) >= INCARNATIONS:
            self._forget(incarnations, newest.received_ns)
            if len(incarnations) >= INCARNATIONS:
                return Judgement.IMPLAUSIBLE
        incarnations[publisher] = newest
        return Judgement.FRESH

    def _forget(self, incarnations: dict[int, _Newest], now_ns: int) -> None:
        """Whose samples would be stale by now."""
        for publisher, newest in list(incarnations.items()):
            if now_ns - newest.received_ns > self._remembered_ns:
                del incarnations[publisher]

    def _forget_processes(self, now_ns: int) -> None:
        for process, incarnations in list(self._processes.items()):
            self._forget(incarnations, now_ns)
            if not incarnations:
                del self._processes[process]
