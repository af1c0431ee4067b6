"""A motion under correction on a Franka: the maker's driver and protocol, its arm simulated in a process of its own.

What the arm does is measured at the arm, in its own time: on a busy machine that goes slower than the clock's.
"""

import os
import signal
import threading
import time

import numpy as np
import pytest

from protocol import messages, queries, topics
from protocol.messages import Mode, Phase
from protocol.queries import Accepted, EpisodeStarted
from services.bus.arrays import motion_to_wire
from services.bus.memory import MemoryNetwork
from services.process.backend import BackendSection
from services.process.clock import ManualClock
from services.process.config import Configuration, RobotSection
from services.process.robots import scene_of
from services.robot.assembly import kinematics_of
from services.robot.memory import Volatile
from services.robot.service import build
from services.robot.starts import Starts
from sim.tasks import described
from tests.services.predictions import announce
from tests.services.robot.backends.franka_arm import FrankaArm
from tests.system.harness import Command, Witness, eventually

pytestmark = [pytest.mark.system, pytest.mark.sim, pytest.mark.zenoh, pytest.mark.alone]

SECTION = RobotSection(scene="table", model="panda")
DURATION_S = 4.0


def start():
    """Where the arm stands, and its joints."""
    scene = scene_of(SECTION)
    kinematics = kinematics_of(scene, described(scene))
    return scene.start, Starts(kinematics, scene.start, scene.posture, 0.005).joints(scene.start)


@pytest.fixture
def arm():
    arm = FrankaArm(start()[1])
    yield arm
    arm.close()


def motion():
    """Up and back from where it stands, 15 cm in four seconds."""
    pose, n = start()[0], 75
    positions = np.tile(pose.position, (n, 1))
    along = np.linspace(0.0, 1.0, n)
    positions += 0.15 * (along**2 * (3.0 - 2.0 * along))[:, None] * np.array([-0.6, 0.0, 0.8])
    return motion_to_wire(positions, np.tile(pose.orientation, (n, 1)), DURATION_S)


class OwnTime(ManualClock):
    """The arm's time, once the maker's driver has it: what is promised is promised of that."""

    arm = None

    def now_ns(self):
        return super().now_ns() + (round(1e9 * self.arm.state.time.to_sec()) if self.arm is not None else 0)


class Desk:
    """An operator at a robot that is in this process: a step is taken a hundred times a second of the arm's time."""

    def __init__(self, host):
        self.clock = OwnTime()
        network = MemoryNetwork(self.clock)
        self.bus = network.bus()
        backend = BackendSection("franka", host)
        section = RobotSection(scene=SECTION.scene, model=SECTION.model, backend=backend)
        self.service = build(network.bus(), self.clock, Configuration(robot=section), Volatile())
        self.states = self.bus.subscribe(topics.ROBOT_STATE)
        self.errors, self.heard, self.epoch, self._on_time = [], [], 0, 0
        self.clock.arm = self.service._control.arm._backend._driver._robot
        self._due = self.clock.now_ns()
        self.epoch = self.ask(queries.ACQUIRE, queries.AcquireAuthority("ann")).epoch

    def ask(self, query, request):
        pending = self.bus.ask(query, request)
        self.run(0.01)
        return pending.poll()

    def execute(self, mode):
        announced = announce(self.bus, motion())
        started = self.ask(queries.EXECUTE, queries.Execute(self.epoch, mode, announced, DURATION_S))
        assert isinstance(started, EpisodeStarted), started

    def run(self, seconds, displacement=None):
        """Let time pass, with a master or without."""
        for _ in range(round(seconds * 100)):
            self.bus.publish(topics.AUTHORITY_RENEWAL, messages.AuthorityRenewal(holder="ann", epoch=self.epoch))
            if displacement is not None:
                state = messages.MasterState(
                    displacement=displacement, rotation=(0.0, 0.0, 0.0), engaged=True, holder="ann", epoch=self.epoch
                )
                self.bus.publish(topics.MASTER_STATE, state)
            commanded = self.service._control.arm._joints.q
            self.service.step(self.clock.now_ns())
            heard = [received.message for received in self.states.take()]
            self.heard += heard
            # What was commanded a period ago is to be where the arm is now, if it could be told in time.
            if self._on_time >= 20:
                self.errors.append(np.abs(np.array(heard[-1].q) - commanded).max())
            self._due += 10_000_000
            self._on_time = 0 if self.clock.now_ns() > self._due + 5_000_000 else self._on_time + 1
            while self.clock.now_ns() < self._due:
                time.sleep(0.0005)


@pytest.fixture
def desk(arm):
    desk = Desk(arm.host)
    yield desk
    desk.service.close()


