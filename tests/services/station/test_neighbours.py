"""The other robots of a network: seen from any station, each with its stop, and nothing else goes to them."""

import pytest

from protocol import topics
from protocol.messages import Attendance, AuthorityState, Light, SafetyState, TeachingState
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.neighbours import NEIGHBOURS_KEPT, Neighbour, Neighbours
from services.station.press import Press

PERIOD_S = 0.02
LATCHED = SafetyState(emergency_stop=True, by="eve", standing=True)


class Site:
    """A station of the kitchen's robot, and a garage beside it."""

    def __init__(self):
        self.clock = ManualClock()
        self.kitchen = MemoryNetwork(self.clock, "kitchen")
        self.garage = MemoryNetwork(self.clock, "garage")
        self.kitchen.join(self.garage)
        self.robot = self.garage.bus()
        self.stops = self.robot.subscribe(topics.EMERGENCY_STOP)
        self.stops_here = self.kitchen.bus().subscribe(topics.EMERGENCY_STOP)
        self.neighbours = Neighbours(self.kitchen.bus("station-ann"), "station-1")
        self.run(PERIOD_S)

    def run(self, seconds, safety=None):
        """Let time pass; the stops that the garage heard meanwhile."""
        heard = []
        for _ in range(round(seconds / PERIOD_S)):
            self.clock.advance(PERIOD_S)
            if safety is not None:
                self.robot.publish(topics.SAFETY_STATE, safety)
            self.neighbours.step(self.clock.now_ns())
            heard += [received.message for received in self.stops.take()]
        return heard

    def seen(self):
        return self.neighbours.there(self.clock.now_ns())


def test_a_robot_that_says_nothing_is_there_unheard():
    assert Site().seen() == (Neighbour("garage", None, "", None, stopping=False, page=""),)


def test_its_light_its_commander_and_its_page_are_seen():
    site = Site()
    safety = SafetyState(emergency_stop=False)
    site.robot.publish(topics.SAFETY_STATE, safety)
    site.robot.publish(topics.AUTHORITY_STATE, AuthorityState(operator="bob", holder="s", epoch=1, expires_in=1.0))
    site.robot.publish(topics.TEACHING_STATE, TeachingState(phase="deciding", text="", light=Light.GREEN))
    site.robot.publish(topics.ATTENDANCE, Attendance(holder="s", page="http://127.0.0.1:8081/"))
    (seen,) = site.seen()
    assert (seen.light, seen.commander, seen.page) == (Light.GREEN, "bob", "http://127.0.0.1:8081/")
    assert seen.safety is not None


@pytest.mark.parametrize(("commander", "stops"), [("ann", True), ("bob", False), ("", False)])
def test_one_press_stops_whatever_its_operator_commands_and_nobody_else_s(commander, stops):
    site = Site()
    site.robot.tell_commander(commander)
    site.neighbours.hear(Press("stop"), "ann", site.clock.now_ns())
    assert bool(site.run(0.2)) == stops


def test_one_press_stops_all_that_its_operator_commands_more_than_are_shown_too_and_shows_those_that_do_not_stand():
    site = Site()
    garages = [MemoryNetwork(site.clock, f"robot-{number:02}") for number in range(3 * NEIGHBOURS_KEPT)]
    heard = {network.robot: network.bus().subscribe(topics.EMERGENCY_STOP) for network in garages}
    for number, network in enumerate(garages):
        site.kitchen.join(network)
        network.bus().tell_commander("ann" if number >= 2 * NEIGHBOURS_KEPT else "bob")
    site.run(PERIOD_S)
    site.neighbours.hear(Press("stop"), "ann", site.clock.now_ns())
    site.run(PERIOD_S)
    stopped = [robot for robot, stops in heard.items() if stops.take()]
    assert stopped == [network.robot for network in garages[2 * NEIGHBOURS_KEPT :]]
    assert [(neighbour.robot, neighbour.stopping) for neighbour in site.seen()] == [(robot, True) for robot in stopped]


def test_its_stop_is_said_to_it_alone_until_it_stands():
    site = Site()
    site.neighbours.press_stop("garage", site.clock.now_ns(), "ann")
    heard = site.run(1.0, SafetyState(emergency_stop=False))
    assert len(heard) == topics.EMERGENCY_STOP.rate_hz
    assert {(stop.by, stop.reason) for stop in heard} == {("ann", "pressed at station-1")}
    assert site.seen()[0].stopping
    site.run(0.04, LATCHED)
    assert site.run(1.0, LATCHED) == []
    assert not site.seen()[0].stopping
    assert site.stops_here.take() == []


def test_one_that_fell_silent_can_be_stopped_all_the_same():
    site = Site()
    site.run(0.1, SafetyState(emergency_stop=False))
    site.run(5.0)
    assert site.seen()[0].safety is None
    site.neighbours.press_stop("garage", site.clock.now_ns(), "ann")
    assert site.run(0.1)


@pytest.mark.parametrize("robot", ["attic", "kitchen", ""])
def test_only_another_robot_that_was_heard_of_is_stopped_from_here(robot):
    site = Site()
    site.neighbours.press_stop(robot, site.clock.now_ns(), "ann")
    assert site.run(0.5) == []
    assert site.stops_here.take() == []


def test_a_robot_that_comes_later_is_seen_too_and_not_more_than_there_is_room_for():
    site = Site()
    for number in range(NEIGHBOURS_KEPT + 3):
        site.kitchen.join(MemoryNetwork(site.clock, f"robot-{number:02}"))
    site.run(PERIOD_S)
    names = [neighbour.robot for neighbour in site.seen()]
    assert names == ["garage", *(f"robot-{number:02}" for number in range(NEIGHBOURS_KEPT - 1))]
