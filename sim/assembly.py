"""Robot, scene and object put together into one MuJoCo model.

Both variants of a scene are in the model, and `select` shows one of them: changing the variant
needs no new compilation, and one renderer serves both.
"""

import mujoco
import numpy as np
from numpy.typing import NDArray

from sim.description import (
    CONTROLLED_JOINTS,
    HEAD_CAMERA_FRAME,
    HEAD_JOINTS,
    WRIST_CAMERA_FRAME,
    RobotDescription,
)
from sim.scenes.scene import (
    LID_SIZE,
    OBJECT_MASS,
    OBJECT_SIZE,
    TAG_BITS,
    TAG_SIZE,
    Box,
    Group,
    Scene,
)

OBJECT = "object"
HEAD_CAMERA, WRIST_CAMERA = "head", "wrist"
FIELD_OF_VIEW = {HEAD_CAMERA: 36.0, WRIST_CAMERA: 60.0}  # [deg] vertical

TIMESTEP = 0.002  # [s]

# Contact classes: a pair collides if either one's type is in the other's affinity.
ROBOT, ENVIRONMENT, THING, FLOOR = 1, 2, 4, 8
_AFFINITY = {ROBOT: ENVIRONMENT | THING, ENVIRONMENT: ROBOT | THING, THING: ROBOT | ENVIRONMENT | FLOOR, FLOOR: THING}

# Geometry groups: what is drawn, what only collides, what belongs to the variant not selected.
DRAWN, UNSEEN, ABSENT = 0, 3, 5

# Per joint: stiffness, damping and armature of the servo. In the order torso, arm 1 to 7.
STIFFNESS = np.array([60_000.0, 1500.0, 1500.0, 1200.0, 1200.0, 400.0, 300.0, 200.0])  # [N/m], then [N m/rad]
DAMPING = np.array([6_000.0, 80.0, 80.0, 50.0, 50.0, 12.0, 9.0, 6.0])  # [N s/m], then [N m s/rad]
_ARMATURE = (5.0, 0.2, 0.2, 0.1, 0.1, 0.05, 0.03, 0.03)  # [kg], then [kg m^2]
_HEAD_SERVO = (100.0, 4.0, 0.05)

_CELL_PIXELS = 16  # half a cell of the marker's texture


def assemble(scene: Scene, description: RobotDescription) -> mujoco.MjModel:
    """Compile the model of a scene.

    Args:
        scene: What stands around the robot.
        description: The robot.

    Returns:
        The model; call `select` before use.
    """
    spec = mujoco.MjSpec.from_file(str(description.urdf))
    _set_physics(spec)
    _fit_robot(spec)
    _add_servos(spec)
    _add_stage(spec)
    for variant in scene.variants:
        for box in scene.boxes(variant):
            _add_box(spec, variant, box)
    _add_object(spec)
    return spec.compile()


def select(model: mujoco.MjModel, scene: Scene, variant: str) -> None:
    """Make the boxes of one variant solid and visible, and those of the other neither.

    Raises:
        UnknownVariant: The scene has no such variant.
    """
    scene.check(variant)
    for other in scene.variants:
        for box in scene.boxes(other):
            geom = model.geom(_box_name(other, box))
            present = other == variant
            solid = ENVIRONMENT if present and box.group is not Group.DETAIL else 0
            geom.contype, geom.conaffinity = solid, _AFFINITY[ENVIRONMENT] if solid else 0
            geom.group = DRAWN if present else ABSENT


def _set_physics(spec: mujoco.MjSpec) -> None:
    option = spec.option
    option.timestep = TIMESTEP
    option.integrator = mujoco.mjtIntegrator.mjINT_IMPLICITFAST
    option.cone = mujoco.mjtCone.mjCONE_ELLIPTIC
    option.impratio = 10.0


