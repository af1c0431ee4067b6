"""What is held at the tab that has the seat, and whether it counts.

After a silence that was short a key that was down all the while counts again: its person never let go of it. It does so
with the second sample, since a page that stood still for a moment may say first what was held before. After any other
interruption everything that steers is let go first: a held key that was not heard meanwhile must neither count nor look
as if it did.
"""

from __future__ import annotations

from protocol.keys import STEERING
from protocol.messages import OperatorInput
from services.station.page.said import Held
from services.station.page.tab import DEAD_MAN_NS

SHORT_NS = 500_000_000
"""A longer silence is an interruption: a robot that has held for so long waits to be asked as well."""


class Grip:
    """Follows the samples of one tab after another.

    Attributes:
        held: as it was said last; None where that is too long ago to count.
        let_go: everything that steers has to be let go before anything counts.
        captured_ns: when the browser read it, by our clock [ns]; 0 where that is not known.
        drawn: age of the newest picture when the browser had drawn it [s]; negative where that is not known.
    """

    def __init__(self) -> None:
        self.held: Held | None
        self.let_go: bool
        self.captured_ns = 0
        self.drawn: float
        self._late: bool
        self._heard_ns: int
        self.sit(0)

    @property
    def late(self) -> bool:
        """What is held counts again as soon as it is heard as it should be."""
        return self._late and not self.let_go

    def sit(self, now_ns: int) -> None:
        """Another tab sits down, or nobody."""
        self.held, self.let_go, self.drawn = None, True, -1.0
        self._late, self._heard_ns = False, now_ns

    def expire(self, now_ns: int) -> None:
        """Time has passed."""
        silence_ns = now_ns - self._heard_ns
        if silence_ns > DEAD_MAN_NS:
            self.held, self._late = None, True
        if silence_ns > SHORT_NS:
            self.let_go = True

    def hear(self, message: Held, captured_ns: int, now_ns: int) -> bool:
        """A sample that came in time; whether keys or focus are others than before."""
        before, self.held = self.held, message
        self.captured_ns, self._heard_ns = captured_ns, now_ns
        self.drawn = -1.0 if message.picture_ms is None else message.picture_ms / 1e3
        self._late &= before is None
        if not (message.visible and message.focused):
            self.let_go = True
        elif STEERING.isdisjoint(message.keys):
            self.let_go = self._late = False
        return before is None or before.keys != message.keys or before.focused != message.focused

    def input(self, operator: str, *, present: bool) -> OperatorInput:
        """As it counts now.

        Args:
            operator: who is at the tab.
            present: the tab is alive.
        """
        if self.held is None or self.late or self.let_go:
            return OperatorInput(operator=operator, present=present, late=self.late, drawn=self.drawn)
        return OperatorInput(
            operator=operator,
            present=present,
            keys=self.held.keys,
            focused=True,
            controllers=self.held.controllers,
            yaw=self.held.yaw,
            captured_ns=self.captured_ns,
            drawn=self.drawn,
        )
