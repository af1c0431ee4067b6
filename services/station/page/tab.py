"""A browser tab as the desk knows it: who is there, and which of its messages come in time."""

from __future__ import annotations

from protocol import topics
from services.bus.clocks import Clocks
from services.bus.freshness import Freshness, Judgement
from services.station.page.identity import Identity
from services.station.page.said import Held, Hello, Pressed

DEAD_MAN_NS = 150_000_000
"""Age at which the input state counts as zero."""

LATE_PRESS_NS = 1_000_000_000
"""Age at which a press is dropped: what was asked for a moment ago may be wrong by now."""

_OURS, _BROWSERS = 0, 1 << 47
"""Identities on two machines: a browser's clock is not ours."""


class Tab:
    """A tab that said who it is.

    Each has a clock of its own, since no two browsers' compare: what comes fifty times a second tells how it goes, and
    presses are judged by it too.

    Args:
        hello: that it said.
        identity: of its person.
    """

    def __init__(self, hello: Hello, identity: Identity) -> None:
        self.hello = hello
        self.identity = identity
        clock, rate_hz = Clocks(_OURS), topics.OPERATOR_INPUT.rate_hz
        self._states = Freshness(DEAD_MAN_NS, _OURS, rate_hz, clock)
        self._presses = Freshness(LATE_PRESS_NS, _OURS, rate_hz, clock)

    def captured_ns(self, message: Held, now_ns: int) -> int:
        """When the browser read what it says, by our clock, as well as round trips tell [ns]; 0 where they do not yet.

        Args:
            message: the newest, which `has_sent_in_time`.
            now_ns: when it came [ns].
        """
        if message.way_ms is None:
            return 0
        return max(0, now_ns - max(0, self._states.age_ns) - round(1e6 * (message.way_ms + message.waited_ms)))

    def has_sent_in_time(self, message: Held | Pressed, now_ns: int) -> bool:
        """Whether the message is new and no older than its kind may be.

        A press that was faster on its way than any state before it is not late, whatever else it says of the clock.
        """
        sample = (_BROWSERS, message.sequence, round(message.stamp_ms * 1e6), now_ns)
        if isinstance(message, Pressed):
            return self._presses.judge(*sample) in (Judgement.FRESH, Judgement.FUTURE)
        return self._states.judge(*sample) is Judgement.FRESH
