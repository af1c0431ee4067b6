"""Kinematics of all joints that are commanded: Pinocchio for the model, Pink for the inverse."""

from collections.abc import Sequence
from functools import partial
from itertools import product
from pathlib import Path

import coal
import numpy as np
import pink
import pinocchio as pin
from numpy.typing import NDArray
from pink.exceptions import PinkError
from pink.limits import ConfigurationLimit, Limit, VelocityLimit
from pink.tasks import FrameTask, PostureTask
from qpsolvers.exceptions import QPError

from services.robot.correction import Correction
from services.robot.limiter import braking_speed
from services.robot.mechanism import InverseFailed, JointsInOtherOrder, Unreachable
from sim.pose import Pose
from sim.robots.catalogue import DEFAULT
from sim.robots.gripper import GRASPING_FRAME
from sim.robots.robot import Manipulator

Array = NDArray[np.float64]

_SOLVER = "daqp"
_POSITION_COST = 1.0  # [cost] / [m]
_ORIENTATION_COST = 0.1  # [cost] / [rad]: at a joint limit the orientation gives way first
_SOFT_ORIENTATION_COST = 0.005  # [cost] / [rad]: of an arm that cannot have any: it takes no millimetre of the position
_POSTURE_COST = 1e-3  # [cost] / [rad]: only what the frame leaves free
_POSTURE_S = 0.25  # [s] in which the posture is drawn to where it is to be
_LM_DAMPING = 1e-6
_SOLVE_DT = 0.5  # [s]: long enough that the speed limits do not bind in a search
_SOLVE_ITERATIONS = 60
_POSITION_TOLERANCE = 1e-4  # [m]
_ORIENTATION_TOLERANCE = 1e-3  # [rad]
_RANDOM_STARTS = 12
_SETTLED = 1e-4  # [rad] by which a step still turns an arm of few joints once it is as near as it comes

_TRUNK_JOINTS = 1  # that carry a part of the trunk, at most
_LIMB_JOINTS, _FEWER = 4, 3  # that carry a limb, at least; of an arm of less than six joints
_SIX = 6
_WEIGHTS = np.array([[1.0], [1.0], [1.0], [0.2], [0.2], [0.2]])  # of metres and radians [m]


