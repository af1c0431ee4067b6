"""Each backend on what it drives, for the tests of what all of them promise."""

import time

from services.process.clock import ManualClock, SystemClock
from services.robot.assembly import kinematics_of
from services.robot.backends.hardware import Hardware, driver_of
from services.robot.backends.particle import ParticleBackend
from services.robot.backends.simulation import Simulation
from services.robot.backends.vendors import ur, xarm
from sim.robots.catalogue import robot
from sim.robots.description import prepare
from sim.tasks import PARTICLE, TABLE
from sim.world.physics import World
from tests.services.robot.backends.fakes_ur import FakeUr
from tests.services.robot.backends.fakes_xarm import FakeXArm


class Rig:
    """A backend, and how its time passes: here by its periods alone."""

    def __init__(self, backend):
        self.backend = backend

    def period(self):
        self.backend.elapse()

    def rest(self, seconds):
        """Let time pass without a command."""
        for _ in range(round(seconds / 0.01)):
            self.period()

    def close(self):
        self.backend.close()


def simulation():
    world = World(TABLE, TABLE.variants[0], prepare())
    world.reset(TABLE.training_positions[0], q=kinematics_start())
    return Rig(Simulation(world))


def kinematics_start():
    kinematics = kinematics_of(TABLE, prepare())
    from services.robot.starts import Starts

    return Starts(kinematics, TABLE.start, TABLE.posture, 0.005).joints(TABLE.start)


def particle():
    return Rig(ParticleBackend(PARTICLE, PARTICLE.variants[0]))


class Faked(Rig):
    """Hardware whose maker's library is faked, and whose clock is moved by hand."""

    def __init__(self, fake, driver, kind):
        self.clock = ManualClock()
        self.fake = fake(self.clock)
        self.driver = driver(self.fake, self.clock)
        super().__init__(Hardware(self.driver, "192.0.2.1", robot(kind), variant="", yaw=0.0, clock=self.clock))

    def period(self):
        assert self.driver._sender is None or self.driver._sender.wait(10.0)
        self.clock.advance(0.01)
        self.fake.tick()
        self.backend.observe()


def faked_ur():
    return Faked(FakeUr, lambda fake, clock: ur.Driver(fake), "ur5")


def faked_xarm():
    return Faked(FakeXArm, lambda fake, clock: xarm.Driver(fake, lambda: clock.now_ns() / 1e9), "xarm7")


class Franka:
    """The maker's own driver, against a simulated arm that speaks its protocol: time passes by itself."""

    def __init__(self, arm):
        self._arm = arm
        driver, panda = driver_of("franka"), robot("panda")
        self.backend = Hardware(driver, arm.host, panda, variant="", yaw=0.0, clock=SystemClock())
        self._due = time.monotonic()

    def period(self):
        self.backend.elapse()
        self._due = max(self._due + 0.01, time.monotonic())
        time.sleep(max(0.0, self._due - time.monotonic()))

    def rest(self, seconds):
        time.sleep(seconds)
        self._arm.rest(seconds)

    def close(self):
        self.backend.close()
