"""The way to the router and back, as control travels it: small samples a hundred times a second."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from itertools import pairwise
from statistics import quantiles

from protocol.messages import Probe
from protocol.topics import MASTER_STATE, PROBE
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, Verdict, look, ok, wrong
from services.process.config import LONGEST_SILENCE_S, RobotSection

WAY = "way"

SAMPLES = 200
"""In two seconds."""

RUN_UP = 100
"""Samples that do not count before: until then it is decided whether they come as datagrams."""

PADDING = bytes(160)
"""As large as a master's state is."""

LAST_S = 0.5
"""The last ones are waited for so long, and five trips."""

HOLD_S = RobotSection().hold_after_s
"""After so long without a sample a robot holds."""

LATE_NS = MASTER_STATE.stale_after_ns or 0
FELT_S = 0.1
_BUSY = "this computer is too busy to say more of the way"
_LOOPBACK = "nothing lies between but this computer: is it busy, or what listens on it?"
"""What to do where no cable is at fault."""

LOST_LOOK = 0.02
"""Of the samples: beyond it the network is poor, though each next one makes up for it."""


@dataclass(frozen=True)
class Crossing:
    """What became of samples that were sent to the router, and came back.

    Attributes:
        sent_ns: when each was sent.
        came: when each that came back was sent, and when it came [ns].
    """

    sent_ns: Sequence[int]
    came: Sequence[tuple[int, int]]

    @property
    def lost(self) -> int:
        """How many did not come in time."""
        return len(self.sent_ns) - len(self.in_time)

    @property
    def late(self) -> int:
        """Of these, how many came all the same, later than counts."""
        return len(self.came) - len(self.in_time)

    @cached_property
    def in_time(self) -> list[tuple[int, int]]:
        """Those that a robot would count: it judges by the fastest, for it does not know how long the way is."""
        fastest_ns = min((came - sent for sent, came in self.came), default=0)
        return [(sent, came) for sent, came in self.came if came - sent - fastest_ns <= LATE_NS]

    @property
    def trips_s(self) -> tuple[float, float]:
        """The middle trip, and that which one of fifty exceeds [s]."""
        cuts = quantiles([(came - sent) / 1e9 for sent, came in self.in_time], n=50, method="inclusive")
        return cuts[24], cuts[48]

    @property
    def silence_s(self) -> float:
        """The longest that nothing came, from when the first was due until the last was [s]."""
        fastest_ns = min(came - sent for sent, came in self.in_time)
        due_ns = (self.sent_ns[0] + fastest_ns, self.sent_ns[-1] + fastest_ns)
        return _longest_gap_s([*due_ns, *(came for _, came in self.in_time)])

    @property
    def pause_s(self) -> float:
        """The longest that nothing was sent [s]."""
        return _longest_gap_s(self.sent_ns)


def _longest_gap_s(times_ns: Sequence[int]) -> float:
    return max((after - before for before, after in pairwise(sorted(times_ns))), default=0) / 1e9


def check_way(case: Case) -> Iterator[Finding]:
    """Send, and judge what came of it."""
    crossing = _crossed(case)
    load = case.load()
    is_busy = load is not None and load.is_too_much
    yield judged(crossing, is_busy=is_busy, is_loopback=case.endpoint.is_loopback)


def _crossed(case: Case) -> Crossing:
    assert case.speaker is not None
    assert case.heard is not None
    heard, own = case.heard, case.speaker.identity
    period_ns = round(1e9 / PROBE.rate_hz)
    due_ns = case.clock.now_ns()
    sent_ns: list[int] = []
    for number in range(-RUN_UP, SAMPLES):
        case.clock.sleep_until(due_ns, case.stop)
        case.wait(0.0)
        sent_ns.append(case.clock.now_ns())
        case.speaker.publish(PROBE, Probe(number=RUN_UP + number, padding=PADDING))
        due_ns += period_ns
    case.wait(LAST_S + 5.0 * (case.trip_s or 0.0))
    came = [
        (one.message.stamp_ns, one.received_ns)
        for one in heard.take()
        if one.message.publisher == own and one.message.stamp_ns >= sent_ns[RUN_UP]
    ]
    return Crossing(sent_ns[RUN_UP:], came)


def judged(crossing: Crossing, *, is_busy: bool = False, is_loopback: bool = False) -> Finding:
    """Whether a robot can be led this way; it is longer than the way of a command by the half that leads back.

    Args:
        crossing: what became of the samples.
        is_busy: this computer has more to do than it can, which says nothing of the way.
        is_loopback: there is nothing else on it.
    """
    own = _BUSY if is_busy else _LOOPBACK if is_loopback else ""
    if len(crossing.in_time) < 2:
        told = f"of {len(crossing.sent_ns)} small samples none came back in time"
        return wrong(WAY, told, own or "is the link cut, or full?")
    usual_s, most_s = crossing.trips_s
    lost = f"{crossing.lost} of {len(crossing.sent_ns)} lost" if crossing.lost else "none lost"
    late = f" ({crossing.late} too late)" if crossing.late else ""
    told = (
        f"to the router and back in {1e3 * usual_s:.1f} ms, 49 of 50 within {1e3 * most_s:.1f} ms; {lost}"
        f"{late}; at most {1e3 * crossing.silence_s:.0f} ms of silence"
    )
    if crossing.pause_s > HOLD_S / 2.0:
        return look(
            WAY, f"{told}; this machine itself paused for {1e3 * crossing.pause_s:.0f} ms", "it is busy: with what?"
        )
    finding = _of_the_way(crossing, told)
    if finding.verdict is Verdict.OK or not own:
        return finding
    return look(WAY, told, own) if is_busy else replace(finding, remedy=own)


def _of_the_way(crossing: Crossing, told: str) -> Finding:
    usual_s, most_s = crossing.trips_s
    if crossing.silence_s > HOLD_S:
        return wrong(
            WAY, told, f"beyond {1e3 * HOLD_S:.0f} ms a robot holds: a cable, another access point, less traffic?"
        )
    if most_s > 2.0 * LONGEST_SILENCE_S:
        limit = f"what a hand did more than {1e3 * LONGEST_SILENCE_S:.0f} ms ago moves nothing"
        return wrong(WAY, told, f"{limit}: a nearer way, or less traffic")
    if usual_s > FELT_S or crossing.lost > LOST_LOOK * len(crossing.sent_ns):
        return look(WAY, told, "it can be led, and the hand feels it: a cable, a nearer way?")
    return ok(WAY, f"{told}: enough for control")
