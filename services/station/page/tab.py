"""A browser tab as the desk knows it: who is there, and which of its messages come in time."""

from __future__ import annotations

from protocol import topics
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

    Each has clocks of its own, since no two browsers' compare: one by which states are late, one by which presses are.

    Args:
        hello: that it said.
        identity: of its person.
    """

    def __init__(self, hello: Hello, identity: Identity) -> None:
        self.hello = hello
        self.identity = identity
        self._states = Freshness(DEAD_MAN_NS, _OURS, topics.OPERATOR_INPUT.rate_hz)
        self._presses = Freshness(LATE_PRESS_NS, _OURS, topics.OPERATOR_INPUT.rate_hz)

    def has_sent_in_time(self, message: Held | Pressed, now_ns: int) -> bool:
        """Whether the message is new and no older than its kind may be."""
        sample = (_BROWSERS, message.sequence, round(message.stamp_ms * 1e6), now_ns)
        of_press = self._presses.judge(*sample)
        judgement = of_press if isinstance(message, Pressed) else self._states.judge(*sample)
        return judgement is Judgement.FRESH
