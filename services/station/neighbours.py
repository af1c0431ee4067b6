"""The other robots of the network: their light, who commands them, their page, and a stop for each, always in reach.

Nothing else goes from here to them: whoever wants to command one opens its own station's page.
"""

from __future__ import annotations

from dataclasses import dataclass

from protocol import topics
from protocol.messages import Light, SafetyState
from services.bus.bus import Bus
from services.station.company import Company
from services.station.press import STOP, STOP_OTHER, Press
from services.station.stop import StopButton

NEIGHBOURS_KEPT = 8
"""So many other robots are shown at most: the first that were there, before them those whose stop is not confirmed."""


@dataclass(frozen=True)
class Neighbour:
    """Another robot, as it is now.

    Attributes:
        robot: its name.
        light: of the teaching there; None where nothing is heard of it.
        commander: who commands it; empty where nobody does.
        safety: what keeps it from moving; None where it is not heard now.
        stopping: its stop was pressed here and is not confirmed yet.
        page: address of the page of a station of it; empty where there is none.
    """

    robot: str
    light: Light | None
    commander: str
    safety: SafetyState | None
    stopping: bool
    page: str


class _Ear:
    """What is heard of one other robot, and its stop.

    Args:
        bus: of that robot.
        holder: this station's name.
    """

    def __init__(self, bus: Bus, holder: str) -> None:
        self.safety = bus.subscribe(topics.SAFETY_STATE)
        self.authority = bus.subscribe(topics.AUTHORITY_STATE)
        self.teaching = bus.subscribe(topics.TEACHING_STATE)
        self.company = Company(bus)
        self.stop = StopButton(bus, self.safety, holder)

    def now(self, robot: str, now_ns: int) -> Neighbour:
        """As it is now."""
        authority, teaching = self.authority.fresh(now_ns), self.teaching.fresh(now_ns)
        pages = [told.page for told in self.company.there(now_ns) if told.page]
        return Neighbour(
            robot=robot,
            light=teaching.light if teaching is not None else None,
            commander=(authority.operator or authority.holder) if authority is not None else "",
            safety=self.safety.fresh(now_ns),
            stopping=self.stop.unconfirmed,
            page=pages[0] if pages else "",
        )


class Neighbours:
    """Follows the other robots that are on the network.

    Args:
        bus: of this station's own robot.
        holder: this station's name.
    """

    def __init__(self, bus: Bus, holder: str) -> None:
        self._bus = bus
        self._holder = holder
        self._ears: dict[str, _Ear] = {}

    def press_stop(self, robot: str, now_ns: int, by: str) -> None:
        """Stop one of them; one that was never heard of cannot be stopped from here."""
        if robot in self._ears:
            self._ears[robot].stop.press(now_ns, by)

    def hear(self, press: Press, by: str, now_ns: int) -> None:
        """A button was pressed here; a stop is meant for every robot that its operator commands, wherever they do."""
        if press.action == STOP_OTHER:
            self.press_stop(press.argument, now_ns, by)
        elif press.action == STOP and by:
            for robot, operator in sorted(self._bus.neighbours().items()):
                if operator == by:
                    self._ear(robot).stop.press(now_ns, by)

    def step(self, now_ns: int) -> None:
        """Say the stops on that are not confirmed, and listen to who has come."""
        for ear in self._ears.values():
            ear.stop.step(now_ns)
        for robot in sorted(self._bus.neighbours().keys() - self._ears.keys()):
            if len(self._ears) < NEIGHBOURS_KEPT:
                self._ear(robot)

    def there(self, now_ns: int) -> tuple[Neighbour, ...]:
        """Those that are shown, in the order of their names; one that fell silent can be stopped all the same."""
        shown = sorted(self._ears, key=lambda robot: not self._ears[robot].stop.unconfirmed)[:NEIGHBOURS_KEPT]
        return tuple(self._ears[robot].now(robot, now_ns) for robot in sorted(shown))

    def _ear(self, robot: str) -> _Ear:
        if robot not in self._ears:
            self._ears[robot] = _Ear(self._bus.neighbour(robot), self._holder)
        return self._ears[robot]
