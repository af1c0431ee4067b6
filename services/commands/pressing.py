"""What somebody presses from afar, until the robot's own word shows it: the stop, its release, who commands no more."""

from __future__ import annotations

from typing import Generic, TypeVar

import msgspec

from protocol import queries, topics
from protocol.messages import AuthorityState, EmergencyStop, SafetyState
from protocol.queries import Accepted, Query, Refused
from services.bus.bus import Bus, Failed, Pending
from services.bus.identity import new_number
from services.process.exceptions import CommandFailed

Req = TypeVar("Req", bound=msgspec.Struct)

ANSWER_S = 1.0

LOOK_NS = 1_500_000_000
"""Every robot that is there has been heard by then."""


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

    @property
    def heard(self) -> bool:
        """The robot has said something since."""
        return self._safety.latest() is not None

    def step(self, now_ns: int) -> str:
        """Press once more, where it is not confirmed; what is waited for, empty once it is."""
        safety = self._safety.fresh(now_ns)
        if safety is not None and safety.emergency_stop and safety.standing:
            return ""
        self._bus.publish(topics.EMERGENCY_STOP, self._pressed)
        if safety is None:
            return "it is not heard"
        return "it has latched, but it still moves" if safety.emergency_stop else "it has not latched"


class PressAll:
    """Presses the stop of every robot that is heard on the network, until each says that it stands.

    Attributes:
        stopped: robots that said so.

    Args:
        bus: to one of them, which may be there or not.
        robot: its name.
        operator: who presses.
    """

    def __init__(self, bus: Bus, robot: str, operator: str) -> None:
        self.stopped: frozenset[str] = frozenset()
        self._bus = bus
        self._own = robot
        self._operator = operator
        self._presses = {robot: Press(bus, operator)}
        self._began_ns: int | None = None

    def step(self, now_ns: int) -> str:
        """Press where it is not confirmed; what is waited for, empty once every robot stands."""
        self._began_ns = now_ns if self._began_ns is None else self._began_ns
        for robot in self._bus.neighbours().keys() - self._presses.keys():
            self._presses[robot] = Press(self._bus.neighbour(robot), self._operator)
        waits_for = {robot: press.step(now_ns) for robot, press in sorted(self._presses.items())}
        if not self._presses[self._own].heard:  # nobody said that it is there
            del waits_for[self._own]
        self.stopped = frozenset(robot for robot, why in waits_for.items() if not why)
        if not waits_for:
            return "no robot is heard"
        if now_ns - self._began_ns < LOOK_NS:
            return "others may be there"
        return "; ".join(f"{robot}: {why}" for robot, why in waits_for.items() if why)


class _Request(Generic[Req]):
    """Asks for a change until there is an answer; a request whose answer was lost is the same one again.

    Args:
        bus: to the robot.
        query: to ask.
        request: with a number of its own.
        not_done: what a refusal means.
    """

    def __init__(self, bus: Bus, query: Query[Req, Accepted], request: Req, not_done: str) -> None:
        self._bus = bus
        self._query = query
        self._change = request
        self._not_done = not_done
        self._pending: Pending[Accepted] | None = None

    def step(self) -> str:
        """Ask, or look for the answer; what is waited for, empty once it is done.

        Raises:
            CommandFailed: the robot refused.
        """
        if self._pending is None:
            self._pending = self._bus.ask(self._query, self._change, ANSWER_S)
        match self._pending.poll():
            case None:
                return "it has not answered"
            case Failed(reason):
                self._pending = None
                return reason
            case Refused(reason):
                raise CommandFailed(f"{self._not_done}: {reason}")
            case Accepted():
                return ""


class Release:
    """Asks for the release of the stop until there is an answer.

    Attributes:
        was: what the robot said before, so that whoever releases knows what; None until it was heard.

    Args:
        bus: to the robot.
        operator: who releases.
    """

    def __init__(self, bus: Bus, operator: str) -> None:
        self.was: SafetyState | None = None
        self._safety = bus.subscribe(topics.SAFETY_STATE)
        request = queries.ReleaseStop(operator, request=new_number())
        self._request = _Request(bus, queries.RELEASE_STOP, request, "the stop was not released")

    def step(self, now_ns: int) -> str:
        """Ask, or look for the answer; what is waited for, empty once it is released.

        Raises:
            CommandFailed: the robot refused.
        """
        if self.was is None:
            self.was = self._safety.fresh(now_ns)
        return self._request.step() if self.was is not None else "it is not heard"


class Revoke:
    """Asks for the end of the authority of whoever commands until there is an answer.

    Attributes:
        was: who commanded before; None until the robot was heard.

    Args:
        bus: to the robot.
        by: who revokes it.
        reason: why.
    """

    def __init__(self, bus: Bus, by: str, reason: str) -> None:
        self.was: AuthorityState | None = None
        self._authority = bus.subscribe(topics.AUTHORITY_STATE)
        request = queries.RevokeAuthority(by, reason, request=new_number())
        self._request = _Request(bus, queries.REVOKE, request, "the authority was not revoked")

    def step(self, now_ns: int) -> str:
        """Ask, or look for the answer; what is waited for, empty once nobody commands.

        Raises:
            CommandFailed: the robot refused.
        """
        if self.was is None:
            self.was = self._authority.fresh(now_ns)
        return self._request.step() if self.was is not None else "it is not heard"


def story(was: SafetyState) -> str:
    """Who had pressed the stop that was released, when and why."""
    if not was.emergency_stop:
        return "no stop was latched"
    why = f" ({was.reason})" if was.reason else ""
    return f"{was.by} had pressed it at {was.at or 'an unknown time'}{why}"
