"""How fast the motion goes: the rate at which the prediction's time passes, changed without a jerk."""

from __future__ import annotations

import math

FASTEST_PACE = 2.0
"""The greatest rate, forward and back."""

SLEW = 4.0
"""By how much the rate changes at most [1/s]: a motion comes to rest within a quarter of a second."""


class Pace:
    """Rate 1 is the prediction's own, 0 a pause; a negative one goes back along the motion that was executed.

    Args:
        period: of the control [s].
    """

    def __init__(self, period: float) -> None:
        self.asked = 1.0
        self.rate = 1.0
        self._until: float | None = None
        self._slew = SLEW * period

    def ask(self, rate: float, until: float | None = None) -> None:
        """Go on at another rate.

        Args:
            rate: from -`FASTEST_PACE` to `FASTEST_PACE`.
            until: the time at which to pause [control periods]; None for none. One that lies the other way pauses now.
        """
        self.asked, self._until = rate, until

    def step(self, now: float) -> float:
        """By how much the prediction's time is to pass in the next control period [control periods].

        Towards the time at which it pauses the rate falls as it rises, so that it comes to rest exactly there.

        Args:
            now: the prediction's time [control periods].
        """
        if self._until is not None and (self._until - now) * self.asked <= 0.0:
            self.ask(0.0)
        change = self.asked - self.rate
        self.rate += math.copysign(min(abs(change), self._slew), change)
        if self._until is None:
            return self.rate
        left = self._until - now
        if left * self.rate > 0.0:
            self.rate = math.copysign(min(abs(self.rate), self.stopping(abs(left))), left)
        return self.rate

    def stopping(self, left: float) -> float:
        """The greatest rate from which the time that is left suffices to come to rest [control periods].

        Rates v, v - a, v - 2 a and so on add up to it.
        """
        braking = 0.5 * self._slew * (math.sqrt(1.0 + 8.0 * left / self._slew) - 1.0)
        return min(left, braking)
