"""How an arm slows down before it comes where it must not be: near itself, and where its joints run out of directions.

A margin m falls to nothing there. Within a zone before it the arm's way goes on more slowly, the more the nearer it is
and the faster it comes nearer:

    share = 1 - w(m) r / (c + r),    r = -dm/dt,

with w rising smoothly from 0 at the zone's edge to 1 at its end, so that at the end no speed of the hand makes the
margin shrink faster than c, and with nothing at all taken from a motion that leads away or along.
"""

from __future__ import annotations

from dataclasses import dataclass

from services.robot.easing import eased

TOLD = 0.9
"""Share of its pace below which it is worth saying that the arm is slow."""


@dataclass(frozen=True)
class Zone:
    """Before a place where the arm must not be.

    Attributes:
        end: the margin there.
        edge: the margin from which it slows down.
        creep: rate at which the margin may shrink at the end [1/s].
    """

    end: float
    edge: float
    creep: float

    def share(self, margin: float, approach: float) -> float:
        """Of its pace at which the arm may go on.

        Args:
            margin: now.
            approach: rate at which it would shrink at the arm's own pace [1/s]; negative where it grows.
        """
        if approach <= 0.0 or margin >= self.edge:
            return 1.0
        near = eased(min(1.0, (self.edge - margin) / (self.edge - self.end)))
        return 1.0 - near * approach / (self.creep + approach)


class Approach:
    """Follows one margin.

    Args:
        zone: before its end.
        period: of the control [s].
        margin: now.
    """

    def __init__(self, zone: Zone, period: float, margin: float) -> None:
        self._zone = zone
        self._period = period
        self.margin = margin

    def share(self, margin: float, paced: float) -> float:
        """Of its pace at which the arm may go on.

        Args:
            margin: now.
            paced: share of its pace at which it went on in the last period.
        """
        approach = (self.margin - margin) / (self._period * paced)
        self.margin = margin
        return self._zone.share(margin, approach)
