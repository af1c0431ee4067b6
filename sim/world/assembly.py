"""Robot, scene and object put together into one MuJoCo model.

Both variants of a scene are in the model, and `select` shows one of them: changing the variant
needs no new compilation, and one renderer serves both.
"""

import mujoco

from sim.robots.description import RobotDescription
from sim.robots.robot import Camera, Manipulator
from sim.tasks import AnyScene
from sim.tasks.particle import ParticleScene
from sim.tasks.reaching import ReachingScene
from sim.world.eyes import add_cameras
from sim.world.grip import add_fingers
from sim.world.particle import particle
from sim.world.staging import (
    AFFINITY,
    DRAWN,
    ROBOT,
    UNSEEN,
    add_boxes,
    add_meshes,
    add_stage,
)
from sim.world.things import add_things

TIMESTEP = 0.002  # [s]


def assemble(scene: AnyScene, description: RobotDescription, cameras: tuple[Camera, ...] = ()) -> mujoco.MjModel:
    """Compile the model of a scene.

    Args:
        scene: What stands around the robot.
        description: Of the arm; a particle needs none.
        cameras: Beside the robot's own, or in the place of one of the same name.

    Returns:
        The model; call `select` before use.

    Raises:
        CameraUnfit: A camera is fixed to a link that is not there.
    """
    match scene:
        case ReachingScene():
            spec = assembled(scene, description)
        case ParticleScene():
            spec = particle(scene)
    add_cameras(spec, cameras)
    return spec.compile()


def assembled(scene: ReachingScene, description: RobotDescription) -> mujoco.MjSpec:
    """Put together what `assemble` compiles, of a task of an arm.

    Args:
        scene: The task.
        description: Of the arm.
    """
    spec = mujoco.MjSpec.from_file(str(description.urdf))
    _set_physics(spec)
    _fit_robot(spec, scene.manipulator)
    _add_servos(spec, scene.manipulator)
    add_stage(spec)
    add_boxes(spec, scene)
    add_meshes(spec, scene)
    add_things(spec, scene)
    add_fingers(spec, scene.manipulator.gripper)
    return spec


def _set_physics(spec: mujoco.MjSpec) -> None:
    option = spec.option
    option.timestep = TIMESTEP
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = 10.0


def _fit_robot(spec: mujoco.MjSpec, robot: Manipulator) -> None:
    """Give the robot its contact class, weightless links, armature and cameras."""
    for body in spec.bodies[1:]:
        body.gravcomp = 1.0
    for geom in spec.geoms:
        collides = bool(geom.contype)
        geom.contype, geom.conaffinity = (ROBOT, AFFINITY[ROBOT]) if collides else (0, 0)
        geom.group = UNSEEN if collides else DRAWN
    for joint in robot.servos:
        spec.joint(joint.name).armature = joint.armature
    add_cameras(spec, robot.cameras)


def _add_servos(spec: mujoco.MjSpec, robot: Manipulator) -> None:
    for joint in robot.servos:
        _add_servo(spec, joint.name, joint.stiffness, joint.damping)


def _add_servo(spec: mujoco.MjSpec, joint: str, stiffness: float, damping: float) -> None:
    servo = spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=stiffness, kv=damping)
