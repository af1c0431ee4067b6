"""Moves the control periods to where the operator's samples come, so that none waits for most of a period."""

from __future__ import annotations

MARGIN_NS = 2_500_000
"""How long before a control period a sample should come: more than most of its jitter."""

DEADBAND_NS = 300_000
GAIN = 0.05
LARGEST_NS = 100_000
"""A period is stretched or shortened by one per cent at most: the arm does not notice."""


class Synchronisation:
    """A phase-locked loop between the master's samples and the control periods.

    Two loops of the same rate meet at a random phase: a sample waits half a period on average. Only receipt times are
    used, so it works for a master on another machine as well.

    Args:
        period_ns: of the control.
    """

    def __init__(self, period_ns: int) -> None:
        self._period_ns = period_ns
        self._slew_ns = 0

    def heard(self, started_ns: int, received_ns: int) -> None:
        """A control period began with a sample that had come before it; one that came long before says nothing.

        Args:
            started_ns: when the period began.
            received_ns: when the sample came.
        """
        if started_ns - received_ns >= self._period_ns:
            return
        early = (started_ns - received_ns - MARGIN_NS + self._period_ns // 2) % self._period_ns - self._period_ns // 2
        wanted = 0 if abs(early) < DEADBAND_NS else -round(GAIN * early)
        self._slew_ns = max(-LARGEST_NS, min(LARGEST_NS, wanted))

    def take_slew_ns(self) -> int:
        """By how much the next period is to begin later (or earlier, where negative)."""
        slew, self._slew_ns = self._slew_ns, 0
        return slew
