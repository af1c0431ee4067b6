"""A robot process with the particle, an operator and a clock that is moved by hand: quick, and without a simulator."""

from concurrent.futures import Executor, Future
from datetime import UTC, datetime, timedelta
from pathlib import Path

import numpy as np

from protocol import messages, queries, topics
from protocol.messages import Mode
from protocol.queries import EpisodeStarted
from services.bus.arrays import motion_to_wire
from services.evidence.ledger import Unkept
from services.robot.assembly import kinematics_of, simulated_arm
from services.robot.control import Control
from services.robot.memory import Volatile
from services.robot.safety import Watchdog
from services.robot.service import RobotService
from services.robot.timed_kinematics import TimedKinematics
from sim.robots.description import RobotDescription
from sim.tasks import PARTICLE
from tests.services.predictions import announce
from tests.services.robot.operated import Operated

FREE, OBSTACLE = PARTICLE.variants
MORNING = datetime(2026, 3, 1, 8, 0, tzinfo=UTC)
IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])
NO_DESCRIPTION = RobotDescription(Path("a particle needs none"))


class AtOnce(Executor):
    """Does what it is given before it returns."""

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        try:
            future.set_result(fn(*args, **kwargs))
        except OSError as error:
            future.set_exception(error)
        return future


class Later(Executor):
    """Does what it is given when it is told to."""

    def __init__(self):
        self.waiting = []

    def submit(self, fn, /, *args, **kwargs):
        future = Future()
        self.waiting.append((future, fn, args, kwargs))
        return future

    def catch_up(self):
        while self.waiting:
            future, fn, args, kwargs = self.waiting.pop(0)
            future.set_result(fn(*args, **kwargs))

    def fail(self, error):
        """All of it fails."""
        while self.waiting:
            self.waiting.pop(0)[0].set_exception(error)


class Site(Operated):
    """See the module."""

    def __init__(self, memory=None, *, ledger=None, master_gain=1.0, kinematics=None, morning=MORNING, arm=None):
        self.morning = morning

        def build(bus, clock):
            timed = TimedKinematics(clock, kinematics or kinematics_of(PARTICLE, NO_DESCRIPTION))
            self.arm = arm or simulated_arm(PARTICLE, FREE, NO_DESCRIPTION, kinematics=timed)
            self.control = Control(
                self.arm,
                PARTICLE,
                lease_s=1.0,
                watchdog=Watchdog(hold_after_s=0.1, presence_after_s=0.2),
                master_gain=master_gain,
                memory=memory or Volatile(),
                utc=self.utc,
            )
            return RobotService(bus, clock, self.control, timed, ledger or Unkept())

        super().__init__(build)
        self.states = self.operator.subscribe(topics.ROBOT_STATE)
        self.results = self.operator.subscribe(topics.EPISODE_RESULT)
        self.safety_states = self.operator.subscribe(topics.SAFETY_STATE)
        self.authority_states = self.operator.subscribe(topics.AUTHORITY_STATE)

    def utc(self):
        return self.morning + timedelta(microseconds=self.clock.now_ns() // 1000)

    def ask_to_execute(self, mode=Mode.AUTONOMOUS, motion=None):
        motion = straight() if motion is None else motion
        return self.ask(
            queries.EXECUTE, queries.Execute(self.epoch, mode, announce(self.operator, motion), motion.duration)
        )

    def execute(self, mode=Mode.AUTONOMOUS, motion=None):
        started = self.ask_to_execute(mode, motion)
        assert isinstance(started, EpisodeStarted), started
        return started.episode

    def finish(self):
        return self.ask(queries.FINISH, queries.Finish(self.epoch))

    def press(self, by="bob", reason="smoke"):
        self.operator.publish(topics.EMERGENCY_STOP, messages.EmergencyStop(pressed=True, by=by, reason=reason))
        self.run(0.01)

    def release(self, by="ann"):
        return self.ask(queries.RELEASE_STOP, queries.ReleaseStop(by))

    @property
    def state(self):
        return self.states.latest().message

    @property
    def safety(self):
        return self.safety_states.latest().message

    @property
    def result(self):
        received = self.results.latest()
        return received.message if received else None


def straight(duration=1.0, n=75, length=0.4, opening=None):
    """A motion along x from the particle's start."""
    positions = np.column_stack([np.linspace(0.0, length, n), np.zeros(n), np.zeros(n)])
    return motion_to_wire(positions, np.tile(IDENTITY, (n, 1)), duration, opening)
