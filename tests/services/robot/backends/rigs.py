"""Each backend on what it drives, for the tests of what all of them promise."""

import time

from services.process.clock import SystemClock
from services.robot.assembly import kinematics_of
from services.robot.backends.hardware import Hardware, driver_of
from services.robot.backends.particle import ParticleBackend
from services.robot.backends.simulation import Simulation
from sim.robots.catalogue import robot
from sim.robots.description import prepare
from sim.tasks import PARTICLE, TABLE
from sim.world.physics import World


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


class Real:
    """Hardware, whose time passes by itself."""

    def __init__(self, driver, kind, host="192.0.2.1"):
        self.backend = Hardware(driver, host, robot(kind), variant="", yaw=0.0, clock=SystemClock())
        self._due = time.monotonic()

    def period(self):
        self.backend.elapse()
        self._due = max(self._due + 0.01, time.monotonic())
        time.sleep(max(0.0, self._due - time.monotonic()))

    def rest(self, seconds):
        time.sleep(seconds)

    def close(self):
        self.backend.close()


class Franka(Real):
    """The maker's own driver, against a simulated arm that speaks its protocol."""

    def __init__(self, arm):
        self._arm = arm
        super().__init__(driver_of("franka"), "panda", arm.host)

    def rest(self, seconds):
        super().rest(seconds)
        self._arm.rest(seconds)
