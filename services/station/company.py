"""Who is at the pages of a robot, this station's and all others': told by each, and forgotten once it is silent."""

from __future__ import annotations

from protocol import topics
from protocol.messages import Attendance
from services.bus.bus import Bus
from services.bus.senders import Senders
from services.process.schedule import Schedule


class Company:
    """Tells who is here, and hears who is elsewhere.

    Args:
        bus: to the other stations.
    """

    def __init__(self, bus: Bus) -> None:
        self._bus = bus
        self._stations = Senders(bus.subscribe(topics.ATTENDANCE), lambda told: told.process)
        self._schedule = Schedule()
        self._told: Attendance | None = None

    def tell(self, here: Attendance, now_ns: int) -> None:
        """Say who is here, in the topic's rhythm; who comes or goes at once."""
        if self._schedule.due(topics.ATTENDANCE, now_ns) or here != self._told:
            self._told = here
            self._bus.publish(topics.ATTENDANCE, here)

    def there(self, now_ns: int) -> tuple[Attendance, ...]:
        """Who is at which station now, this one included, in the order of the stations' names."""
        return tuple(received.message for _, received in sorted(self._stations.there(now_ns).items()))