def lead(desk):
    """A motion under correction, up to its middle."""
    desk.execute(Mode.REFINE)
    desk.run(1.0, (0.0, 0.0, 0.0))
    desk.errors.clear()
    desk.heard.clear()
    for share in np.linspace(0.0, 1.0, 100):
        desk.run(0.01, (0.0, 0.06 * float(share), 0.0))
    desk.run(0.5, (0.0, 0.06, 0.0))


def test_a_correction_is_applied_at_a_hundred_hertz_and_followed_within_twenty_milliradians(desk):
    lead(desk)
    assert desk.heard[-1].phase is Phase.EXECUTE, desk.heard[-1].hold_reason
    assert desk.heard[-1].offset[1] == pytest.approx(0.06, abs=0.005)
    offsets = np.array([state.offset[1] for state in desk.heard])
    assert np.count_nonzero(np.diff(offsets) > 1e-5) > 0.8 * 100, "it is corrected in every period, not in jumps"
    moved = desk.heard[-1].measured.position[1] - desk.heard[0].measured.position[1]
    assert moved == pytest.approx(0.06, abs=0.01)
    assert desk.errors, "this machine is too busy to command an arm"
    assert max(desk.errors) < 0.020


def test_it_holds_within_two_tenths_of_a_second_when_the_hand_is_not_heard_any_more(desk, arm):
    lead(desk)
    since = arm.now
    desk.run(1.0)
    assert desk.heard[-1].phase is Phase.HOLD
    assert arm.stood_after(since) < 0.2


def test_a_stop_stops_it_within_a_tenth_of_a_second(desk, arm):
    lead(desk)
    since = arm.now
    desk.bus.publish(topics.EMERGENCY_STOP, messages.EmergencyStop(pressed=True, by="ann"))
    desk.run(0.5, (0.0, 0.06, 0.0))
    assert desk.heard[-1].phase is Phase.STOPPED
    assert arm.stood_after(since) < 0.1


def test_a_reset_leads_it_back_to_its_start_slowly(desk, arm):
    lead(desk)
    desk.ask(queries.FINISH, queries.Finish(desk.epoch))
    desk.run(1.0, (0.0, 0.0, 0.0))
    away = np.abs(np.array(desk.heard[-1].q) - start()[1]).max()
    assert away > 0.05
    since = arm.now
    assert isinstance(desk.ask(queries.RESET, queries.Reset(desk.epoch)), Accepted)
    desk.run(0.5)
    assert desk.heard[-1].phase is Phase.HOMING
    desk.run(4.0)
    assert desk.heard[-1].phase is Phase.IDLE
    assert np.abs(np.array(desk.heard[-1].q) - start()[1]).max() < 0.01
    rows = arm.seen[arm.seen[:, 0] >= since]
    rows = rows[np.unique(rows[:, 0], return_index=True)[1]]  # a busy machine tells the same twice
    speeds = np.abs(rows[5:, 1:] - rows[:-5, 1:]) / (rows[5:, :1] - rows[:-5, :1])
    assert speeds.max() < 1.0, "less than half of what its slowest joint can do"


def test_when_the_robots_process_is_killed_in_a_motion_the_arm_stands(arm, router, bus, tmp_path):
    flags = ("--backend", "franka", "--host", arm.host, "--scene", SECTION.scene, "--robot-model", SECTION.model)
    over, station = threading.Event(), bus("station-ann")
    with Command("robot", *flags, "--connect", router, folder=tmp_path) as robot, Witness(router) as witness:
        witness.next(topics.SAFETY_STATE, within_s=60.0)
        asked = station.ask(queries.ACQUIRE, queries.AcquireAuthority("station", "ann"), 10.0)
        epoch = eventually(asked.poll, 10.0, "the authority").epoch

        def renew():
            while not over.wait(0.02):
                station.publish(topics.AUTHORITY_RENEWAL, messages.AuthorityRenewal(holder="station", epoch=epoch))

        present = threading.Thread(target=renew)
        present.start()
        try:
            asked = queries.Execute(epoch, Mode.AUTONOMOUS, announce(bus("model"), motion()), DURATION_S)
            started = eventually(lambda: begun(station, asked), 10.0, "the motion begins")
            assert isinstance(started, EpisodeStarted), started
            witness.next(topics.ROBOT_STATE, lambda state: state.phase is Phase.EXECUTE and state.progress > 0.4)
            moved, since = np.ptp(arm.seen[-20:, 1:], axis=0).max(), arm.now
            os.kill(robot.process.pid, signal.SIGKILL)
            arm.rest(0.5)
        finally:
            over.set()
            present.join()
    assert moved > 0.01, "it was killed in a motion"
    assert arm.stood_after(since) < 0.2


def begun(station, asked):
    """The robot's answer, once it has heard of the prediction."""
    pending = station.ask(queries.EXECUTE, asked, 5.0)
    answer = eventually(pending.poll, 6.0, "an answer")
    return None if isinstance(answer, queries.Refused) and "no prediction" in answer.reason else answer
