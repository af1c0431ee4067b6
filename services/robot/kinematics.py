"""Whole-body kinematics of torso and arm: Pinocchio for the model, Pink for the inverse."""

from collections.abc import Sequence
from itertools import product
from pathlib import Path

import coal
import numpy as np
import pink
import pinocchio as pin
from numpy.typing import NDArray
from pink.exceptions import PinkError
from pink.limits import ConfigurationLimit, VelocityLimit
from pink.tasks import FrameTask, PostureTask
from qpsolvers.exceptions import QPError

from services.robot.correction import Correction
from services.robot.mechanism import InverseFailed, Unreachable
from sim.pose import Pose
from sim.robots.description import CONTROLLED_JOINTS, GRASPING_FRAME

Array = NDArray[np.float64]

_SOLVER = "daqp"
_POSITION_COST = 1.0  # [cost] / [m]
_ORIENTATION_COST = 0.1  # [cost] / [rad]: at a joint limit the orientation gives way first
_POSTURE_COST = 1e-3  # [cost] / [rad]: only what the frame leaves free
_LM_DAMPING = 1e-6
_SOLVE_DT = 0.5  # [s]: long enough that the speed limits do not bind in a search
_SOLVE_ITERATIONS = 60
_POSITION_TOLERANCE = 1e-4  # [m]
_ORIENTATION_TOLERANCE = 1e-3  # [rad]
_RANDOM_STARTS = 12

# Shapes that can meet at all; the links between them are covered by their neighbours.
_LIMBS = (
    "arm_4_link_0",
    "arm_5_link_0",
    "arm_6_link_0",
    "gripper_palm_link_0",
    "gripper_left_finger_link_0",
    "gripper_right_finger_link_0",
)
_TRUNK = ("base_link_0", "torso_fixed_column_link_0", "torso_lift_link_0", "head_2_link_0")


