"""What the gripper is told: it keeps that through every hold, stop, lost link and take-over, and drops nothing."""

from __future__ import annotations

from services.robot.recording import Openings


class Fingers:
    """Of one gripper.

    Args:
        wide_open: how far it opens [m]; 0 where there is none.
        measured: how far it is open now [m]: what it holds when the process begins it goes on holding.
    """

    def __init__(self, wide_open: float, measured: float) -> None:
        self.wide_open = wide_open
        self.measured = measured
        self.told = 0.0
        self.tell(measured)

    def tell(self, opening: float | None) -> None:
        """To open so far, as far as it can [m]; None for as it was told before."""
        if opening is not None:
            self.told = min(max(opening, 0.0), self.wide_open)

    @property
    def now(self) -> Openings:
        """What it was told beside what is measured."""
        return Openings(self.told, self.measured)
