"""What every MuJoCo model of a scene has: stage, boxes, contact classes, and the names of the cameras."""

import mujoco

from sim.tasks.reaching import ReachingScene
from sim.tasks.scene import Box, Group, Scene

# Contact classes: a pair collides if either one's type is in the other's affinity.
ROBOT, ENVIRONMENT, THING, FLOOR = 1, 2, 4, 8
AFFINITY = {ROBOT: ENVIRONMENT | THING, ENVIRONMENT: ROBOT | THING, THING: ROBOT | ENVIRONMENT | FLOOR, FLOOR: THING}

# Geometry groups: what is drawn, what only collides, what belongs to the variant not selected.
DRAWN, UNSEEN, ABSENT = 0, 3, 5

_AS_HULL = mujoco.mjtMeshInertia.mjMESH_INERTIA_CONVEX  # whatever the file holds, a thing that stands has no other


def add_stage(spec: mujoco.MjSpec, floor_z: float = 0.0) -> None:
    """Add floor, sky and light.

    Args:
        spec: To add them to.
        floor_z: Height of the floor [m].
    """
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
        pos=[0.0, 0.0, floor_z],
        size=[4.0, 4.0, 0.1],
        material="tiles",
        contype=FLOOR,
        conaffinity=AFFINITY[FLOOR],
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


def add_boxes(spec: mujoco.MjSpec, scene: Scene) -> None:
    """Add the boxes of all variants; `select` shows those of one."""
    for variant in scene.variants:
        for box in scene.boxes(variant):
            solid = box.group is not Group.DETAIL
            add_box(
                spec.worldbody,
                box,
                name=_name(variant, box.name),
                contype=ENVIRONMENT if solid else 0,
                conaffinity=AFFINITY[ENVIRONMENT] if solid else 0,
            )


def add_meshes(spec: mujoco.MjSpec, scene: ReachingScene) -> None:
    """Add the meshes of all variants; MuJoCo lets them collide as their convex hulls."""
    for mesh in scene.arrangement.meshes:
        spec.add_mesh(name=mesh.name, file=str(mesh.file), scale=[mesh.scale] * 3, inertia=_AS_HULL)
    for variant in scene.variants:
        for mesh, position in scene.arrangement.meshes_of(variant):
            spec.worldbody.add_geom(
                name=_name(variant, mesh.name),
                type=mujoco.mjtGeom.mjGEOM_MESH,
                meshname=mesh.name,
                pos=position,
                quat=mesh.quaternion,
                rgba=mesh.rgba,
                contype=ENVIRONMENT,
                conaffinity=AFFINITY[ENVIRONMENT],
            )


def add_box(body: mujoco.MjsBody, box: Box, name: str, contype: int = 0, conaffinity: int = 0) -> None:
    """Add a box to a body; only drawn, unless it is given a contact class."""
    body.add_geom(
        name=name,
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=box.centre,
        quat=box.quaternion,
        size=box.half_sizes,
        rgba=box.rgba,
        contype=contype,
        conaffinity=conaffinity,
    )


def select(model: mujoco.MjModel, scene: Scene, variant: str) -> None:
    """Make the boxes of one variant solid and visible, and those of the other neither.

    Raises:
        UnknownVariant: The scene has no such variant.
    """
    scene.check(variant)
    for other in scene.variants:
        parts = [(box.name, box.group is not Group.DETAIL) for box in scene.boxes(other)]
        if isinstance(scene, ReachingScene):
            parts += [(mesh.name, True) for mesh, _ in scene.arrangement.meshes_of(other)]
        for name, collides in parts:
            geom = model.geom(_name(other, name))
            present = other == variant
            solid = ENVIRONMENT if present and collides else 0
            geom.contype, geom.conaffinity = solid, AFFINITY[ENVIRONMENT] if solid else 0
            geom.group = DRAWN if present else ABSENT


def _name(variant: str, part: str) -> str:
    return f"{variant}/{part}"
