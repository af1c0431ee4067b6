"""How a motion comes to rest before a hold and goes on after it: as what share of its pace its time passes.

A reference that stops or starts between two control periods asks an arm for an acceleration that it does not have, and
shakes whatever it carries. Where a silence becomes a hold the motion slows down while the rest of what is tolerated
runs out, so that it stands when the hold begins and not a period later; from rest its time goes on little by little.
Time alone is scaled: where the motion leads stays what it was. The operator's correction slows down likewise, and then
follows the hand from rest as it always does.

Between rest and its own pace a motion's speed is a cubic in time: of all that begin and end without an acceleration it
has the least jerk in the mean square.
"""

from __future__ import annotations

from services.robot.pace import SLEW

EASE_S = 1.0 / SLEW
"""From rest to its own pace: as long as a pause takes to be left [s]."""


class Easing:
    """Of one motion.

    Args:
        period: of the control [s].
    """

    def __init__(self, period: float) -> None:
        self._step = period / EASE_S
        self._gone = 1.0

    def rest(self) -> None:
        """The motion stands in the middle of its way."""
        self._gone = 0.0

    def begin(self) -> None:
        """What begins now begins from rest by itself."""
        self._gone = 1.0

    def share(self, leeway: float) -> float:
        """Of its pace, in the next control period.

        Args:
            leeway: see `Watchdog.leeway`.
        """
        self._gone = min(1.0, self._gone + self._step, leeway)
        return eased(self._gone)


def eased(gone: float) -> float:
    """Share of the speed after a share of the time from rest to it."""
    return gone**2 * (3.0 - 2.0 * gone)
