"""The clocks of other machines, compared with this one's by what comes from them.

Of a sample from another machine only its transit is known: receipt by our clock less stamp by theirs, that is the
time on the way plus the unknown offset of the clocks. Its age is the transit above the fastest that this machine's
samples were seen to take, whichever process and topic they belong to, since all processes of a machine share its clock.

What moves that baseline, and what must not:
- Clocks drift apart, so the fastest transit is forgotten at `DRIFT_PPM`, faster than any clock drifts.
- Several of the newest samples must have been as fast before it falls: one forged stamp moves nothing.
- Where all samples of a machine are early or late by more than `NEAR_NS` for `RELEARN_NS`, the clocks have jumped (a
  machine slept whose clock stands still meanwhile, a virtual one was moved): the offset is learnt anew from these.
- A queue that fills on the way makes samples late little by little; then they are late, for as long as it stands. Only
  where they are late from one sample to the next can it have been a clock.
"""

from __future__ import annotations

import threading
from collections import deque
from dataclasses import dataclass

from services.bus.identity import machine

DRIFT_PPM = 600
"""More than the 500 by which a clock is slewed at most."""

NEAR_NS = 100_000_000
"""Samples on the way vary by less than this where neither a clock jumped nor a queue stands."""

RELEARN_NS = 1_000_000_000
"""A machine whose samples all were early or late for so long is judged by them from then on."""

LONG_NS = 100_000_000_000
"""After so long a silence the clocks may have drifted as far apart as samples vary on the way."""

RECENT = 32
AGREEING = 3
"""So many of the recent samples have to have been as fast as the new baseline."""


@dataclass
class _Away:
    """Samples that all were early, or all late, and alike."""

    since_ns: int
    fastest_ns: int
    early: bool
    jumped: bool


class Comparison:
    """One machine's clock against ours.

    Args:
        transit_ns: of the first sample [ns].
        received_ns: of the first sample, by our clock [ns].
    """

    def __init__(self, transit_ns: int, received_ns: int) -> None:
        self._received_ns = received_ns
        self._previous_ns = transit_ns
        self._recent: deque[int] = deque(maxlen=RECENT)
        self._away: _Away | None = None
        self._begin(transit_ns)

    def age_ns(self, transit_ns: int, received_ns: int) -> int:
        """The sample's age, and whatever is to be learnt from it; far below zero for a stamp from the future."""
        silence = max(0, received_ns - self._received_ns)
        drifted = silence * DRIFT_PPM // 1_000_000
        self._fastest_ns += drifted
        self._received_ns = received_ns
        excess = transit_ns - self._fastest_ns
        if silence > LONG_NS and -NEAR_NS - 2 * drifted <= excess < 0:
            self._begin(transit_ns)
        elif -NEAR_NS <= excess <= NEAR_NS:
            self._away = None
            self._approach(transit_ns)
        else:
            self._follow(transit_ns, received_ns, excess)
        self._previous_ns = transit_ns
        return transit_ns - self._fastest_ns

    def _begin(self, fastest_ns: int) -> None:
        self._fastest_ns = fastest_ns
        self._recent.clear()
        self._recent.append(fastest_ns)
        self._away = None

    def _approach(self, transit_ns: int) -> None:
        self._recent.append(transit_ns)
        if transit_ns < self._fastest_ns and len(self._recent) >= AGREEING:
            self._fastest_ns = min(self._fastest_ns, sorted(self._recent)[AGREEING - 1])

    def _follow(self, transit_ns: int, received_ns: int, excess: int) -> None:
        away, early = self._away, excess < 0
        if away is None or away.early is not early or abs(transit_ns - away.fastest_ns) > NEAR_NS:
            at_once = 2 * abs(transit_ns - self._previous_ns) >= abs(excess)
            falling = away is not None and away.jumped and transit_ns < away.fastest_ns
            self._away = _Away(received_ns, transit_ns, early, jumped=early or at_once or falling)
            return
        away.fastest_ns = min(away.fastest_ns, transit_ns)
        if away.jumped and received_ns - away.since_ns >= RELEARN_NS:
            self._begin(away.fastest_ns)


class Clocks:
    """Tells how old samples are, whichever machine they come from. Safe to use from several threads.

    Args:
        own: the receiver's identity, by which it knows whose clock it shares.
    """

    def __init__(self, own: int) -> None:
        self._own = machine(own)
        # At most as many as there are numbers for machines; none is forgotten to make room for invented ones.
        self._comparisons: dict[int, Comparison] = {}
        self._lock = threading.Lock()

    def shared_with(self, publisher: int) -> bool:
        """Whether the publisher's stamps are of our own clock."""
        return machine(publisher) == self._own

    def age_ns(self, publisher: int, stamp_ns: int, received_ns: int) -> int:
        """Age of a sample that came now [ns]; of the first one of a machine nothing is known, it is 0."""
        transit = received_ns - stamp_ns
        other = machine(publisher)
        if other == self._own:
            return transit
        with self._lock:
            comparison = self._comparisons.get(other)
            if comparison is None:
                self._comparisons[other] = Comparison(transit, received_ns)
                return 0
            return comparison.age_ns(transit, received_ns)