class Kinematics:
    """Forward and inverse kinematics of the grasping frame, and the distance of the robot to itself.

    Joint vectors have shape (m,), in the order of the robot's joints [rad, or m]; the other joints are held where the
    robot says. One object serves one thread.

    Args:
        urdf: The robot's description.
        posture: Configuration that the redundant joint is drawn to; the middle of the ranges by default.
        robot: That is described.
    """

    def __init__(self, urdf: Path, posture: Array | None = None, robot: Manipulator = DEFAULT) -> None:
        full, geometry = _load(urdf)
        held = [full.getJointId(name) for name in full.names[1:] if name not in robot.joint_names]
        self._model, (self._geometry,) = pin.buildReducedModel(full, [geometry], held, _at_rest(full, robot))
        if tuple(self._model.names[1:]) != robot.joint_names:
            raise JointsInOtherOrder(tuple(self._model.names[1:]), robot.joint_names)
        self._data = self._model.createData()
        self._frame = self._model.getFrameId(GRASPING_FRAME)
        self.lower: Array = self._model.lowerPositionLimit.copy()
        self.upper: Array = self._model.upperPositionLimit.copy()
        self.velocity_limit: Array = self._model.velocityLimit.copy()
        self.acceleration_limit: Array = np.array([joint.acceleration for joint in robot.joints])
        self.jerk_limit: Array = np.array([joint.jerk for joint in robot.joints])

        self._configuration = pink.Configuration(self._model, self._data, (self.lower + self.upper) / 2)
        self.turn_slack = robot.turn_slack
        cost = _SOFT_ORIENTATION_COST if robot.turn_slack else _ORIENTATION_COST
        self._pose_task = FrameTask(GRASPING_FRAME, _POSITION_COST, cost, _LM_DAMPING)
        # A joint that gains speed slowly is moved less.
        slow = np.sqrt(self.acceleration_limit.max() / self.acceleration_limit)
        self._posture_task = PostureTask((_POSTURE_COST * slow).tolist())
        self._limits = (_Steps(self),)
        # A search goes nowhere that has to be braked from: what a motion keeps to would only keep it from arriving.
        self._search_task = PostureTask(_POSTURE_COST)
        self._search_limits = (ConfigurationLimit(self._model, config_limit_gain=1.0), VelocityLimit(self._model))
        for task in (self._posture_task, self._search_task):
            task.set_target((self.lower + self.upper) / 2 if posture is None else posture)
        self._geometry_data = _pair_up(self._model, self._geometry, robot)

    def forward(self, q: Array) -> Pose:
        """Return the pose of the grasping frame in the base frame.

        Args:
            q: Joint positions, shape (m,).
        """
        pin.forwardKinematics(self._model, self._data, q)
        return _pose(pin.updateFramePlacement(self._model, self._data, self._frame))

    def admitted(self, wanted: Correction) -> Correction:
        """All of it."""
        return wanted

    def solve_step(self, q: Array, position: Array, orientation: Array, dt: float) -> tuple[Array, Array]:
        """Move one tick towards a pose: one iteration of differential inverse kinematics.

        Args:
            q: Joint positions, shape (m,).
            position: Of the grasping frame, shape (3,) [m].
            orientation: Of the grasping frame, scalar first, shape (4,).
            dt: Duration of the tick [s]; speeds stay within the joints' limits over it.

        Returns:
            Next joint positions and the velocities that lead there, each of shape (m,).

        Raises:
            InverseFailed: The solver found no step.
        """
        self._posture_task.gain = min(1.0, dt / _POSTURE_S)
        q_next = self._step(q, _placement(position, orientation), dt, self._posture_task, self._limits)
        return q_next, (q_next - q) / dt

    def _step(self, q: Array, target: pin.SE3, dt: float, posture: PostureTask, limits: tuple[Limit, ...]) -> Array:
        self._pose_task.set_target(target)
        try:
            self._configuration.update(np.clip(q, self.lower, self.upper))
            velocity = pink.solve_ik(self._configuration, (self._pose_task, posture), dt, _SOLVER, limits=limits)
        except (PinkError, QPError) as error:
            raise InverseFailed(str(error).splitlines()[0]) from error
        q_next: Array = np.clip(q + velocity * dt, self.lower, self.upper)
        return q_next

    def solve(self, position: Array, orientation: Array, seeds: Sequence[Array], rng: np.random.Generator) -> Array:
        """Find joint positions for a pose, from several starts.

        Most misses of one start are local minima at joint limits, so a few random ones follow the seeds.

        Args:
            position: Of the grasping frame, shape (3,) [m].
            orientation: Of the grasping frame, scalar first, shape (4,).
            seeds: Configurations to start from first, each of shape (m,).
            rng: Source of the random starts.

        Returns:
            Joint positions, shape (m,).

        Raises:
            Unreachable: No start led there.
        """
        randoms = (rng.uniform(self.lower, self.upper) for _ in range(_RANDOM_STARTS))
        for start in (*seeds, *randoms):
            q = self._descend(np.clip(start, self.lower, self.upper), position, orientation)
            if q is not None:
                return q
        raise Unreachable(position)

    def _descend(self, q: Array, position: Array, orientation: Array) -> Array | None:
        target = _placement(position, orientation)
        before = np.inf
        for _ in range(_SOLVE_ITERATIONS):
            pin.forwardKinematics(self._model, self._data, q)
            actual = pin.updateFramePlacement(self._model, self._data, self._frame)
            error = pin.log6(actual.actInv(target)).vector
            reached = np.linalg.norm(error[:3]) < _POSITION_TOLERANCE
            turn = float(np.linalg.norm(error[3:]))
            if reached and turn < _ORIENTATION_TOLERANCE:
                return q
            if reached and turn < self.turn_slack and abs(before - turn) < _SETTLED:
                return q
            before = turn
            try:
                q = self._step(q, target, _SOLVE_DT, self._search_task, self._search_limits)
            except InverseFailed:
                return None
        return None

    def dexterity(self, q: Array) -> float:
        """Return the ratio of the least to the greatest singular value of the grasping frame's Jacobian.

        A radian of the frame counts as 0.2 m; of an arm of less than six joints its position alone counts.

        Args:
            q: Joint positions, shape (m,).
        """
        jacobian = pin.computeFrameJacobian(self._model, self._data, q, self._frame, pin.LOCAL)
        rows = jacobian * _WEIGHTS if len(q) >= _SIX else jacobian[:3]
        values = np.linalg.svd(rows, compute_uv=False)
        return float(values[-1] / values[0])

    def self_distance(self, q: Array) -> float:
        """Return the smallest distance between two links that do not touch by design [m].

        Links are their convex hulls; the value is zero or negative where two of them meet.

        Args:
            q: Joint positions, shape (m,).
        """
        nearest = pin.computeDistances(self._model, self._data, self._geometry, self._geometry_data, q)
        return float(self._geometry_data.distanceResults[nearest].min_distance)


