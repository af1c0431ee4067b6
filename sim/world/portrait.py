"""Pictures for people: a robot by itself with its frames, or in a task, and places that are marked."""

import math
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import mujoco
import numpy as np

from sim.planning.arm import PlanningArm
from sim.robots.description import prepare
from sim.robots.gripper import GRASPING_FRAME
from sim.robots.robot import Base, Manipulator
from sim.tasks import described
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Vector
from sim.world.assembly import assembled
from sim.world.drawing import Canvas, Image
from sim.world.staging import add_stage, select

_AXES = ((0.85, 0.15, 0.12, 1.0), (0.15, 0.65, 0.20, 1.0), (0.15, 0.30, 0.85, 1.0))  # x, y, z
_LENGTH, _SLIM = 0.14, 0.03  # of a frame's axes: share of the robot's reach; half their width, a share of that
_AZIMUTH, _ELEVATION = 140.0, -18.0  # [deg]
_DISTANCE = 0.85  # times the extent of what is seen
_DOT = 0.012  # [m] radius


@dataclass(frozen=True)
class Dot:
    """A place that is marked.

    Attributes:
        position: In the frame of the robot's first link [m].
        colour: Red, green, blue, opacity.
    """

    position: Vector
    colour: tuple[float, float, float, float]


def portrait(
    robot: Manipulator, width: int = 960, height: int = 720, dots: Sequence[Dot] = (), cache: Path | None = None
) -> Image:
    """Draw a robot at home with the frames of its base, its gripper and its cameras: x red, y green, z blue.

    Args:
        robot: Whose.
        width: Of the picture [px].
        height: The same.
        dots: Places that are marked.
        cache: See `prepare`.

    Returns:
        The picture in RGB, shape (height, width, 3).

    Raises:
        DrawingLibraryMissing: Nothing on this machine draws without a display.
        SimError: The robot has no description; see `prepare`.
    """
    spec = mujoco.MjSpec.from_file(str(prepare(cache, robot, Base()).urdf))
    for geom in spec.geoms:
        geom.group = 3 if geom.contype else 0
    add_stage(spec, _lowest(robot))
    length = _LENGTH * float(np.max(np.subtract(robot.reach.upper, robot.reach.lower))) / 2
    _add_frame(spec.worldbody, length)
    for link in (GRASPING_FRAME, *(camera.mount.link for camera in robot.cameras)):
        if link:
            _add_frame(spec.body(link), length)
    for dot in dots:
        _add_dot(spec.worldbody, dot)
    model = spec.compile()
    data = mujoco.MjData(model)
    for name, position in robot.positions(robot.stance("")).items():
        data.joint(name).qpos[0] = position
    mujoco.mj_forward(model, data)
    canvas = Canvas(model, width, height)
    try:
        return canvas.draw(data, _eye(robot, data, near=not dots))
    finally:
        canvas.close()


def scenery(scene: ReachingScene, variant: str, dots: Sequence[Dot] = (), width: int = 960, height: int = 720) -> Image:
    """Draw a task as it begins, its robot in it.

    Args:
        scene: The task.
        variant: Of it.
        dots: Places that are marked, in the task's frame.
        width: Of the picture [px].
        height: The same.

    Raises:
        DrawingLibraryMissing: Nothing on this machine draws without a display.
        SimError: The robot has no description; see `prepare`.
    """
    arm = PlanningArm(scene)
    arm.arrange(variant, scene.training_positions[0])
    q = arm.solve(scene.start, arm.seeds())
    spec = assembled(scene, described(scene))
    for dot in dots:
        _add_dot(spec.worldbody, dot)
    model = spec.compile()
    data = mujoco.MjData(model)
    select(model, scene, variant)
    data.qpos[:] = arm.state(arm.posture if q is None else q)
    mujoco.mj_forward(model, data)
    camera = mujoco.MjvCamera()
    towards = np.subtract(scene.eye.target, scene.eye.position)
    camera.lookat, camera.distance = scene.eye.target, 1.3 * float(np.linalg.norm(towards))
    camera.azimuth = math.degrees(math.atan2(towards[1], towards[0]))
    camera.elevation = math.degrees(math.asin(towards[2] / np.linalg.norm(towards)))
    canvas = Canvas(model, width, height)
    try:
        return canvas.draw(data, camera)
    finally:
        canvas.close()


def _lowest(robot: Manipulator) -> float:
    """Height of the floor below the robot's first link [m]."""
    return -robot.base.position[2]


def _eye(robot: Manipulator, data: mujoco.MjData, *, near: bool) -> mujoco.MjvCamera:
    """Look at the robot; from further away where all that it reaches is to be seen."""
    low, high = np.array(robot.reach.lower), np.array(robot.reach.upper)
    if near:
        bodies = data.xpos[1:]
        low, high = bodies.min(axis=0), bodies.max(axis=0)
    camera = mujoco.MjvCamera()
    camera.lookat = (low + high) / 2
    camera.distance = _DISTANCE * float(np.linalg.norm(high - low)) + 0.3
    camera.azimuth, camera.elevation = _AZIMUTH, _ELEVATION
    return camera


def _add_frame(body: mujoco.MjsBody, length: float) -> None:
    for axis, colour in zip(np.eye(3), _AXES, strict=True):
        body.add_geom(
            type=mujoco.mjtGeom.mjGEOM_BOX,
            pos=0.5 * length * axis,
            size=length * np.maximum(0.5 * axis, _SLIM),
            rgba=colour,
            contype=0,
            conaffinity=0,
            mass=0.0,
        )


def _add_dot(body: mujoco.MjsBody, dot: Dot) -> None:
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_SPHERE,
        pos=dot.position,
        size=[_DOT, 0.0, 0.0],
        rgba=dot.colour,
        contype=0,
        conaffinity=0,
        mass=0.0,
    )