def _fit_robot(spec: mujoco.MjSpec) -> None:
    """Give the robot its contact class, weightless links, armature and cameras."""
    for body in spec.bodies[1:]:
        body.gravcomp = 1.0
    for geom in spec.geoms:
        collides = bool(geom.contype)
        geom.contype, geom.conaffinity = (ROBOT, _AFFINITY[ROBOT]) if collides else (0, 0)
        geom.group = UNSEEN if collides else DRAWN
    for name, armature in zip(CONTROLLED_JOINTS, _ARMATURE, strict=True):
        spec.joint(name).armature = armature
    for name in HEAD_JOINTS:
        spec.joint(name).armature = _HEAD_SERVO[2]
    for camera, frame in ((HEAD_CAMERA, HEAD_CAMERA_FRAME), (WRIST_CAMERA, WRIST_CAMERA_FRAME)):
        # MuJoCo's cameras look along -z with y up: optical axes turned half a turn about x.
        spec.body(frame).add_camera(name=camera, quat=[0.0, 1.0, 0.0, 0.0], fovy=FIELD_OF_VIEW[camera])


def _add_servos(spec: mujoco.MjSpec) -> None:
    for name, stiffness, damping in zip(CONTROLLED_JOINTS, STIFFNESS, DAMPING, strict=True):
        _add_servo(spec, name, stiffness, damping)
    for name in HEAD_JOINTS:
        _add_servo(spec, name, *_HEAD_SERVO[:2])


def _add_servo(spec: mujoco.MjSpec, joint: str, stiffness: float, damping: float) -> None:
    servo = spec.add_actuator(name=joint, target=joint, trntype=mujoco.mjtTrn.mjTRN_JOINT)
    servo.set_to_position(kp=stiffness, kv=damping)


def _add_stage(spec: mujoco.MjSpec) -> None:
    """Floor, sky and light."""
    spec.visual.quality.offsamples = 0
    spec.visual.headlight.ambient = [0.38, 0.38, 0.40]
    spec.visual.headlight.diffuse = [0.28, 0.28, 0.28]
    spec.visual.headlight.specular = [0.05, 0.05, 0.05]
    spec.visual.map.znear = 0.005
    spec.add_texture(
        name="sky",
        type=mujoco.mjtTexture.mjTEXTURE_SKYBOX,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_GRADIENT,
        rgb1=[0.93, 0.95, 0.97],
        rgb2=[0.70, 0.76, 0.82],
        width=128,
        height=768,
    )
    spec.add_texture(
        name="tiles",
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        builtin=mujoco.mjtBuiltin.mjBUILTIN_CHECKER,
        rgb1=[0.66, 0.67, 0.68],
        rgb2=[0.61, 0.62, 0.63],
        width=256,
        height=256,
    )
    tiles = spec.add_material(name="tiles", texrepeat=[8, 8])
    tiles.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = "tiles"
    spec.worldbody.add_geom(
        name="floor",
        type=mujoco.mjtGeom.mjGEOM_PLANE,
        size=[4.0, 4.0, 0.1],
        material="tiles",
        contype=FLOOR,
        conaffinity=_AFFINITY[FLOOR],
    )
    for position, direction, strength in (
        ([-0.5, 2.0, 3.0], [0.5, -0.6, -1.0], 0.45),
        ([-0.5, -2.0, 2.5], [0.6, 0.7, -0.8], 0.20),
    ):
        spec.worldbody.add_light(
            type=mujoco.mjtLightType.mjLIGHT_DIRECTIONAL,
            pos=position,
            dir=direction,
            diffuse=[strength] * 3,
            specular=[0.1] * 3,
            castshadow=False,
        )


def _box_name(variant: str, box: Box) -> str:
    return f"{variant}/{box.name}"


def _add_box(spec: mujoco.MjSpec, variant: str, box: Box) -> None:
    solid = box.group is not Group.DETAIL
    spec.worldbody.add_geom(
        name=_box_name(variant, box),
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=box.centre,
        quat=box.quaternion,
        size=box.half_sizes,
        rgba=box.rgba,
        contype=ENVIRONMENT if solid else 0,
        conaffinity=_AFFINITY[ENVIRONMENT] if solid else 0,
    )


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
        "conaffinity": _AFFINITY[THING],
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
