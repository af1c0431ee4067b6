"""How far the arm is behind what it was told, in time: from how fast it goes and by how much it is behind.

Where the reference moves with velocity v and the arm is measured e behind it, it is e v / |v|^2 behind in time; the
control period in which a command acts comes before that. Standing tells nothing.
"""

from __future__ import annotations

from collections import deque
from statistics import median

import numpy as np
from numpy.typing import NDArray

Array = NDArray[np.float64]

KEPT = 50
"""Periods: the motion of the last half second."""

FEWEST = 10

SLOWEST = 0.01
"""Where the reference moves slower, noise tells more than the motion [m/s]."""


LONGEST_S = 1.0
"""An arm that is farther behind is held by something: how long it will be there nobody knows [s]."""


class Following:
    """One arm's.

    Args:
        period_s: of the control [s].
    """

    def __init__(self, period_s: float) -> None:
        self._period_s = period_s
        self._before: Array | None = None
        self._lags: deque[float] = deque(maxlen=KEPT)

    def see(self, reference: Array, measured: Array) -> None:
        """A control period has ended.

        Args:
            reference: to which the arm was told to come in it, shape (3,) [m].
            measured: where it was at its end, shape (3,) [m].
        """
        before, self._before = self._before, reference
        if before is None:
            return
        velocity = (reference - before) / self._period_s
        speed = float(np.linalg.norm(velocity))
        if speed >= SLOWEST:
            self._lags.append(float((reference - measured) @ velocity) / speed**2)

    def rest(self) -> None:
        """The arm stands, or does not do what it was told: what it did before is another motion's."""
        self._before = None
        self._lags.clear()

    @property
    def lag_s(self) -> float | None:
        """From when the arm was handed a command until it was measured to be there [s]; None where nobody knows."""
        if len(self._lags) < FEWEST:
            return None
        lag_s = max(0.0, self._period_s + median(self._lags))
        return lag_s if lag_s <= LONGEST_S else None
