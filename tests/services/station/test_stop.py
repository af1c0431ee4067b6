"""The page's emergency stop: said at the topic's rate until the robot shows it latched and standing."""

import pytest

from protocol import topics
from protocol.messages import SafetyState
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.station.stop import StopButton

PERIOD = 0.02


class Site:
    """A button, and whoever hears it."""

    def __init__(self):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        bus = network.bus()
        self.other = network.bus()
        self.stops = self.other.subscribe(topics.EMERGENCY_STOP)
        self.button = StopButton(bus, bus.subscribe(topics.SAFETY_STATE), "station-1")

    def says(self, **safety):
        self.other.publish(topics.SAFETY_STATE, SafetyState(**safety))

    def press(self):
        self.button.press(self.clock.now_ns(), "ann")

    def run(self, seconds):
        """The presses that were heard meanwhile."""
        heard = []
        for _ in range(round(seconds / PERIOD)):
            self.button.step(self.clock.now_ns())
            heard += [received.message for received in self.stops.take()]
            self.clock.advance(PERIOD)
        return heard


def test_nothing_is_said_before_it_is_pressed():
    site = Site()
    assert site.run(1.0) == []
    assert not site.button.unconfirmed


def test_it_is_said_at_once_by_whom_and_where():
    site = Site()
    site.press()
    (heard,) = site.run(PERIOD)
    assert (heard.pressed, heard.by, heard.reason) == (True, "ann", "pressed at station-1")


def test_it_is_repeated_fifty_times_a_second_for_as_long_as_nothing_confirms_it():
    site = Site()
    site.press()
    assert len(site.run(60.0)) == 3000
    assert site.button.unconfirmed


@pytest.mark.parametrize(
    "safety",
    [{"emergency_stop": True, "standing": False}, {"emergency_stop": False, "standing": True}],
    ids=["still moving", "not latched"],
)
def test_what_is_not_latched_and_standing_confirms_nothing(safety):
    site = Site()
    site.press()
    site.run(PERIOD)
    site.says(**safety)
    assert len(site.run(1.0)) == 50


def test_it_is_confirmed_by_what_the_robot_says_after_the_press():
    site = Site()
    site.press()
    site.run(PERIOD)
    site.says(emergency_stop=True, standing=True)
    assert site.run(1.0) == []
    assert not site.button.unconfirmed


@pytest.mark.parametrize("ago", [0.0, 1.0])
def test_what_the_robot_said_before_the_press_confirms_nothing(ago):
    """A stop that was released since, in an outage, would be taken for latched."""
    site = Site()
    site.says(emergency_stop=True, standing=True)
    site.clock.advance(ago)
    site.press()
    assert len(site.run(1.0)) == 50


@pytest.mark.parametrize("heard", [True, False])
def test_a_release_that_is_asked_for_before_the_stop_has_latched_does_not_take_it_back(heard):
    site = Site()
    site.press()
    site.run(PERIOD)
    if heard:
        site.says(emergency_stop=False)
    site.button.let_go(site.clock.now_ns())
    assert len(site.run(1.0)) == 50


def test_whoever_asks_for_the_release_presses_no_longer():
    site = Site()
    site.press()
    site.run(PERIOD)
    site.says(emergency_stop=True, standing=False)
    site.button.let_go(site.clock.now_ns())
    assert site.run(1.0) == []
    site.press()
    assert len(site.run(PERIOD)) == 1
