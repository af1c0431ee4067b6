"""The emergency stop of the page: said until the robot itself shows that it is latched and stands."""

from __future__ import annotations

from protocol import topics
from protocol.messages import EmergencyStop, SafetyState
from services.bus.bus import Bus
from services.bus.subscription import Subscription

PERIOD_NS = round(1e9 / topics.EMERGENCY_STOP.rate_hz)


class StopButton:
    """A pressed stop is repeated, through an outage too, until it is confirmed by what the robot says after the press.

    Args:
        bus: to say it on.
        safety: what the robot says of it.
        holder: the station's name.
    """

    def __init__(self, bus: Bus, safety: Subscription[SafetyState], holder: str) -> None:
        self._bus = bus
        self._safety = safety
        self._holder = holder
        self._message: EmergencyStop
        self._pressed_ns: int | None = None
        self._due_ns: int

    @property
    def unconfirmed(self) -> bool:
        """It was pressed, and the robot has not shown yet that it stands."""
        return self._pressed_ns is not None

    def press(self, now_ns: int, by: str) -> None:
        """Say it in this step and on, in the name of whoever pressed it."""
        self._message = EmergencyStop(pressed=True, by=by, reason=f"pressed at {self._holder}")
        self._pressed_ns = self._due_ns = now_ns

    def let_go(self, now_ns: int) -> None:
        """Whoever asks for the release of a latched stop presses no longer; what is not latched yet is said on."""
        safety = self._safety.fresh(now_ns)
        if safety is not None and safety.emergency_stop:
            self._pressed_ns = None

    def step(self, now_ns: int) -> None:
        """Say it where it is due, unless the robot stands."""
        heard = self._safety.latest()
        if self._pressed_ns is None:
            return
        if heard is not None and heard.received_ns > self._pressed_ns and _stands(heard.message):
            self._pressed_ns = None
        elif now_ns >= self._due_ns:
            self._due_ns = now_ns + PERIOD_NS
            self._bus.publish(topics.EMERGENCY_STOP, self._message)


def _stands(safety: SafetyState) -> bool:
    return safety.emergency_stop and safety.standing
