"""What stands between the contract and a maker's driver, on a driver of our own: nothing of it is a real arm."""

import importlib
import pkgutil
import time
from dataclasses import dataclass, field, replace

import numpy as np
import pytest

from services.process.clock import ManualClock
from services.process.exceptions import RoomMissing, UnusableSetting
from services.robot.backends import vendors
from services.robot.backends.backend import NativeLimits, NotReady, RobotNotAnswering, State
from services.robot.backends.driver import Reading, reached, streamed
from services.robot.backends.hardware import LOST_S, Hardware, driver_of
from sim.robots.catalogue import robot

SEVEN = np.zeros(7)
LIMITS = NativeLimits(SEVEN - 3.0, SEVEN + 3.0, SEVEN + 2.0, SEVEN + 10.0, SEVEN + 1e3)


@dataclass
class Scripted:
    """A driver that reads what a test says, and notes what it is told."""

    maker: str = "test"
    joints: int = 7
    limits: NativeLimits = LIMITS
    reading: Reading = field(default_factory=lambda: Reading(SEVEN, SEVEN, 0.0))
    told: list = field(default_factory=list)
    error: Exception | None = None
    unreachable: Exception | None = None
    beats: bool = True

    def connect(self, host):
        if self.unreachable is not None:
            raise self.unreachable

    def close(self):
        self.told.append("close")

    def read(self):
        if self.error is not None:
            raise self.error
        if self.beats:
            self.reading = replace(self.reading, stamp=self.reading.stamp + 0.001)
        return self.reading

    def follow(self, q, qd, measured):
        self.told.append("follow")

    def grip(self, opening):
        self.told.append(("grip", opening))

    def stand(self):
        self.told.append("stand")

    def recover(self):
        self.told.append("recover")
        self.reading = replace(self.reading, state=State.READY, reason="")


@pytest.fixture
def clock():
    return ManualClock()


@pytest.fixture
def driver():
    return Scripted()


@pytest.fixture
def arm(driver, clock):
    arm = Hardware(driver, "192.0.2.1", robot("panda"), variant="box", yaw=np.pi / 2, clock=clock)
    arm.connect()
    return arm


def follow(arm, clock, periods=3):
    for _ in range(periods):
        arm.command(SEVEN, SEVEN, 0.04)
        clock.advance(0.01)
        arm.observe()


def test_hardware_knows_nothing_of_what_stands_around_it(arm, driver, clock):
    driver.reading = replace(driver.reading, force=np.array([1.0, 0.0, 0.0]))
    clock.advance(0.01)
    seen = arm.observe()
    assert (seen.object_pose, seen.touch, seen.world.size, seen.condition.size) == (None, None, 0, 0)
    np.testing.assert_allclose(seen.contact_force, [0.0, 1.0, 0.0], atol=1e-12)  # the arm's base is turned
    assert arm.variant == "box"


def test_without_commands_it_is_told_to_stand_once(arm, driver, clock):
    follow(arm, clock)
    driver.told.clear()
    for _ in range(10):
        clock.advance(0.01)
        arm.observe()
    assert driver.told == ["stand"]


@pytest.mark.parametrize("state", [State.PROTECTIVE_STOP, State.HARDWARE_STOP, State.WRONG_MODE])
def test_what_its_own_controller_says_is_said_and_no_command_passes(arm, driver, clock, state):
    follow(arm, clock)
    driver.reading = replace(driver.reading, state=state, reason="because")
    clock.advance(0.01)
    status = arm.status()
    assert (status.state, status.reason, status.works) == (state, "because", False)
    driver.told.clear()
    with pytest.raises(NotReady, match="because"):
        arm.command(SEVEN, SEVEN, 0.0)
    assert not driver.told
    arm.stop("because")
    arm.recover()
    assert "recover" in driver.told
    assert arm.status().state is State.HOLDING


def test_it_does_not_recover_as_long_as_its_button_is_pressed(arm, driver, monkeypatch):
    pressed = replace(driver.reading, state=State.HARDWARE_STOP, reason="its button is pressed")
    monkeypatch.setattr(driver, "recover", lambda: setattr(driver, "reading", pressed))
    with pytest.raises(NotReady, match="its button is pressed"):
        arm.recover()


def test_an_arm_that_says_the_same_again_and_again_is_lost_and_its_age_grows(arm, driver, clock):
    follow(arm, clock)
    driver.beats = False
    clock.advance(0.01)
    arm.observe()
    clock.advance(0.01)
    arm.observe()
    clock.advance(LOST_S)
    status = arm.status()
    assert status.state is State.NOT_CONNECTED
    assert status.age == pytest.approx(LOST_S + 0.02, abs=0.011)
    with pytest.raises(NotReady):
        arm.observe()
    driver.beats = True
    arm.recover()
    follow(arm, clock)


def test_a_driver_that_raises_is_an_arm_that_is_lost(arm, driver, clock):
    driver.error = RuntimeError("cable\nloose")
    clock.advance(0.01)
    assert str(arm.status()) == "not connected: cable loose"
    driver.unreachable = RuntimeError("still loose")
    with pytest.raises(NotReady, match="still loose"):
        arm.recover()
    arm.close()
    assert "close" not in driver.told, "nothing is asked of what is not there"


def test_a_robot_of_other_joints_is_refused(driver, clock):
    with pytest.raises(UnusableSetting, match="ur5 has 6 joints, a test arm 7"):
        Hardware(driver, "192.0.2.1", robot("ur5"), variant="box", yaw=0.0, clock=clock)


def test_of_hardware_that_nobody_has_a_file_for_the_known_ones_are_named():
    with pytest.raises(UnusableSetting, match="'kuka' is none of simulated, franka"):
        driver_of("kuka")


def test_a_robot_that_does_not_answer_is_told_in_a_line_within_seconds():
    with pytest.raises(RobotNotAnswering) as told:
        reached("test", "192.0.2.1", lambda: time.sleep(5.0), within_s=0.05)
    assert "no test arm can be commanded at 192.0.2.1: no answer within" in str(told.value)
    assert "\n" not in str(told.value)

    def refuse():
        raise RuntimeError("connection\nrefused")

    with pytest.raises(RobotNotAnswering, match="connection refused"):
        reached("test", "192.0.2.1", refuse)


@pytest.mark.parametrize("kind", [module.name for module in pkgutil.iter_modules(vendors.__path__)])
def test_a_missing_library_is_a_line_with_the_extra_to_install(kind, monkeypatch):
    driver, load = driver_of(kind), importlib.import_module

    def missing(name, *rest):
        if name.partition(".")[0] == "services":
            return load(name, *rest)
        raise ImportError(name)

    monkeypatch.setattr(importlib, "import_module", missing)
    with pytest.raises(RoomMissing, match=f"install retouch.{kind}."):
        reached(driver.maker, "192.0.2.1", lambda: driver.connect("192.0.2.1"))


def test_what_is_streamed_leads_to_the_command_and_keeps_to_the_limits():
    fastest = np.array([2.0, 2.0])
    velocity = streamed(np.array([0.01, 5.0]), np.array([0.3, 0.0]), np.zeros(2), fastest)
    np.testing.assert_allclose(velocity, [0.4, 2.0])


ACME = """
class Driver:
    maker = "Acme"
    joints = 7
"""


def test_another_makers_arms_are_one_file(tmp_path, monkeypatch):
    (tmp_path / "acme.py").write_text(ACME)
    monkeypatch.setattr(vendors, "__path__", [*vendors.__path__, str(tmp_path)])
    assert driver_of("acme").maker == "Acme"
