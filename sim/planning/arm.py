"""A robot in a task as a planner needs it: where it gets to, and whether it touches anything there.

Its physics is the simulator's, of which nothing moves here. Poses are the grasping frame's in the base frame.
"""

from collections.abc import Iterable
from itertools import product

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.pose import Pose
from sim.robots.gripper import GRASPING_FRAME
from sim.rotations import rotation_to
from sim.tasks import described
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import NO_ROTATION
from sim.world.assembly import assemble
from sim.world.staging import ENVIRONMENT, ROBOT, THING, select
from sim.world.things import OBJECT

Array = NDArray[np.float64]

_ITERATIONS = 100
_STEP = 0.2  # [rad] of a joint in one iteration
_POSITION_TOLERANCE, _TURN_TOLERANCE = 1e-3, 1e-2  # [m, rad]
_SETTLED = 1e-4  # [rad] by which a step still turns an arm of few joints once it is as near as it comes
_DAMPING = 1e-4
_POSTURE = 0.02  # share of the way back to the posture that a redundant arm takes in an iteration
_TURN, _SOFT = 0.3, 0.005  # weight of a turn beside a shift; of one that the arm cannot always have
_SELF = 0.01  # [m] that the robot keeps from itself
_SEEN = 0.06  # [m] within which distances are told
_LIMB_JOINTS, _FEWER, _SIX = 4, 3, 6  # as `services.robot.kinematics` pairs what can meet


