import subprocess
import sys

import msgspec
import pytest

from protocol.messages import AuthorityState, Mode, OperatorInput, Phase, Pose, RobotState
from protocol.topics import AUTHORITY_STATE, MASTER_STATE, OPERATOR_INPUT, ROBOT_STATE
from services.bus.memory import MemoryNetwork
from services.master.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration

POSE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
REFINING = RobotState(measured=POSE, reference=POSE, phase=Phase.EXECUTE, mode=Mode.REFINE, episode=1)
PERIOD = 0.01


class Desk:
    """A master with a keyboard, and whoever talks to it."""

    def __init__(self):
        self.clock = ManualClock()
        network = MemoryNetwork(self.clock)
        self.others = network.bus()
        self.states = network.bus().subscribe(MASTER_STATE)
        self.service = build(network.bus(), self.clock, Configuration())
        self.listen()

    def listen(self):
        """The time in which a new process says nothing."""
        for _ in range(30):
            self.service.step(self.clock.now_ns())
            assert self.states.latest() is None
            self.clock.advance(PERIOD)

    def run(self, seconds, keys=("KeyQ",), page=True, robot=REFINING, holder="ada"):
        for _ in range(round(seconds / PERIOD)):
            self.clock.advance(PERIOD)
            if page:
                self.others.publish(OPERATOR_INPUT, OperatorInput(keys=keys, focused=True))
            if robot is not None:
                self.others.publish(ROBOT_STATE, robot)
            if holder is not None:
                self.others.publish(AUTHORITY_STATE, AuthorityState(holder=holder, epoch=7, expires_in=1.0))
            self.service.step(self.clock.now_ns())
        return self.states.latest().message


def test_it_publishes_at_the_topics_rate_though_nobody_is_there():
    desk = Desk()
    assert desk.service.rate_hz == MASTER_STATE.rate_hz
    state = desk.run(0.1, holder=None, page=False)
    assert (state.sequence, state.engaged, state.epoch, state.device) == (10, False, 0, "keyboard")


def test_a_held_key_moves_the_device_and_the_epoch_stands_in_the_state():
    state = Desk().run(1.0, keys=("KeyQ", "KeyG"))
    assert state.displacement == pytest.approx((0.12, 0.0, 0.0), abs=0.002)
    assert state.rotation == pytest.approx((0.0, -0.4, 0.0), abs=0.006)
    assert state.engaged
    assert state.epoch == 7


def test_nobody_with_authority_means_nobody_at_the_device():
    assert not Desk().run(0.5, holder="").engaged
    assert not Desk().run(0.5, holder=None).engaged


def test_the_page_gone_means_zero_within_the_stale_time_and_a_moment():
    desk = Desk()
    desk.run(1.0)
    stale = OPERATOR_INPUT.stale_after_ns / 1e9
    assert desk.run(stale, page=False).engaged
    assert not desk.run(0.02, page=False).engaged
    state = desk.run(0.2, page=False)
    assert state.displacement == (0.0, 0.0, 0.0)


def test_without_hearing_the_robot_it_is_silent_so_that_the_robot_holds():
    desk = Desk()
    desk.run(0.5)
    desk.run(0.3, robot=None)
    silent_from = desk.states.latest()
    desk.run(0.3, robot=None)
    assert desk.states.latest() is silent_from
    held = msgspec.structs.replace(REFINING, offset=(0.06, 0.0, 0.0))
    assert desk.run(0.01, keys=(), robot=held).displacement == pytest.approx((0.06, 0.0, 0.0), abs=1e-3)


def test_a_process_that_stood_still_does_not_make_up_for_it():
    desk = Desk()
    before = desk.run(0.5).displacement[0]
    desk.clock.advance(5.0)
    assert desk.run(0.01).displacement[0] - before <= 0.12 * 0.1 + 1e-9


def test_a_keyboard_needs_no_simulation_and_no_numerics():
    code = "import sys, services.master.service; print([m for m in sys.modules if m.split('.')[0] in ('sim', 'scipy')])"
    result = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=True, timeout=30)
    assert result.stdout.strip() == "[]"
