"""The particle's plane as a MuJoCo model, to be drawn: what moves in it moves as it is told, without physics."""

import math

import mujoco
import numpy as np

from sim.robots.robot import FIELD_OF_VIEW, HEAD_CAMERA, WRIST_CAMERA
from sim.tasks.particle import ParticleScene
from sim.world.staging import add_box, add_boxes, add_stage

_RED = (0.80, 0.16, 0.14, 1.0)
_FLOOR_Z = -0.06  # [m]
_ABOVE = 0.76  # [m] of the head camera
_BEHIND, _OVER, _DOWN = 0.13, 0.07, math.radians(22.0)  # [m], [m], [rad] of the wrist camera, from the particle


def particle(scene: ParticleScene) -> mujoco.MjSpec:
    """Describe the model of a scene; its positions are x, y and z of the particle and y of the via-points [m].

    The head camera looks down on the plane, x to the right and y up as in the thesis' figures; the wrist camera follows
    the particle from behind.

    Args:
        scene: To describe.
    """
    spec = mujoco.MjSpec()
    add_stage(spec, _FLOOR_Z)
    add_boxes(spec, scene)
    _add_particle(spec, scene.radius)
    for number, ring in enumerate(scene.rings(np.zeros(2)), 1):
        body = spec.worldbody.add_body(name=f"via_point_{number}", gravcomp=1.0)
        body.add_joint(name=f"via_point_{number}", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=[0.0, 1.0, 0.0])
        for box in ring:
            add_box(body, box, box.name)
    spec.worldbody.add_camera(name=HEAD_CAMERA, pos=[scene.eye.target[0], 0.0, _ABOVE], fovy=FIELD_OF_VIEW[HEAD_CAMERA])
    return spec


def _add_particle(spec: mujoco.MjSpec, radius: float) -> None:
    body = spec.worldbody.add_body(name="particle", gravcomp=1.0)
    for name, axis in zip("xyz", np.eye(3), strict=True):
        body.add_joint(name=f"particle_{name}", type=mujoco.mjtJoint.mjJNT_SLIDE, axis=axis)
    body.add_geom(
        type=mujoco.mjtGeom.mjGEOM_SPHERE, size=[radius, 0.0, 0.0], rgba=_RED, contype=0, conaffinity=0, mass=0.01
    )
    # MuJoCo's cameras look along -z with y up.
    view = np.array(
        [[0.0, math.sin(_DOWN), -math.cos(_DOWN)], [-1.0, 0.0, 0.0], [0.0, math.cos(_DOWN), math.sin(_DOWN)]]
    )
    turned = np.zeros(4)
    mujoco.mju_mat2Quat(turned, view.ravel())
    body.add_camera(name=WRIST_CAMERA, pos=[-_BEHIND, 0.0, _OVER], quat=turned, fovy=FIELD_OF_VIEW[WRIST_CAMERA])
