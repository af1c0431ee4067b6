"""The backend on the simulated world: time passes by commands alone."""

import numpy as np
from numpy.typing import NDArray

from services.robot.backends.backend import CONTROL_PERIOD, Blocked, NativeLimits, Observation, Status, Touch
from services.robot.backends.gate import Gate
from sim.pose import Pose
from sim.world.physics import World

Array = NDArray[np.float64]


class Simulation:
    """Drives a world one control period a command; where none comes any more its arm holds, as hardware does.

    Args:
        world: that it owns from now on.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        self._gate = Gate(self.joint_names, lambda: world.observe().q)
        self._periods = 0
        self._opening = world.scene.manipulator.gripper.opening
        self._allowed = world.scene.success
        self._stand()

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Of the robot that stands in the world."""
        return self._world.scene.manipulator.joint_names

    @property
    def limits(self) -> NativeLimits:
        """The ends of the simulated joints; its servos are as fast as they can be."""
        lower, upper = self._world.joint_range
        unlimited = np.full_like(lower, np.inf)
        return NativeLimits(lower, upper, unlimited, unlimited, unlimited)

    @property
    def variant(self) -> str:
        """Of the scene."""
        return self._world.variant

    def connect(self) -> None:
        """The world is there already."""
        self._gate.connect()

    def close(self) -> None:
        """Nothing moves without periods that elapse."""
        self._gate.close()

    def status(self) -> Status:
        """As it was told: simulated hardware does not fail."""
        return self._gate.status(self._now)

    def hold(self) -> None:
        """The servos' references are where the joints are."""
        self._gate.hold()
        self._stand()

    def stop(self, reason: str) -> None:
        """As `hold`, until `recover`."""
        self._gate.stop(reason)
        self._stand()

    def recover(self) -> None:
        """What stopped it was said, and no more than that."""
        self._gate.recover()

    def reset(self, place: Array, variant: str, q: Array) -> None:
        """Put everything back, time included; as it was where the arm would touch something."""
        world = self._world
        before, state = world.variant, world.state
        world.reset(place, variant, q)
        touch = self.observe().touch
        if touch is not None:
            world.reset(place, before, q)
            world.set_state(state)
            raise Blocked(*touch.between)
        self._gate.hold()
        self._opening = world.scene.manipulator.gripper.opening
        self._allowed = world.scene.success
        self._stand()

    def command(self, q: Array, qd: Array, opening: float) -> None:
        """The references of the servos."""
        self._gate.admit(q, self._now)
        self._command, self._opening, self._commanded = (q.copy(), qd.copy()), opening, True

    def elapse(self) -> None:
        """Ten milliseconds of physics."""
        if self._commanded and self._gate.silent(self._now):
            self._stand()
        self._world.step(*self._command, self._opening)
        self._periods += 1

    def observe(self) -> Observation:
        """Sensors and truth, which are one in simulation."""
        seen = self._world.observe()
        counts = (one for one in seen.contacts if not self._allowed.allows(one.environment_geom, one.force))
        strongest = max(counts, key=lambda contact: contact.force, default=None)
        touch = None
        if strongest is not None:
            between = (strongest.robot_geom, strongest.environment_geom)
            touch = Touch(strongest.position, strongest.force, between)
        return Observation(
            time=seen.time,
            q=seen.q,
            qd=seen.qd,
            object_pose=Pose(seen.object_position, seen.object_orientation),
            touch=touch,
            world=self._world.state,
            contact_force=seen.contact_force,
            opening=seen.opening,
            grasped=seen.grasped,
        )

    @property
    def _now(self) -> float:
        """Of the periods that have elapsed, resets or not [s]."""
        return self._periods * CONTROL_PERIOD

    def _stand(self) -> None:
        """Let the servos keep what is measured, and the gripper what it was told: it must not drop what it has."""
        q = self._world.observe().q
        self._command, self._commanded = (q, np.zeros_like(q)), False
