"""The master's samples that count: of whoever holds the authority, and not too old by the clocks compared.

When a sample came is judged by the robot's own clock (`Watchdog`); how long it was on its way is known as well as the
round trips tell, and counts besides: what stood in a queue all the way comes regularly, and is old all the same.
"""

from __future__ import annotations

from collections.abc import Callable

from protocol.messages import MasterState
from protocol.topics import MASTER_STATE
from services.bus.bus import Bus
from services.bus.identity import same_clock
from services.bus.round_trips import RoundTrips
from services.bus.subscription import Received
from services.process.config import LONGEST_SILENCE_S
from services.robot.playout import Playout


class Samples:
    """Follows the master under the present authority.

    Args:
        bus: to hear it.

    Attributes:
        late: how many samples were dropped because they had been on their way for too long.
        newest_way_s: how long the newest sample that was heard had been on its way [s]; None where that is not known.
    """

    def __init__(self, bus: Bus) -> None:
        self.late = 0
        self.newest_way_s: float | None = None
        self._own = bus.identity
        self._master = bus.subscribe(MASTER_STATE)
        self._newest: Received[MasterState] | None = None
        self._sender = 0
        self._trips = RoundTrips()
        self._playout = Playout()

    @property
    def delay_s(self) -> float:
        """By how much later than the fastest could be a hand's motion is played out [s]."""
        return self._playout.delay_ns / 1e9

    @property
    def ahead_s(self) -> float | None:
        """By how much this clock is ahead of that of the commanding master's machine [s]; None where nobody knows."""
        if same_clock(self._sender, self._own):
            return 0.0
        fastest = self._trips.fastest
        return -fastest.offset_ns / 1e9 if fastest is not None else None

    def take(
        self, covers: Callable[[str, int, str], bool], let_go: Callable[[], None], now_ns: int
    ) -> Received[MasterState] | None:
        """What counts now, as the hand did it; samples of any other holder, epoch or person do not.

        Args:
            covers: whether what a process sends for a holder under an epoch counts now.
            let_go: called where a hand was off the master, however late that is heard.
            now_ns: the time [ns].
        """
        for received in self._master.take():
            if not covers(received.message.holder, received.message.epoch, received.message.process):
                continue
            self._hear(received)
            known_s = self.age_s(received, received.received_ns)
            self.newest_way_s = max(0.0, known_s) if known_s is not None else None
            way_s = self.newest_way_s or 0.0
            if not received.message.engaged:
                let_go()
            if way_s > LONGEST_SILENCE_S:
                self.late += 1
            else:
                self._newest = received
                if not same_clock(received.message.publisher, self._own):
                    self._playout.hear(received, round(1e9 * way_s))
        if (old := self._newest) is not None and not covers(old.message.holder, old.message.epoch, old.message.process):
            self._newest = None
        if self._newest is None:
            self._playout.clear()
            return None
        return self._playout.play(self._newest, now_ns)

    def way_s(self, received: Received[MasterState] | None) -> float:
        """How long a sample took to come [s]; 0 where that is not known."""
        return max(0.0, self.age_s(received, received.received_ns) or 0.0) if received is not None else 0.0

    def age_s(self, received: Received[MasterState], now_ns: int) -> float | None:
        """Since the master stamped a sample [s]; None where the clocks cannot be compared yet."""
        message = received.message
        if same_clock(message.publisher, self._own):
            return (now_ns - message.stamp_ns) / 1e9
        age_ns = self._trips.age_ns(message.stamp_ns, now_ns) if message.publisher == self._sender else None
        return age_ns / 1e9 if age_ns is not None else None

    def _hear(self, received: Received[MasterState]) -> None:
        message = received.message
        if message.publisher != self._sender:
            self._sender, self._trips = message.publisher, RoundTrips()
        if message.echoed_ns:
            self._trips.hear(message.echoed_ns, message.echo_held_ns, message.stamp_ns, received.received_ns)
