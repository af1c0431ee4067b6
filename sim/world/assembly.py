"""Robot, scene and object put together into one MuJoCo model.

Both variants of a scene are in the model, and `select` shows one of them: changing the variant
needs no new compilation, and one renderer serves both.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.robots.description import RobotDescription
from sim.robots.gripper import Mount
from sim.robots.robot import Manipulator
from sim.rotations import rotated
from sim.tasks import AnyScene
from sim.tasks.particle import ParticleScene
from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import LID_SIZE, OBJECT_MASS, OBJECT_SIZE, TAG_BITS, TAG_SIZE
from sim.world.particle import particle
from sim.world.staging import (
    AFFINITY,
    DRAWN,
    ROBOT,
    THING,
    UNSEEN,
    add_boxes,
    add_stage,
)

OBJECT = "object"

TIMESTEP = 0.002  # [s]

_CELL_PIXELS = 16  # half a cell of the marker's texture


def assemble(scene: AnyScene, description: RobotDescription) -> mujoco.MjModel:
    """Compile the model of a scene.

    Args:
        scene: What stands around the robot.
        description: Of the arm; a particle needs none.

    Returns:
        The model; call `select` before use.
    """
    match scene:
        case ReachingScene():
            return _arm_and_object(scene, description).compile()
        case ParticleScene():
            return particle(scene).compile()


def _arm_and_object(scene: ReachingScene, description: RobotDescription) -> mujoco.MjSpec:
    spec = mujoco.MjSpec.from_file(str(description.urdf))
    _set_physics(spec)
    _fit_robot(spec, scene.manipulator)
    _add_servos(spec, scene.manipulator)
    add_stage(spec)
    add_boxes(spec, scene)
    _add_object(spec)
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
    for camera in robot.cameras:
        link = camera.mount.link
        body = spec.body(link) if link else spec.worldbody
        body.add_camera(name=camera.name, pos=camera.mount.position, quat=_seeing(camera.mount), fovy=camera.fovy)


def _seeing(mount: Mount) -> NDArray[np.float64]:
    """Return how MuJoCo has a camera, which looks along -z there with y up: optical axes, half a turn about x."""
    orientation = np.array([1.0, 0.0, 0.0, 0.0])
    for axis, angle in zip(np.eye(3), mount.rpy, strict=True):
        orientation = rotated(orientation, angle * axis)
    turned = np.zeros(4)
    mujoco.mju_mulQuat(turned, orientation, np.array([0.0, 1.0, 0.0, 0.0]))
    return turned


def _add_servos(spec: mujoco.MjSpec, robot: Manipulator) -> None:
    for joint in robot.servos:
        _add_servo(spec, joint.name, joint.stiffness, joint.damping)


def _add_servo(spec: mujoco.MjSpec, joint: str, stiffness: float, damping: float) -> None:
    servo = spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=stiffness, kv=damping)


def _add_object(spec: mujoco.MjSpec) -> None:
    """A free-standing block with a lid that carries the marker; its frame is at the centre of both."""
    _add_tag_texture(spec)
    width, depth, height = OBJECT_SIZE
    lid_width, lid_depth, lid_height = LID_SIZE
    top = height / 2
    block = height - lid_height
    thing = spec.worldbody.add_body(name=OBJECT)
    thing.add_freejoint(name=OBJECT)
    solid = {
        "type": mujoco.mjtGeom.mjGEOM_BOX,
        "contype": THING,
        "conaffinity": AFFINITY[THING],
        "friction": [0.8, 0.005, 0.0001],
    }
    thing.add_geom(
        name="object_block",
        pos=[0.0, 0.0, -lid_height / 2],
        size=[width / 2, depth / 2, block / 2],
        rgba=[0.20, 0.45, 0.70, 1.0],
        mass=0.95 * OBJECT_MASS,
        **solid,
    )
    thing.add_geom(
        name="object_lid",
        pos=[0.0, 0.0, top - lid_height / 2],
        size=[lid_width / 2, lid_depth / 2, lid_height / 2],
        rgba=[1.0, 1.0, 1.0, 1.0],
        mass=0.05 * OBJECT_MASS,
        **solid,
    )
    thing.add_geom(
        name="object_tag",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=[0.0, 0.0, top],
        size=[lid_width / 2, lid_depth / 2, 0.0002],
        material="tag",
        contype=0,
        conaffinity=0,
        mass=0.0,
    )


def _add_tag_texture(spec: mujoco.MjSpec) -> None:
    picture = _tag_picture()
    texture = spec.add_texture(
        name="tag",
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        width=picture.shape[1],
        height=picture.shape[0],
        nchannel=3,
    )
    texture.data = picture.tobytes()
    tag = spec.add_material(name="tag", emission=0.3, specular=0.0, shininess=0.0)
    tag.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "tag"


def _tag_picture() -> NDArray[np.uint8]:
    """Draw the lid from above: the marker's bits in a black frame, in a white rim, shape (h, w, 3)."""
    cells = np.pad(np.array(TAG_BITS, dtype=np.uint8), 1)
    half_cells = np.kron(cells, np.ones((2, 2), dtype=np.uint8))
    rim = round((LID_SIZE[0] - TAG_SIZE) / TAG_SIZE * len(cells))
    framed = np.pad(half_cells, rim, constant_values=1)
    picture = 255 * np.kron(framed, np.ones((_CELL_PIXELS, _CELL_PIXELS), dtype=np.uint8))
    # The texture's rows run along the lid's y axis, so that it has to be turned to match `TAG_IN_OBJECT`.
    return np.repeat(np.rot90(picture, -1)[:, :, None], 3, axis=2)