class _Steps(Limit):  # type: ignore[misc] # pink tells no types
    """How far each joint may go in a step: as fast as it may, and no faster than it can brake before its range ends."""

    def __init__(self, kinematics: Kinematics) -> None:
        self._of = kinematics
        joints = len(kinematics.lower)
        self._sides = np.vstack([np.eye(joints), -np.eye(joints)])

    def compute_qp_inequalities(self, configuration: pink.Configuration, dt: float) -> tuple[Array, Array]:
        """Of a step from a configuration in dt [s]: G step <= h, shapes (2m, m) and (2m,)."""
        of, q = self._of, configuration.q
        ways = np.concatenate([of.upper - q, q - of.lower])
        fastest = np.tile(of.velocity_limit, 2)
        fastest = np.minimum(fastest, braking_speed(ways, np.tile(of.acceleration_limit, 2), np.tile(of.jerk_limit, 2)))
        return self._sides, np.minimum(ways, dt * fastest)


def _load(urdf: Path) -> tuple[pin.Model, pin.GeometryModel]:
    model = pin.buildModelFromUrdf(str(urdf))
    geometry = pin.buildGeomFromUrdf(model, str(urdf), pin.GeometryType.COLLISION)
    # A joint and a link may have one name, which Pinocchio reads and cannot reduce.
    links = {frame.name for frame in model.frames if frame.type == pin.FrameType.BODY}
    for frame in model.frames:
        if frame.type != pin.FrameType.BODY and frame.name in links:
            frame.name = f"joint:{frame.name}"
    return model, geometry


def _at_rest(model: pin.Model, robot: Manipulator) -> Array:
    """Joint positions of the whole description, its gripper wide open, shape (n,)."""
    q: Array = pin.neutral(model)
    held = {joint.name: joint.position for joint in robot.held}
    for name, position in (held | robot.gripper.positions(robot.gripper.opening)).items():
        q[model.joints[model.getJointId(name)].idx_q] = position
    return q


def _pair_up(model: pin.Model, geometry: pin.GeometryModel, robot: Manipulator) -> pin.GeometryData:
    """Make all shapes convex and pair the limbs with the trunk, but for pairs that meet at rest.

    The links between limbs and trunk are covered by their neighbours.
    """
    for shape in geometry.geometryObjects:
        if isinstance(shape.geometry, coal.BVHModelBase):
            shape.geometry.buildConvexHull(True, "Qt")
            shape.geometry = shape.geometry.convex
    carried = partial(_carried, geometry)
    limb_joints = _LIMB_JOINTS if model.njoints > _SIX else _FEWER
    limbs = _shapes(geometry, robot.limbs) if robot.limbs else carried(limb_joints, model.njoints)
    trunk = _shapes(geometry, robot.trunk) if robot.trunk else carried(0, _TRUNK_JOINTS)
    for pair in product(limbs, trunk):
        geometry.addCollisionPair(pin.CollisionPair(*pair))
    data = geometry.createData()
    pin.computeDistances(model, model.createData(), geometry, data, pin.neutral(model))
    results = zip(list(geometry.collisionPairs), data.distanceResults, strict=True)
    for pair in [pair for pair, result in results if result.min_distance <= 0.0]:
        geometry.removeCollisionPair(pair)
    return geometry.createData()


def _carried(geometry: pin.GeometryModel, least: int, most: int) -> list[int]:
    """The shapes that hang behind so many joints of the arm; joints of a chain are numbered along it."""
    shapes = enumerate(geometry.geometryObjects)
    return [index for index, shape in shapes if least <= shape.parentJoint <= most]


def _shapes(geometry: pin.GeometryModel, names: Sequence[str]) -> list[int]:
    """The shapes of some links, or single ones of them, in the order of their names."""
    known = [shape.name for shape in geometry.geometryObjects]  # "link_0", "link_1"
    return [index for name in names for index, one in enumerate(known) if name in (one, one.rpartition("_")[0])]


def _placement(position: Array, orientation: Array) -> pin.SE3:
    w, x, y, z = orientation / np.linalg.norm(orientation)
    return pin.SE3(pin.Quaternion(w, x, y, z).matrix(), np.asarray(position, dtype=np.float64))


def _pose(placement: pin.SE3) -> Pose:
    x, y, z, w = pin.Quaternion(placement.rotation).coeffs()
    return Pose(placement.translation.copy(), np.array([w, x, y, z]))
