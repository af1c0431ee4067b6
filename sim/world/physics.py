"""The simulated arm in its scene: reset, step, observe."""

from collections.abc import Sequence
from dataclasses import dataclass

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.robots.description import RobotDescription
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import NO_ROTATION
from sim.world.assembly import TIMESTEP, assemble
from sim.world.contacts import Contact, clearance, collisions, strongest
from sim.world.grip import Grip
from sim.world.staging import select
from sim.world.things import OBJECT

Array = NDArray[np.float64]

CONTROL_PERIOD = 0.010  # [s]
_STEPS = round(CONTROL_PERIOD / TIMESTEP)


@dataclass(frozen=True, eq=False)
class Observation:
    """What the robot's own sensors and the simulator's referee see at one instant.

    Attributes:
        time: Simulated time since the reset [s].
        q: Joint positions, in the order of the robot's, shape (m,) [m, rad].
        qd: Joint velocities, shape (m,) [m/s, rad/s].
        object_position: Centre of the object in the base frame, shape (3,) [m].
        object_orientation: Scalar first, shape (4,).
        contacts: Of the robot with its environment, at any step of physics in the last control period: of each link
            and box that met the one with the largest force.
        contact_force: Of the environment on the robot, in the base frame, the mean over the last control period,
            shape (3,) [N].
        opening: Between the gripper's fingers [m].
        grasped: Both fingers touched the object at some step of physics in the last control period.
    """

    time: float
    q: Array
    qd: Array
    object_position: Array
    object_orientation: Array
    contacts: tuple[Contact, ...]
    contact_force: Array
    opening: float
    grasped: bool


class World:
    """One arm in one scene.

    Args:
        scene: What stands around the robot.
        variant: Of the scene, at first.
        description: The robot.

    Raises:
        UnknownVariant: The scene has no such variant.
    """

    def __init__(self, scene: ReachingScene, variant: str, description: RobotDescription) -> None:
        scene.check(variant)
        self.scene = scene
        self.variant = variant
        _keep_log_out_of_working_directory()
        self._model = assemble(scene, description)
        self._data = mujoco.MjData(self._model)
        robot = scene.manipulator
        joints = [self._model.joint(name) for name in robot.joint_names]
        self._q = np.array([joint.qposadr[0] for joint in joints])
        self._qd = np.array([joint.dofadr[0] for joint in joints])
        self._grip = Grip(self._model, robot.gripper, OBJECT)
        self._held = np.array([self._model.joint(name).qposadr[0] for name in robot.held_names], dtype=int)
        self._lag = np.array([joint.lag for joint in robot.joints])
        start = self._model.joint(OBJECT).qposadr[0]
        self._object = slice(start, start + 7)
        stiffness, damping = np.array([(joint.stiffness, joint.damping) for joint in robot.joints]).T
        self._lead = (damping + self._model.dof_damping[self._qd]) / stiffness  # [s]
        self.reset(scene.training_positions[0])

    def reset(self, object_position: Array, variant: str | None = None, q: Array | None = None) -> None:
        """Put everything back: the arm at rest, the object upright, the time at zero.

        Args:
            object_position: Centre of the object in the base frame, shape (3,) [m].
            variant: Of the scene; as it was by default.
            q: Joint positions, shape (m,) [m, rad]; the scene's start by default.

        Raises:
            UnknownVariant: The scene has no such variant.
        """
        if variant is not None:
            self.scene.check(variant)
            self.variant = variant
        select(self._model, self.scene, self.variant)
        mujoco.mj_resetData(self._model, self._data)
        qpos = self._data.qpos
        qpos[self._q] = self.scene.posture if q is None else q
        qpos[self._held] = self.scene.stance.held
        qpos[self._object] = [*object_position, *NO_ROTATION]
        self._data.ctrl[: len(self._q)] = qpos[self._q]
        self._data.ctrl[len(self._q) : len(self._q) + len(self._held)] = self.scene.stance.held
        self._grip.open(self._data)
        self._contact_force = np.zeros(3)
        self._grasped = False
        self._look()

    def step(self, q_reference: Array, qd_reference: Array, opening: float) -> None:
        """Advance one control period of 10 ms.

        The reference position holds at the period's end; the velocity leads the servos, which would
        lag by their damping otherwise.

        Args:
            q_reference: Joint positions, shape (m,) [m, rad].
            qd_reference: Joint velocities, shape (m,) [m/s, rad/s].
            opening: That the gripper goes to, by its force and at its speed [m].
        """
        self._grasped = False
        found: list[Contact] = []
        for remaining in reversed(range(_STEPS)):
            q = self._data.qpos[self._q]
            error = q_reference - remaining * TIMESTEP * qd_reference - q
            # A blocked joint is not pushed on by the velocity that it cannot have.
            # Not by np.clip: of so few numbers it takes five times as long.
            free = np.minimum(np.maximum(2.0 - np.abs(error) / self._lag, 0.0), 1.0)
            pull = np.minimum(np.maximum(error, -self._lag), self._lag) + free * self._lead * qd_reference
            self._data.ctrl[: len(self._q)] = q + pull
            self._grip.pull(self._data, opening)
            mujoco.mj_step(self._model, self._data)
            self._grasped = self._grasped or self._grip.holds(self._data)
            found.extend(collisions(self._model, self._data))
        self._contact_force = sum((contact.push for contact in found), start=np.zeros(3)) / _STEPS
        # mj_step leaves poses and contacts one step behind the joints.
        self._look(found)

    def observe(self) -> Observation:
        """Return what there is to be seen now."""
        pose = self._data.qpos[self._object]
        return Observation(
            time=float(self._data.time),
            q=self._data.qpos[self._q].copy(),
            qd=self._data.qvel[self._qd].copy(),
            object_position=pose[:3].copy(),
            object_orientation=pose[3:].copy(),
            contacts=self._contacts,
            contact_force=self._contact_force,
            opening=self._grip.opening(self._data),
            grasped=self._grasped,
        )

    @property
    def joint_range(self) -> tuple[Array, Array]:
        """Least and greatest position of each joint, each of shape (m,) [m, rad]."""
        ranges = [self._model.joint(name).range for name in self.scene.manipulator.joint_names]
        lower, upper = np.array(ranges).T
        return lower, upper

    @property
    def state(self) -> Array:
        """All positions of the model, shape (nq,): enough to draw the world elsewhere."""
        state: Array = self._data.qpos.copy()
        return state

    def set_state(self, qpos: Array) -> None:
        """Put the world, at rest, where another one's `state` says.

        Args:
            qpos: All positions of the model, shape (nq,).
        """
        self._data.qpos[:] = qpos
        self._data.qvel[:] = 0.0
        self._contact_force = np.zeros(3)
        self._grasped = False
        self._look()

    def clearance(self, limit: float = 0.1) -> float:
        """Return the smallest distance between robot and environment, at most `limit` [m]."""
        return clearance(self._model, self._data, limit)[0]

    def _look(self, before: Sequence[Contact] = ()) -> None:
        """Bring poses and contacts up to date; those before, of the same period, count too."""
        mujoco.mj_forward(self._model, self._data)
        self._contacts = strongest((*before, *collisions(self._model, self._data)))


def _keep_log_out_of_working_directory() -> None:
    """Stop MuJoCo from writing MUJOCO_LOG.TXT wherever the process happens to run."""
    log = mujoco.MjLogConfig.get()
    log.logto_file = False
    log.set()
