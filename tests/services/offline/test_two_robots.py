"""Two robots, each with a station: whoever changes from one's page to the other's leaves nothing moving behind.

Stations, robots and the desks of their pages are the real ones; on a clock that is moved by hand a hold is measured to
the control period.
"""

import msgspec
import numpy as np
import pytest

from protocol.messages import Phase
from protocol.topics import ROBOT_STATE, TEACHING_STATE
from services.offline.first_demonstrations import first_demonstrations
from services.offline.people.person import NoEffects
from services.offline.stage import Stage, give
from services.process.config import Configuration, ModelSection, RobotSection, StationSection
from services.station.page.input import Desk
from services.station.page.said import Held, Hello, Pressed
from services.station.service import StationService
from services.station.settings import settings
from sim.tasks.particle import PARTICLE
from tests.services.quiet_page import QuietPage

pytestmark = pytest.mark.sim

TAB = 1
HELD_WITHIN_S = 0.2
TICKS_S = 0.03
"""A station's step, and a control period."""

JUMP_M = 0.002
"""From one control period to the next; the motion itself goes a tenth of that."""


class Page(QuietPage):
    """The page of a browser that has one tab at most; see `Frontend`."""

    def __init__(self, clock):
        self.effects = NoEffects()
        self.open = False
        self._clock = clock
        self._desk = Desk("ann")
        self._said = 0
        self._pressed = 0

    def come(self):
        """Somebody opens it."""
        self._say(Hello("seat-of-ann", "load-of-ann", "Ann", "operator"))
        self.open = True

    def leave(self):
        """They go on to another page: the browser closes the link."""
        self._desk.leave(TAB, self._clock.now_ns())
        self.open = False

    def press(self, action):
        self._pressed += 1
        self._say(Pressed(number=self._pressed, action=action, **self._stamp()))

    def take_input(self):
        if self.open:
            self._say(Held(keys=(), visible=True, focused=True, controllers=(), drawn=(0, 0, 0, 0), **self._stamp()))
        return self._desk.take_input(self._clock.now_ns())

    def take_presses(self):
        return self._desk.take_presses()

    def _stamp(self):
        self._said += 1
        return {"sequence": self._said, "stamp_ms": self._clock.now_ns() / 1e6}

    def _say(self, message):
        assert self._desk.receive(TAB, msgspec.json.encode(message), self._clock.now_ns()) is not None


class Robot(Stage):
    """A robot and its station."""

    def __init__(self, folder, name):
        database = str(folder / f"{name}.sqlite")
        super().__init__(Configuration(robot=RobotSection(scene="particle"), model=ModelSection(database=database)))
        self.page = Page(self.clock)
        chosen = settings(StationSection(autonomous_s=20.0), "ann")
        looks = self.bus()
        self.heard, self.teaching = looks.subscribe(ROBOT_STATE), looks.subscribe(TEACHING_STATE)
        give(self, "particle", first_demonstrations(PARTICLE))
        self._turns.append(self._turn(StationService(self.bus(), chosen, self.page, seed=0)))
        self.states = []

    def listen(self):
        self.states += [received.message for received in self.heard.take()]
        return self.states

    def until(self, seen, seconds=60.0):
        end_ns = self.clock.now_ns() + round(seconds * 1e9)

        def there():
            assert self.clock.now_ns() < end_ns, self.teaching.latest()
            return seen()

        self.run(there)

    def wait(self, seconds):
        end_ns = self.clock.now_ns() + round(seconds * 1e9)

        def over():
            self.listen()  # no more than so many wait to be heard
            return self.clock.now_ns() >= end_ns

        self.run(over)

    def begin(self):
        """Ask for a motion; where little is known that is said first, and asked for again."""
        for _ in range(2):
            self.until(lambda: "execute" in self.teaching.latest().message.actions if self.teaching.latest() else False)
            self.page.press("execute")
            self.until(lambda: self.teaching.latest().message.phase != "deciding")
            self.until(lambda: self.teaching.latest().message.phase in ("executing", "deciding"))
            if self.teaching.latest().message.phase == "executing":
                break
        self.wait(1.0)
        assert self.listen()[-1].phase is Phase.EXECUTE


@pytest.fixture
def robots(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    both = [Robot(tmp_path, name) for name in ("kitchen", "garage")]
    yield both
    for robot in both:
        robot.close()


def test_the_robot_that_is_left_holds_within_a_fifth_of_a_second_without_a_jump_and_the_other_one_obeys(robots):
    kitchen, garage = robots
    kitchen.page.come()
    kitchen.begin()
    left_ns = kitchen.clock.now_ns()
    kitchen.page.leave()
    kitchen.wait(1.0)
    garage.page.come()
    garage.begin()
    since = [state for state in kitchen.listen() if state.stamp_ns >= left_ns]
    held = next(state for state in since if state.phase is not Phase.EXECUTE)
    assert (held.stamp_ns - left_ns) / 1e9 < HELD_WITHIN_S + TICKS_S
    assert {state.phase for state in since if state.stamp_ns >= held.stamp_ns} == {Phase.HOLD}
    for robot in robots:
        places = np.array([state.measured.position for state in robot.listen()])
        assert np.max(np.linalg.norm(np.diff(places, axis=0), axis=1)) < JUMP_M
    stood = [state.measured.position for state in since if state.stamp_ns > held.stamp_ns + 500_000_000]
    assert np.ptp(stood, axis=0).max() < 1e-6
