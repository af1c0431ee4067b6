"""How long what a hand does at the page takes until the first sample that follows it: measured where it changes."""

from __future__ import annotations

from collections import deque
from statistics import median

from protocol.messages import Controller, Figure, OperatorInput
from services.bus.identity import same_clock
from services.bus.stages import Stages

KEPT = 256

LONGEST_S = 1.0
"""What is older was not waited for: the device did nothing meanwhile."""

_Held = tuple[tuple[str, ...], tuple[Controller, ...]]


class Capture:
    """Of one master.

    Args:
        own: identity of this process.

    Attributes:
        newest_s: of the newest change [s]; negative where it is not known.
    """

    def __init__(self, own: int) -> None:
        self.newest_s = -1.0
        self._own = own
        self._held: _Held | None = None
        self._all: deque[float] = deque(maxlen=KEPT)

    def sampled(self, operator: OperatorInput | None, now_ns: int) -> None:
        """A sample is made of what is held.

        Args:
            operator: what is held at the page; None where nothing is heard of it.
            now_ns: the time of the sample [ns].
        """
        before, self._held = self._held, None if operator is None else (operator.keys, operator.controllers)
        if operator is None or before is None or before == self._held:
            return
        self.newest_s = -1.0
        if operator.captured_ns and same_clock(operator.publisher, self._own):
            took_s = (now_ns - operator.captured_ns) / 1e9
            if 0.0 <= took_s <= LONGEST_S:
                self.newest_s = took_s
                self._all.append(took_s)

    def take_figures(self) -> tuple[Figure, ...]:
        """The usual one since the last call, where it is known."""
        known = Stages(capture=median(self._all) if self._all else None)
        self._all.clear()
        return known.figures()
