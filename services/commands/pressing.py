"""The emergency stop as somebody presses and releases it from afar: until the robot's own state shows it."""

from __future__ import annotations

from protocol import queries, topics
from protocol.messages import EmergencyStop, SafetyState
from services.bus.bus import Bus, Failed, Pending
from services.bus.identity import new_number
from services.process.exceptions import CommandFailed

ANSWER_S = 1.0


class Press:
    """Presses until the robot says that it has latched and that it was measured to stand.

    Args:
        bus: to the robot.
        operator: who presses.
    """

    def __init__(self, bus: Bus, operator: str) -> None:
        self._bus = bus
        self._safety = bus.subscribe(topics.SAFETY_STATE)
        self._pressed = EmergencyStop(pressed=True, by=operator, reason="retouch stop")

    def step(self, now_ns: int) -> str:
        """Press once more, where it is not confirmed; what is waited for, empty once it is."""
        safety = self._safety.fresh(now_ns)
        if safety is not None and safety.emergency_stop and safety.standing:
            return ""
        self._bus.publish(topics.EMERGENCY_STOP, self._pressed)
        if safety is None:
            return "it is not heard"
        return "it has latched, but it still moves" if safety.emergency_stop else "it has not latched"


class Release:
    """Asks for the release until there is an answer; a request whose answer was lost is the same one again.

    Attributes:
        was: what the robot said before, so that whoever releases knows what; None until it was heard.

    Args:
        bus: to the robot.
        operator: who releases.
    """

    def __init__(self, bus: Bus, operator: str) -> None:
        self.was: SafetyState | None = None
        self._bus = bus
        self._safety = bus.subscribe(topics.SAFETY_STATE)
        self._request = queries.ReleaseStop(operator, request=new_number())
        self._pending: Pending[queries.Accepted] | None = None

    def step(self, now_ns: int) -> str:
        """Ask, or look for the answer; what is waited for, empty once it is released.

        Raises:
            CommandFailed: the robot refused.
        """
        if self.was is None:
            self.was = self._safety.fresh(now_ns)
            if self.was is None:
                return "it is not heard"
        if self._pending is None:
            self._pending = self._bus.ask(queries.RELEASE_STOP, self._request, ANSWER_S)
        match self._pending.poll():
            case None:
                return "it has not answered"
            case Failed(reason):
                self._pending = None
                return reason
            case queries.Refused(reason):
                raise CommandFailed(f"the stop was not released: {reason}")
            case queries.Accepted():
                return ""


def story(was: SafetyState) -> str:
    """Who had pressed the stop that was released, when and why."""
    if not was.emergency_stop:
        return "no stop was latched"
    why = f" ({was.reason})" if was.reason else ""
    return f"{was.by} had pressed it at {was.at or 'an unknown time'}{why}"
