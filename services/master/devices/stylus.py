"""The master that a hand leads by a real haptic stylus, and that lets it feel how far it departs."""

from __future__ import annotations

import threading

import numpy as np

from lfd.motion.rotations import exp_map, log_map, multiply
from protocol.messages import Figure, Phase, RobotState, Vector3
from services.bus.arrays import vector3
from services.master.devices.controllers import actions, coupled
from services.master.devices.device import ZERO, Moment, Sample
from services.master.devices.phantom import PhantomStylus
from services.master.devices.profiles import Profiles
from services.master.feedback import Feedback
from services.master.haptics import HapticLoop, regularity
from services.process.clock import Clock
from services.process.master_devices import Phantom
from services.process.runner import TickStatistics
from sim.person.stylus import RATE_HZ


class StylusMaster:
    """Takes the stylus up where its clutch says so, while an episode is led or refined and its operator is present.

    Taken up, it goes on from the correction that the robot applies, wherever the hand is: nothing jumps, and the
    neutral place that the hand is drawn to is where it would add nothing. Its axes follow the operator's view, see
    `OperatorInput.yaw`, and turn only while it is let go: what was led stays where it is. There is no force on the way
    to the start, while the robot holds, and where the hand leads without a prediction.

    Args:
        stylus: the device; its own thread calls the force loop.
        settings: of the force.
        profiles: how it is read.
        clock: of the process.
    """

    name = "phantom"

    def __init__(self, stylus: PhantomStylus, settings: Phantom, profiles: Profiles, clock: Clock) -> None:
        self._stylus = stylus
        self._profile = profiles.of(stylus.controller())
        self._clock = clock
        self._feedback = Feedback(settings.stiffness, settings.damping, settings.force_limit)
        self._loop = HapticLoop(stylus, self._feedback, clock.now_ns())
        self._lock = threading.Lock()
        self._ticks = TickStatistics(RATE_HZ)
        self._due = clock.now_ns()
        self._engaged = False
        self._displacement = ZERO
        self._turn = self._turn_before = ZERO
        stylus.serve(self.frame)

    def frame(self) -> None:
        """One frame of the force loop, on the vendor's thread."""
        started = self._clock.now_ns()
        self._loop.frame(started)
        with self._lock:
            self._ticks.tick(self._due, started, self._clock.now_ns())
        self._due = started + round(1e9 / RATE_HZ)

    def step(self, moment: Moment) -> Sample:
        """Read the stylus, and say whether its force may go on."""
        controller = self._stylus.controller()
        robot = moment.teaching or moment.refining
        present = moment.operator is not None and moment.operator.present
        refining = moment.refining
        lever = self._profile.scale * (refining.master_gain if refining is not None else 1.0)
        self._feedback.contact.hear(refining, lever)
        if robot is None or not present or not coupled(controller, self._profile):
            self._engaged = False
            if moment.operator is not None and moment.operator.focused:
                self._stylus.yaw = moment.operator.yaw
        elif not self._engaged or robot.phase is not Phase.EXECUTE:
            self._take_up(robot, led=moment.teaching is not None)
        else:
            if refining is not None:
                self._loop.hear(moment.now_ns)
            self._read()
        newest = self._loop.newest
        vx, vy, vz = newest.stylus.velocity
        scale = self._profile.scale
        return Sample(
            displacement=self._displacement,
            velocity=(scale * vx, scale * vy, scale * vz) if self._engaged else ZERO,
            rotation=self._turn,
            force=newest.feedback,
            engaged=self._engaged,
            actions=actions(controller, self._profile),
            yaw=self._stylus.yaw,
            contact_energy=self._feedback.contact.energy_in,
        )

    def figures(self) -> tuple[Figure, ...]:
        """How regular the vendor's thread calls."""
        with self._lock:
            return regularity(self._ticks)

    def close(self) -> None:
        """Render nothing any more, and let go."""
        self._stylus.close()

    def _take_up(self, robot: RobotState, *, led: bool) -> None:
        """Go on from where the robot is, or, where the hand leads alone, from where the hand left off."""
        if not led:
            x, y, z = (offset / robot.master_gain for offset in robot.offset)
            self._displacement, self._turn = (x, y, z), robot.turn
        scale = self._profile.scale
        x, y, z = self._displacement
        self._feedback.restart()
        self._stylus.take_up((x / scale, y / scale, z / scale))
        self._turn_before = self._turn
        self._engaged = True

    def _read(self) -> None:
        x, y, z = self._loop.newest.stylus.position
        scale = self._profile.scale
        self._displacement = (scale * x, scale * y, scale * z)
        self._turn = _turned(self._turn_before, self._stylus.rotation(), self._profile.turn_scale)


def _turned(before: Vector3, by: Vector3, scale: float) -> Vector3:
    return vector3(log_map(multiply(exp_map(scale * np.array(by)), exp_map(np.array(before)))))
