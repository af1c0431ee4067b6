"""What UR and xArm say of themselves, by stand-ins for their libraries: nothing of it is a real arm."""

import time

import numpy as np
import pytest

from services.robot.backends import vendors
from services.robot.backends.backend import NotReady, RobotNotAnswering, State
from tests.services.robot.backends import rigs


@pytest.fixture
def ur():
    rig = rigs.faked_ur()
    rig.backend.connect()
    yield rig
    rig.close()


@pytest.fixture
def xarm():
    rig = rigs.faked_xarm()
    rig.backend.connect()
    yield rig
    rig.close()


def soon(seen):
    due = time.monotonic() + 10.0
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
def test_a_ur_says_why_it_follows_nothing(ur, change, state, reason):
    vars(ur.fake).update(change)
    ur.period()
    status = ur.backend.status()
    assert status.state is state
    assert status.reason.startswith(reason)


def test_a_ur_recovers_from_a_protective_stop_with_its_program_loaded_again(ur):
    assert ur.fake.watchdog > 0.0, "its program ends where this process is gone"
    ur.fake.protect()
    ur.period()
    q = ur.backend.observe().q
    with pytest.raises(NotReady):
        ur.backend.command(q, np.zeros(6), 0.0)
    ur.backend.recover()
    assert ur.fake.running
    ur.backend.command(ur.backend.observe().q, np.zeros(6), 0.0)
    ur.close()
    assert not ur.fake.running


def test_a_ur_that_is_not_under_remote_control_does_not_recover(ur, monkeypatch):
    ur.fake.running = False
    monkeypatch.setattr(ur.fake, "reuploadScript", lambda: False)
    with pytest.raises(NotReady, match="set remote control"):
        ur.backend.recover()


def test_a_command_that_a_controller_does_not_take_is_an_arm_that_is_lost(ur, monkeypatch):
    monkeypatch.setattr(ur.fake, "servoJ", lambda *command: False)
    ur.backend.command(ur.backend.observe().q, np.zeros(6), 0.0)
    with pytest.raises(NotReady, match="did not take a command"):
        ur.period()


def test_an_xarm_that_its_controller_stopped_says_so_and_recovers(xarm):
    xarm.fake.collide()
    xarm.period()
    status = xarm.backend.status()
    assert status.state is State.PROTECTIVE_STOP
    assert "error 31" in status.reason
    xarm.backend.recover()
    assert xarm.backend.status().state is State.HOLDING
    xarm.fake.mode = 0
    xarm.period()
    assert xarm.backend.status().state is State.WRONG_MODE


def test_an_xarms_gripper_goes_where_it_is_told(xarm):
    assert xarm.backend.observe().opening == pytest.approx(0.085)
    xarm.backend.command(xarm.backend.observe().q, np.zeros(7), 0.0425)
    soon(lambda: xarm.fake.pulses == pytest.approx(425.0))
    soon(lambda: xarm.driver.read().opening == pytest.approx(0.0425))


def test_an_xarm_that_reports_nothing_is_not_there(monkeypatch):
    monkeypatch.setattr(vendors.xarm, "FIRST_REPORT_S", 0.05)
    rig = rigs.faked_xarm()
    monkeypatch.setattr(rig.fake, "register_report_callback", lambda callback: True)
    with pytest.raises(RobotNotAnswering, match=r"no UFACTORY arm can be commanded at 192.*: it reports nothing"):
        rig.backend.connect()
