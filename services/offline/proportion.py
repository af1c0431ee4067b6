"""How often something succeeded, and how sure that is."""

from __future__ import annotations

import math
from typing import NamedTuple

_NORMAL = 1.959963984540054
"""Within so many standard deviations of its mean lie 95 % of a normal variable."""


class Proportion(NamedTuple):
    """Successes among independent trials.

    Attributes:
        successes: at most `trials`.
        trials: all of them.
    """

    successes: int
    trials: int

    @property
    def interval(self) -> tuple[float, float]:
        """The 95 % score interval of the probability (Wilson 1927); all of it where nothing was tried.

        It holds for few trials and for none or all succeeding, where p +- 1.96 sqrt(p (1 - p) / n) does not.
        """
        n, z = self.trials, _NORMAL
        if n == 0:
            return 0.0, 1.0
        p = self.successes / n
        middle = (p + z * z / (2.0 * n)) / (1.0 + z * z / n)
        half = z / (1.0 + z * z / n) * math.sqrt(p * (1.0 - p) / n + z * z / (4.0 * n * n))
        # At both ends one bound is exactly none or all; rounding must not pass it by.
        return (0.0 if p == 0.0 else middle - half), (1.0 if p == 1.0 else middle + half)

    def __str__(self) -> str:
        """As in "75.0 %, 95 % interval 30 to 95 %"."""
        if self.trials == 0:
            return "none was tried"
        low, high = (round(100.0 * bound) for bound in self.interval)
        return f"{100.0 * self.successes / self.trials:.1f} %, 95 % interval {low} to {high} %"