class PlanningArm:
    """The robot of a task.

    Args:
        scene: The task, its robot in it.
    """

    def __init__(self, scene: ReachingScene) -> None:
        self.scene = scene
        self._model = model = assemble(scene, described(scene))
        self._data = mujoco.MjData(model)
        robot = scene.manipulator
        joints = [model.joint(name) for name in robot.joint_names]
        self._q = np.array([joint.qposadr[0] for joint in joints])
        self._dof = np.array([joint.dofadr[0] for joint in joints])
        limits = np.array([joint.range for joint in joints])
        self.lower: Array = limits[:, 0].copy()
        self.upper: Array = limits[:, 1].copy()
        self.posture: Array = np.clip(scene.posture, self.lower, self.upper)
        self._slack = robot.turn_slack
        self._frame = model.body(GRASPING_FRAME).id
        self._is_robot = (model.geom_contype & ROBOT) != 0
        model.geom_margin[self._is_robot] = _SEEN
        model.pair_margin[:] = _SEEN
        for name, position in robot.positions(scene.stance).items():
            self._data.qpos[model.joint(name).qposadr[0]] = position
        start = model.joint(OBJECT).qposadr[0]
        self._object = slice(start, start + 7)
        self._pairs = self._meeting()
        self.arrange(scene.variants[0], scene.training_positions[0])

    def arrange(self, variant: str, place: Array) -> None:
        """Let things stand as they do in a variant, the object at a place, shape (3,) [m]."""
        select(self._model, self.scene, variant)
        self._data.qpos[self._object] = [*place, *NO_ROTATION]

    def state(self, q: Array) -> Array:
        """Return all positions of the model, shape (nq,), of joint positions of shape (m,)."""
        self._place(q)
        return np.asarray(self._data.qpos.copy())

    def pose(self, q: Array) -> Pose:
        """Return where the grasping frame is, of joint positions of shape (m,)."""
        self._place(q)
        return Pose(self._data.xpos[self._frame].copy(), self._data.xquat[self._frame].copy())

    def solve(self, pose: Pose, seeds: Iterable[Array], slack: float = 0.0) -> Array | None:
        """Return joint positions for a pose, shape (m,); None where no seed leads there.

        Args:
            pose: That is wanted.
            seeds: Joint positions to begin with.
            slack: By how much the orientation may differ where the arm does not get nearer [rad].
        """
        for seed in seeds:
            q = self._descend(pose, np.clip(seed, self.lower, self.upper), max(slack, self._slack))
            if q is not None:
                return q
        return None

    def seeds(self, count: int = 12) -> Iterable[Array]:
        """Yield the task's posture, then others, always the same."""
        yield self.posture
        rng = np.random.default_rng(0)
        for _ in range(count):
            yield rng.uniform(self.lower, self.upper)

    def _descend(self, pose: Pose, q: Array, slack: float) -> Array | None:
        jacobian = np.zeros((6, self._model.nv))
        weights = np.array([1.0] * 3 + [_SOFT if self._slack else _TURN] * 3)
        before = np.inf
        for _ in range(_ITERATIONS):
            here = self.pose(q)
            shift = pose.position - here.position
            turn = rotation_to(here.orientation, pose.orientation)
            angle = float(np.linalg.norm(turn))
            near = float(np.linalg.norm(shift)) < _POSITION_TOLERANCE
            settled = angle < slack and abs(before - angle) < _SETTLED
            if near and (angle < _TURN_TOLERANCE or settled):
                return q
            before = angle
            mujoco.mj_jacBody(self._model, self._data, jacobian[:3], jacobian[3:], self._frame)
            step = self._step(q, weights[:, None] * jacobian[:, self._dof], weights * np.concatenate([shift, turn]))
            q = np.clip(q + step, self.lower, self.upper)
        return None

    def _step(self, q: Array, jacobian: Array, error: Array) -> Array:
        """Towards a pose; joints that are at a limit and would leave it stay, and the others do without them."""
        free = np.ones(len(q), dtype=bool)
        rest = _POSTURE * (self.posture - q)
        while True:
            usable = jacobian * free
            inverse = usable.T @ np.linalg.inv(usable @ usable.T + _DAMPING * np.eye(6))
            step = free * (inverse @ error + rest - inverse @ (usable @ rest))
            step *= min(1.0, _STEP / max(float(np.abs(step).max()), 1e-9))
            leaves = free & ((q + step < self.lower - 1e-9) | (q + step > self.upper + 1e-9))
            leaves &= (q <= self.lower + 1e-6) | (q >= self.upper - 1e-6)
            if not leaves.any():
                return np.asarray(step)
            free &= ~leaves

    def touches(self, q: Array, clearance: float, thing_clearance: float) -> bool:
        """Say whether the robot comes too near to anything.

        Args:
            q: Joint positions, shape (m,).
            clearance: From what stands around it [m].
            thing_clearance: From the objects [m].
        """
        self._place(q)
        mujoco.mj_collision(self._model, self._data)
        contact = self._data.contact
        if len(contact.dist):
            kinds = self._model.geom_contype[contact.geom]
            met = kinds[:, 0] | kinds[:, 1]
            limits = np.where(met & ENVIRONMENT, clearance, np.where(met & THING, thing_clearance, -np.inf))
            mine = self._is_robot[contact.geom].any(axis=1)
            if np.any(mine & (contact.dist < limits)):
                return True
        return self._self_distance() < _SELF

    def _place(self, q: Array) -> None:
        self._data.qpos[self._q] = q
        mujoco.mj_kinematics(self._model, self._data)
        mujoco.mj_comPos(self._model, self._data)

    def _self_distance(self) -> float:
        distances = (
            mujoco.mj_geomDistance(self._model, self._data, limb, part, _SEEN, None) for limb, part in self._pairs
        )
        return min(distances, default=_SEEN)

    def _meeting(self) -> list[tuple[int, int]]:
        """Shapes of the robot that can meet, limbs with the trunk, but for pairs that do at rest."""
        behind = [self._joints_before(int(body)) for body in self._model.geom_bodyid]
        least = _LIMB_JOINTS if len(self._dof) >= _SIX else _FEWER
        mine = np.flatnonzero(self._is_robot).tolist()
        limbs = [geom for geom in mine if behind[geom] >= least]
        trunk = [geom for geom in mine if behind[geom] <= 1]
        self._place(self.posture)
        return [
            (limb, part)
            for limb, part in product(limbs, trunk)
            if mujoco.mj_geomDistance(self._model, self._data, limb, part, _SEEN, None) > 0.0
        ]

    def _joints_before(self, body: int) -> int:
        """Of the commanded ones, between the world and a body."""
        count = 0
        while body:
            first, number = self._model.body_dofadr[body], self._model.body_dofnum[body]
            count += int(np.isin(range(first, first + number), self._dof).sum())
            body = int(self._model.body_parentid[body])
        return count
