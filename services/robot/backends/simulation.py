"""The backend on the simulated world: time passes by commands alone."""

import numpy as np
from numpy.typing import NDArray

from services.robot.backends.backend import Blocked, Observation, Touch
from sim.pose import Pose
from sim.world.physics import World

Array = NDArray[np.float64]


class Simulation:
    """Drives a world one control period a command; a skipped command only lets the simulated time lag.

    Args:
        world: that it owns from now on.
    """

    def __init__(self, world: World) -> None:
        self._world = world
        q = world.observe().q
        self._command = q, np.zeros_like(q), world.scene.manipulator.gripper.opening

    @property
    def joint_names(self) -> tuple[str, ...]:
        """Of the robot that stands in the world."""
        return self._world.scene.manipulator.joint_names

    @property
    def variant(self) -> str:
        """Of the scene."""
        return self._world.variant

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

    def command(self, q: Array, qd: Array, opening: float) -> None:
        """The references of the servos."""
        self._command = q.copy(), qd.copy(), opening

    def elapse(self) -> None:
        """Ten milliseconds of physics."""
        self._world.step(*self._command)

    def observe(self) -> Observation:
        """Sensors and truth, which are one in simulation."""
        seen = self._world.observe()
        strongest = max(seen.contacts, key=lambda contact: contact.force, default=None)
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
