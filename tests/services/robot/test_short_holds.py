"""From a page to an arm, a hand on a key all the while: what a short interruption costs, and what a longer one does."""

import msgspec
import numpy as np
import pytest

from protocol import messages, queries, topics
from protocol.messages import Mode, Phase
from services.master.service import build
from services.process.config import Configuration
from services.station.page.input import Desk
from tests.services.robot.site import Site, straight
from tests.services.station.page.browser_tab import BrowserTab

KEY = "KeyS"
PERIOD_S = 0.01
LARGEST_STEP = 0.12 * PERIOD_S
"""As fast as a held key moves the arm [m]."""


class Person:
    """At a page with a keyboard: page, master and robot, each in its own period, on one clock."""

    def __init__(self):
        self.site = Site()
        self.desk = Desk("ann")
        self.tab = BrowserTab(self.desk, now_ms=0, name="ann", role="operator")
        self.station = self.site.network.bus()
        self.master = build(self.site.network.bus(), self.site.clock, Configuration())
        self.ticks, self.page, self.offsets = 0, "alive", []
        self.run(1.5)
        self.site.acquire()

    def run(self, seconds, *keys, focused=True, page=True, master=True):
        """Let time pass; without the page or the master their samples do not come."""
        for _ in range(round(seconds / PERIOD_S)):
            self.ticks += 1
            site, now_ms = self.site, self.site.clock.now_ns() // 1_000_000
            if page and self.ticks % 2 == 0:
                self.tab.now_ms = now_ms
                self.tab.hold(*keys, focused=focused, later_ms=0)
            held = self.desk.take_input(site.clock.now_ns())
            self.station.publish(
                topics.OPERATOR_INPUT, msgspec.structs.replace(held, holder=site.holder, epoch=site.epoch)
            )
            if master:
                self.master.step(site.clock.now_ns())
            site.run(PERIOD_S)
            self.offsets.append(np.array(site.state.offset))

    def correct(self):
        """A motion to correct, and a key that is down while it runs."""
        self.site.execute(Mode.REFINE, straight(duration=20.0, n=800))
        self.run(1.2)
        assert self.site.state.phase is Phase.EXECUTE
        self.run(0.5, KEY)
        assert self.offset > 0.03
        return self.offset

    @property
    def offset(self):
        return float(np.linalg.norm(self.site.state.offset))

    def steps(self):
        """How far the correction went in each period since the last call [m]."""
        steps = np.linalg.norm(np.diff(self.offsets, axis=0), axis=1)
        self.offsets = self.offsets[-1:]
        return steps


@pytest.mark.parametrize("late", [{"page": False}, {"master": False}], ids=["the page", "the master"])
@pytest.mark.parametrize("seconds", [0.16, 0.25, 0.4])
def test_a_key_that_is_down_through_a_short_hold_leads_on_without_a_jump(late, seconds):
    person = Person()
    person.correct()
    person.run(seconds, KEY, **late)
    assert (person.site.state.phase, person.site.state.waiting) == (Phase.HOLD, False)
    held = person.offset
    person.run(0.5, KEY)
    assert person.site.state.phase is Phase.EXECUTE
    assert person.offset > held + 0.03, "nobody has to let go"
    assert person.steps().max() <= LARGEST_STEP * 1.01


def test_what_is_let_go_in_a_short_hold_lets_the_correction_fade():
    person = Person()
    before = person.correct()
    person.run(0.25, page=False)
    person.run(0.5)
    assert person.site.state.phase is Phase.EXECUTE
    assert person.offset < before
    assert person.steps().max() <= LARGEST_STEP * 1.01


def test_after_a_longer_silence_the_robot_waits_and_what_is_held_counts_once_it_was_let_go():
    person = Person()
    person.correct()
    person.run(0.8, KEY, page=False)
    held = person.offset
    for _ in range(2):
        assert person.site.state.waiting
        person.site.ask(queries.RESUME, queries.Resume(person.site.epoch))
        person.run(0.7, KEY)
        assert person.offset == pytest.approx(held), "asked for, it goes nowhere while the key is still down"
    person.run(0.1)
    person.site.ask(queries.RESUME, queries.Resume(person.site.epoch))
    person.run(0.8)
    leads_once_let_go(person)


def test_without_the_focus_even_a_moment_asks_to_let_go():
    person = Person()
    before = person.correct()
    person.run(0.1, KEY, focused=False)
    person.run(0.3, KEY)
    assert person.offset < before + 0.01
    leads_once_let_go(person)


def test_a_stop_asks_to_let_go():
    person = Person()
    person.correct()
    person.site.operator.publish(topics.EMERGENCY_STOP, messages.EmergencyStop(pressed=True, by="bob", reason="smoke"))
    person.run(0.1, KEY)
    assert person.site.state.phase is Phase.STOPPED
    person.site.release()
    person.site.acquire()
    person.site.execute(Mode.REFINE, straight(duration=20.0, n=800))
    person.run(2.0, KEY)
    assert person.site.state.phase is Phase.EXECUTE
    assert person.offset == pytest.approx(0.0, abs=1e-6)
    leads_once_let_go(person)


def leads_once_let_go(person):
    person.run(0.1)
    before = person.offset
    person.run(0.5, KEY)
    assert person.offset > before + 0.03