class Kinematics:
    """Forward and inverse kinematics of the grasping frame, and the distance of the robot to itself.

    Joint vectors have shape (8,), in the order of `CONTROLLED_JOINTS` [m, then rad]; the head is held
    at zero. One object serves one thread.

    Args:
        urdf: The robot's description.
        posture: Configuration that the redundant joint is drawn to; the middle of the ranges by default.
    """

    def __init__(self, urdf: Path, posture: Array | None = None) -> None:
        full, geometry = _load(urdf)
        held = [full.getJointId(name) for name in full.names[1:] if name not in CONTROLLED_JOINTS]
        self._model, (self._geometry,) = pin.buildReducedModel(full, [geometry], held, pin.neutral(full))
        if tuple(self._model.names[1:]) != CONTROLLED_JOINTS:
            raise ValueError(f"joints of {urdf} are {list(self._model.names[1:])}, expected {CONTROLLED_JOINTS}")
        self._data = self._model.createData()
        self._frame = self._model.getFrameId(GRASPING_FRAME)
        if self._frame == self._model.nframes:  # Pinocchio's silent "not found"
            raise ValueError(f"{urdf} has no frame {GRASPING_FRAME}")
        self.lower: Array = self._model.lowerPositionLimit.copy()
        self.upper: Array = self._model.upperPositionLimit.copy()
        self.velocity_limit: Array = self._model.velocityLimit.copy()

        self._configuration = pink.Configuration(self._model, self._data, (self.lower + self.upper) / 2)
        self._pose_task = FrameTask(GRASPING_FRAME, _POSITION_COST, _ORIENTATION_COST, _LM_DAMPING)
        self._posture_task = PostureTask(_POSTURE_COST)
        self._posture_task.set_target((self.lower + self.upper) / 2 if posture is None else posture)
        self._limits = (ConfigurationLimit(self._model, config_limit_gain=1.0), VelocityLimit(self._model))
        self._geometry_data = _pair_up(self._model, self._geometry)

    def forward(self, q: Array) -> Pose:
        """Return the pose of the grasping frame in the base frame.

        Args:
            q: Joint positions, shape (8,).
        """
        pin.forwardKinematics(self._model, self._data, q)
        return _pose(pin.updateFramePlacement(self._model, self._data, self._frame))

    def admitted(self, wanted: Correction) -> Correction:
        """All of it."""
        return wanted

    def solve_step(self, q: Array, position: Array, orientation: Array, dt: float) -> tuple[Array, Array]:
        """Move one tick towards a pose: one iteration of differential inverse kinematics.

        Args:
            q: Joint positions, shape (8,).
            position: Of the grasping frame, shape (3,) [m].
            orientation: Of the grasping frame, scalar first, shape (4,).
            dt: Duration of the tick [s]; speeds stay within the joints' limits over it.

        Returns:
            Next joint positions and the velocities that lead there, each of shape (8,).

        Raises:
            InverseFailed: The solver found no step.
        """
        self._pose_task.set_target(_placement(position, orientation))
        try:
            self._configuration.update(np.clip(q, self.lower, self.upper))
            velocity = pink.solve_ik(
                self._configuration, (self._pose_task, self._posture_task), dt, _SOLVER, limits=self._limits
            )
        except (PinkError, QPError) as error:
            raise InverseFailed(str(error).splitlines()[0]) from error
        q_next = np.clip(q + velocity * dt, self.lower, self.upper)
        return q_next, (q_next - q) / dt

    def solve(self, position: Array, orientation: Array, seeds: Sequence[Array], rng: np.random.Generator) -> Array:
        """Find joint positions for a pose, from several starts.

        Most misses of one start are local minima at joint limits, so a few random ones follow the seeds.

        Args:
            position: Of the grasping frame, shape (3,) [m].
            orientation: Of the grasping frame, scalar first, shape (4,).
            seeds: Configurations to start from first, each of shape (8,).
            rng: Source of the random starts.

        Returns:
            Joint positions, shape (8,).

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
        for _ in range(_SOLVE_ITERATIONS):
            pin.forwardKinematics(self._model, self._data, q)
            actual = pin.updateFramePlacement(self._model, self._data, self._frame)
            error = pin.log6(actual.actInv(target)).vector
            reached = np.linalg.norm(error[:3]) < _POSITION_TOLERANCE
            if reached and np.linalg.norm(error[3:]) < _ORIENTATION_TOLERANCE:
                return q
            try:
                q, _ = self.solve_step(q, position, orientation, _SOLVE_DT)
            except InverseFailed:
                return None
        return None

    def self_distance(self, q: Array) -> float:
        """Return the smallest distance between two links that do not touch by design [m].

        Links are their convex hulls; the value is zero or negative where two of them meet.

        Args:
            q: Joint positions, shape (8,).
        """
        nearest = pin.computeDistances(self._model, self._data, self._geometry, self._geometry_data, q)
        return float(self._geometry_data.distanceResults[nearest].min_distance)


def _load(urdf: Path) -> tuple[pin.Model, pin.GeometryModel]:
    model = pin.buildModelFromUrdf(str(urdf))
    return model, pin.buildGeomFromUrdf(model, str(urdf), pin.GeometryType.COLLISION)


def _pair_up(model: pin.Model, geometry: pin.GeometryModel) -> pin.GeometryData:
    """Make all shapes convex and pair the limbs with the trunk, but for pairs that meet at the neutral pose."""
    for shape in geometry.geometryObjects:
        if isinstance(shape.geometry, coal.BVHModelBase):
            shape.geometry.buildConvexHull(True, "Qt")
            shape.geometry = shape.geometry.convex
    for limb, trunk in product(_LIMBS, _TRUNK):
        geometry.addCollisionPair(pin.CollisionPair(_shape(geometry, limb), _shape(geometry, trunk)))
    data = geometry.createData()
    pin.computeDistances(model, model.createData(), geometry, data, pin.neutral(model))
    results = zip(list(geometry.collisionPairs), data.distanceResults, strict=True)
    for pair in [pair for pair, result in results if result.min_distance <= 0.0]:
        geometry.removeCollisionPair(pair)
    return geometry.createData()


def _shape(geometry: pin.GeometryModel, name: str) -> int:
    index = int(geometry.getGeometryId(name))
    if index == geometry.ngeoms:  # Pinocchio's silent "not found"
        raise ValueError(f"the robot description has no collision shape {name}")
    return index


def _placement(position: Array, orientation: Array) -> pin.SE3:
    w, x, y, z = orientation / np.linalg.norm(orientation)
    return pin.SE3(pin.Quaternion(w, x, y, z).matrix(), np.asarray(position, dtype=np.float64))


def _pose(placement: pin.SE3) -> Pose:
    x, y, z, w = pin.Quaternion(placement.rotation).coeffs()
    return Pose(placement.translation.copy(), np.array([w, x, y, z]))
