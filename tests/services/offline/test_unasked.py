"""Nothing moves unasked: robot, model, master and a person's station on one bus; the particle is the robot."""

import pytest

from protocol import queries
from protocol.messages import EmergencyStop, OperatorInput, Phase, Purpose
from protocol.topics import EMERGENCY_STOP, ROBOT_STATE, SAFETY_STATE, TEACHING_STATE
from services.bus.arrays import motion_to_wire, vector3
from services.offline.first_demonstrations import first_demonstrations
from services.offline.stage import Stage
from services.process.config import Configuration, ModelSection, RobotSection, StationSection
from services.station.page.effects import Effects
from services.station.press import Press
from services.station.service import StationService
from services.station.settings import settings
from services.station.workflow.episode import UNSEEN_AFTER_RESET_S
from sim.tasks.particle import PARTICLE
from tests.services.quiet_page import QuietPage

pytestmark = pytest.mark.sim

MOVING = {Phase.RAMP, Phase.EXECUTE, Phase.HOLD}
LONG = UNSEEN_AFTER_RESET_S + 1.0  # [s] longer than robot and station wait for anything while nothing is executed


class Tab(QuietPage):
    """A person's page: there, holding nothing, pressing what the test says."""

    def __init__(self):
        self.pressed, self.present = [], True
        self.effects = Effects()

    def take_presses(self):
        taken, self.pressed = self.pressed, []
        return [Press(action) for action in taken]

    def take_input(self):
        return OperatorInput(present=self.present, focused=True)


class Person(Stage):
    """A stage with one person's station on it."""

    def __init__(self, folder):
        configuration = Configuration(
            robot=RobotSection(scene="particle"), model=ModelSection(database=str(folder / "model.sqlite"))
        )
        super().__init__(configuration)
        self.page = Tab()
        by_hand = settings(StationSection(autonomous_s=4.0), "operator")
        self.station = StationService(self.bus(), by_hand, self.page, seed=0)
        self.way_in = self.bus()
        self.robot = self.way_in.subscribe(ROBOT_STATE)
        self.safety = self.way_in.subscribe(SAFETY_STATE)
        self.teaching = self.way_in.subscribe(TEACHING_STATE)
        self.teach_first()
        self._turns.append(self._turn(self.station))

    def teach_first(self):
        for shown in first_demonstrations(PARTICLE):
            way = shown.trajectory
            motion = motion_to_wire(way.positions, way.orientations, way.duration)
            condition = tuple(shown.condition.tolist())
            request = queries.AddDemonstration(Purpose.INITIAL, motion, vector3(shown.origin), "particle", condition)
            pending = self.way_in.ask(queries.ADD_DEMONSTRATION, request)
            self.run(lambda pending=pending: pending.poll() is not None)

    def begin(self, action):
        """Press for an episode, and let it come under way."""
        self.until("deciding")
        self.press(action)
        self.phases(2.0)

    def press(self, action):
        """Press for a motion, and once more where the first press is answered by how little is known there."""
        self.page.pressed = [action]
        if self.until("executing", warned=True) == "deciding":
            self.page.pressed = [action]
            self.until("executing")

    def phases(self, seconds):
        """What the robot does in so much time."""
        seen = set()
        end_ns = self.clock.now_ns() + round(seconds * 1e9)

        def over():
            state = self.robot.latest()
            if state is not None:
                seen.add(state.message.phase)
            return self.clock.now_ns() >= end_ns

        self.run(over)
        return seen

    def until(self, phase, *, warned=False):
        """The phase that comes: the named one or, if allowed, the one in which little is said to be known."""
        end_ns = self.clock.now_ns() + round(60e9)

        def there():
            told = self.teaching.latest()
            assert self.clock.now_ns() < end_ns, told
            if told is None:
                return False
            return told.message.phase == phase or (warned and "I don't know this place" in told.message.text)

        self.run(there)
        return self.teaching.latest().message.phase

    def actions(self):
        return set(self.teaching.latest().message.actions)


@pytest.fixture
def person(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_STATE_HOME", str(tmp_path / "state"))
    opened = Person(tmp_path)
    yield opened
    opened.close()


def test_nothing_moves_before_a_press_and_each_press_is_one_episode(person):
    assert person.phases(LONG) == {Phase.IDLE}
    person.press("execute")
    person.until("deciding")
    assert person.phases(LONG) == {Phase.IDLE}


def test_after_a_stop_and_its_release_from_elsewhere_nothing_moves(person):
    person.begin("execute")
    person.way_in.publish(EMERGENCY_STOP, EmergencyStop(pressed=True, by="bob"))
    person.until("stopped")
    assert person.phases(5.0) == {Phase.STOPPED}
    pending = person.way_in.ask(queries.RELEASE_STOP, queries.ReleaseStop("bob"))
    person.run(lambda: pending.poll() is not None)
    person.until("deciding")
    assert not MOVING & person.phases(LONG)


def test_a_stop_of_the_page_is_confirmed_and_released_by_its_person(person):
    person.begin("execute")
    person.page.pressed = ["stop"]
    person.until("stopped")
    person.phases(1.0)
    assert person.safety.latest().message.by == "operator"
    assert person.actions() == {"confidence", "release_stop"}
    person.page.pressed = ["release_stop"]
    person.until("deciding")
    assert not MOVING & person.phases(LONG)


@pytest.mark.parametrize("absence", [0.8, 5.0])
def test_after_an_absence_the_motion_waits_and_goes_on_upon_a_press(person, absence):
    """Shorter than the lease, and longer."""
    person.begin("execute")
    person.page.present = False
    person.phases(absence)
    person.page.present = True
    person.phases(2.0)
    assert person.phases(10.0) == {Phase.HOLD}
    assert {"finish", "go_on"} <= person.actions()
    person.page.pressed = ["go_on"]
    person.until("deciding")


def test_a_station_that_was_taken_over_moves_nothing_after_the_other_has_gone(person):
    person.until("deciding")
    pending = person.way_in.ask(
        queries.ACQUIRE, queries.AcquireAuthority("station-2", "bob", take_over=True, reason="it burns")
    )
    person.run(lambda: pending.poll() is not None)
    person.until("watching")
    assert person.phases(LONG) == {Phase.IDLE}
    assert person.actions() == {"ask", "confidence", "take_over"}
    person.page.pressed = ["ask"]
    person.until("deciding")
    assert person.phases(10.0) == {Phase.IDLE}


def test_a_refinement_that_its_operator_finished_says_so(person):
    person.begin("refine")
    person.page.pressed = ["finish"]
    person.until("deciding")
    assert "It did not run to its end: finished by" in person.teaching.latest().message.told
