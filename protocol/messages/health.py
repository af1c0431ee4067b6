"""What a process says about itself: the class `health`."""

from __future__ import annotations

from typing import Annotated

import msgspec

from protocol.messages.values import Count, Message, Name, Real


class Figure(msgspec.Struct, frozen=True):
    """A measured number with its unit."""

    name: Name
    value: Real
    unit: Name


class TopicFigures(msgspec.Struct, frozen=True):
    """What a process saw on one topic in the last interval: rate [Hz], age and latency [s], drops by cause so far.

    A negative latency means that the clocks are not comparable.
    """

    topic: Name
    rate_hz: Real
    age: Real
    latency: Real
    malformed: Count = 0
    oversized: Count = 0
    wrong_version: Count = 0
    stale: Count = 0
    repeated: Count = 0
    future: Count = 0
    implausible: Count = 0
    misplaced: Count = 0
    crowded: Count = 0

    @property
    def drops(self) -> int:
        """All drops together."""
        undecoded = self.malformed + self.oversized + self.wrong_version + self.misplaced
        return undecoded + self.stale + self.repeated + self.future + self.implausible + self.crowded


class Heartbeat(Message, frozen=True, kw_only=True):
    """A process about itself, twice a second.

    Attributes:
        process: its name.
        pid: its process id.
        host: its machine.
        rate_hz: that it should step at.
        ticks: since the start.
        late_ticks: that began more than half a period late.
        period_p50: of the last interval [s].
        period_p99: of the last interval [s].
        step_p99: time that a step took, of the last interval [s].
        cpu_s: processor time since the start [s].
        memory: resident [byte].
        topics: what it receives.
        figures: what it measured besides.
        utc_ms: the time of day by its machine's clock, since 1970 [ms]; 0 where it is not told.
        software: which release of this software it runs; empty where it is not told.
    """

    process: Name
    pid: Count
    host: Name
    rate_hz: Real
    ticks: Count
    late_ticks: Count
    period_p50: Real
    period_p99: Real
    step_p99: Real
    cpu_s: Real
    memory: Count
    topics: Annotated[tuple[TopicFigures, ...], msgspec.Meta(max_length=64)] = ()
    figures: Annotated[tuple[Figure, ...], msgspec.Meta(max_length=64)] = ()
    utc_ms: Count = 0
    software: Name = ""


class Probe(Message, frozen=True, kw_only=True):
    """A message that is sent to be heard by its own sender, who learns of the way from it.

    Attributes:
        number: counts what was sent in one examination, from 0.
        padding: of no meaning: as large as the message is to be.
    """

    number: Count = 0
    padding: Annotated[bytes, msgspec.Meta(max_length=6_144)] = b""
