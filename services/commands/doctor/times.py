"""Clocks: how evenly a robot's samples come, and whether its machine's time of day is this one's.

The stamps of another machine's clock say how evenly it runs and sends, and whether it jumps; how far apart both clocks
are they do not say. Its time of day, which certificates go by, stands in the heartbeats, as well as the way is short.
"""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import pairwise
from statistics import quantiles

from protocol.topics import ROBOT_STATE
from services.bus.clocks import NEAR_NS
from services.bus.identity import same_clock
from services.certificates.authority import SKEW
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, look, ok, wrong
from services.commands.doctor.hearing import Beat, Sample

CLOCK = "clock"

FEWEST = 20
"""Samples from which anything is said."""

UNEVEN_MS = 50.0
"""Half of the silence at which a robot holds."""

SHARE = 0.9
"""Of the samples that its rate promises."""

APART_S = 2.0
"""Times of day that differ by more confuse whoever reads two logs."""


def check_clock(case: Case) -> Iterator[Finding]:
    """The robot's samples, then its machine's time of day."""
    assert case.speaker is not None
    robot = case.hearing.robots.get(case.configuration.name, {})
    yield from evenness(case.hearing.samples, case.speaker.identity)
    if "robot" in robot:
        yield time_of_day(robot["robot"], case.speaker.identity)


def evenness(samples: Sequence[Sample], own: int) -> Iterator[Finding]:
    """How evenly the samples were stamped and came.

    Args:
        samples: in the order in which they came.
        own: identity of this machine.
    """
    if len(samples) < FEWEST:
        told = f"only {len(samples)} of the robot's samples were heard"
        yield look(CLOCK, f"{told}: too few to say anything", "is its process busy? See 'retouch top'")
        return
    transits = [one.received_ns - one.stamp_ns for one in samples]
    jumps = [abs(after - before) for before, after in pairwise(transits)]
    if max(jumps) > NEAR_NS and _settled(transits):
        remedy = "a virtual machine that was moved, or one that slept? Until it stands still nobody can be sure"
        yield look(CLOCK, f"the robot's clock jumped by {max(jumps) / 1e9:.2f} s while it was listened to", remedy)
        return
    span_s = (samples[-1].stamp_ns - samples[0].stamp_ns) / 1e9
    rate_hz = (len(samples) - 1) / span_s if span_s > 0.0 else 0.0
    usual_ms, uneven_ms = _spread([transit / 1e6 for transit in transits])
    told = f"the robot's samples come {rate_hz:.0f} times a second, 49 of 50 within {uneven_ms:.1f} ms of the quickest"
    if same_clock(samples[0].publisher, own):
        told += f", {usual_ms:.1f} ms after they were stamped by this machine's own clock"
    if rate_hz < SHARE * ROBOT_STATE.rate_hz:
        yield look(CLOCK, told, f"{ROBOT_STATE.rate_hz:.0f} a second are due: is the way full, or a machine busy?")
    elif uneven_ms > UNEVEN_MS:
        yield look(CLOCK, told, "does the way lose packets, is it full, or a machine busy?")
    else:
        yield ok(CLOCK, told)


def _settled(transits: Sequence[int]) -> bool:
    """Whether the last samples came as evenly as the first, at another distance: no queue, but a clock."""
    first, last = transits[: FEWEST // 2], transits[-FEWEST // 2 :]
    return min(abs(a - b) for a in first for b in last) > NEAR_NS


def _spread(values: Sequence[float]) -> tuple[float, float]:
    """The middle one, and from the least to that which 98 of a hundred do not exceed."""
    cuts = quantiles(values, n=50, method="inclusive")
    return cuts[24], cuts[48] - min(values)


def time_of_day(robot: Beat, own: int) -> Finding:
    """The robot's machine's against this one's."""
    if same_clock(robot.message.publisher, own):
        return ok(CLOCK, "the robot runs on this machine: one clock")
    if not robot.message.utc_ms:
        return look(CLOCK, "the robot does not tell its time of day: its release is an older one")
    ahead_s = (robot.received_utc_ms - robot.message.utc_ms) / 1e3
    told = f"this machine's time of day is {abs(ahead_s):.1f} s {'ahead of' if ahead_s > 0.0 else 'behind'} the robot's"
    remedy = "let both ask a time server (NTP)"
    if abs(ahead_s) > SKEW.total_seconds():
        return wrong(CLOCK, f"{told}: certificates that were just made there are not valid here", remedy)
    if abs(ahead_s) > APART_S:
        return look(CLOCK, told, f"{remedy}: no age is judged by it, but logs and certificates are")
    return ok(CLOCK, f"{told}, the time on the way included; no age is judged by it")
