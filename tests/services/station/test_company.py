"""Who is at the pages of a robot: each station tells, all hear, and who is silent is forgotten."""

import pytest

from protocol import topics
from protocol.messages import Attendance, Person, Role
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.company import Company

ANN = Person("ann", Role.OPERATOR, has_input=True)
EVE = Person("eve", Role.SUPERVISOR)
GONE_S = 2.0


class Site:
    """Two stations of one robot."""

    def __init__(self):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        self.first, self.second = (Company(network.bus(f"station-{name}")) for name in ("ann", "bob"))
        self.heard = network.bus().subscribe(topics.ATTENDANCE)

    def tell(self, seconds, first, second=None):
        for _ in range(round(seconds / 0.02)):
            self.clock.advance(0.02)
            self.first.tell(Attendance(holder="station-1", people=first), self.clock.now_ns())
            if second is not None:
                self.second.tell(Attendance(holder="station-2", people=second), self.clock.now_ns())

    def seen(self, company):
        return [(told.holder, told.people) for told in company.there(self.clock.now_ns())]


def test_each_station_sees_who_is_at_all_of_them():
    site = Site()
    site.tell(0.2, (ANN,), (EVE,))
    for company in (site.first, site.second):
        assert site.seen(company) == [("station-1", (ANN,)), ("station-2", (EVE,))]


def test_who_comes_or_goes_is_told_at_once():
    site = Site()
    site.tell(0.1, (ANN,))
    site.seen(site.second)
    site.tell(0.02, (ANN, EVE))
    assert site.seen(site.second) == [("station-1", (ANN, EVE))]
    site.tell(0.02, (ANN,))
    assert site.seen(site.second) == [("station-1", (ANN,))]


@pytest.mark.parametrize("there", [(ANN,), ()])
def test_who_is_there_is_told_at_the_topic_s_rate(there):
    site, count = Site(), 0
    for _ in range(50):
        site.tell(0.02, there)
        count += len(site.heard.take())
    assert count == topics.ATTENDANCE.rate_hz


def test_a_station_that_is_silent_is_forgotten_within_two_seconds():
    site = Site()
    site.tell(0.2, (ANN,), (EVE,))
    site.tell(GONE_S, (ANN,))
    assert site.seen(site.first) == [("station-1", (ANN,))]
