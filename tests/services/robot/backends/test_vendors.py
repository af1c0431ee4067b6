"""What UR and xArm say of themselves, by stand-ins for their libraries: nothing of it is a real arm."""

import time

import numpy as np
import pytest

from services.process.clock import SystemClock
from services.robot.backends.backend import NotReady, RobotNotAnswering, State
from services.robot.backends.hardware import Hardware
from services.robot.backends.vendors import ur, xarm
from sim.robots.catalogue import robot
from tests.services.robot.backends.fakes_ur import FakeUr
from tests.services.robot.backends.fakes_xarm import FakeXArm


def connected(driver, kind):
    backend = Hardware(driver, "192.0.2.1", robot(kind), variant="", yaw=0.0, clock=SystemClock())
    backend.connect()
    return backend


def soon(seen):
    due = time.monotonic() + 2.0
    while not seen():
        assert time.monotonic() < due
        time.sleep(0.01)


@pytest.mark.parametrize(
    ("change", "state", "reason"),
    [
        ({"protective": True}, State.PROTECTIVE_STOP, "it met something"),
        ({"emergency": True}, State.HARDWARE_STOP, "an emergency stop is pressed"),
        ({"safety": 5}, State.HARDWARE_STOP, "its safeguard is open"),
        ({"mode": 5}, State.WRONG_MODE, "it is idle, its brakes closed"),
        ({"mode": 8}, State.WRONG_MODE, "it is in its mode 8"),
        ({"running": False}, State.WRONG_MODE, "the program in its controller has ended"),
    ],
)
def test_a_ur_says_why_it_follows_nothing(change, state, reason):
    arm = FakeUr()
    backend = connected(ur.Driver(arm), "ur5")
    vars(arm).update(change)
    time.sleep(0.002)
    status = backend.status()
    assert status.state is state
    assert status.reason.startswith(reason)
    backend.close()


def test_a_ur_recovers_from_a_protective_stop_with_its_program_loaded_again():
    arm = FakeUr()
    backend = connected(ur.Driver(arm), "ur5")
    assert arm.watchdog > 0.0, "its program ends where this process is gone"
    arm.protect()
    time.sleep(0.002)
    q = backend.observe().q
    with pytest.raises(NotReady):
        backend.command(q, np.zeros(6), 0.0)
    backend.recover()
    assert arm.running
    backend.command(backend.observe().q, np.zeros(6), 0.0)
    backend.close()
    assert not arm.running


def test_a_ur_that_is_not_under_remote_control_does_not_recover(monkeypatch):
    arm = FakeUr()
    backend = connected(ur.Driver(arm), "ur5")
    arm.running = False
    monkeypatch.setattr(arm, "reuploadScript", lambda: False)
    with pytest.raises(NotReady, match="set remote control"):
        backend.recover()


def test_an_xarm_that_its_controller_stopped_says_so_and_recovers():
    arm = FakeXArm()
    backend = connected(xarm.Driver(arm), "xarm7")
    arm.collide()
    soon(lambda: backend.status().state is State.PROTECTIVE_STOP)
    assert "error 31" in backend.status().reason
    backend.recover()
    assert backend.status().state is State.HOLDING
    arm.mode = 0
    soon(lambda: backend.status().state is State.WRONG_MODE)
    backend.close()


def test_an_xarms_gripper_goes_where_it_is_told():
    arm = FakeXArm()
    backend = connected(xarm.Driver(arm), "xarm7")
    assert backend.observe().opening == pytest.approx(0.085)
    backend.command(backend.observe().q, np.zeros(7), 0.0425)
    soon(lambda: arm.pulses == pytest.approx(425.0))
    soon(lambda: backend.observe().opening == pytest.approx(0.0425))
    backend.close()


def test_an_xarm_that_reports_nothing_is_not_there(monkeypatch):
    monkeypatch.setattr(xarm, "FIRST_REPORT_S", 0.05)
    arm = FakeXArm()
    monkeypatch.setattr(arm, "register_report_callback", lambda callback: True)
    with pytest.raises(RobotNotAnswering, match=r"no UFACTORY can be commanded at 192.*: it reports nothing"):
        connected(xarm.Driver(arm), "xarm7")
    arm.disconnect()
