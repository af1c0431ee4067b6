"""A task's objects in its MuJoCo model: free bodies, each with a lid that carries its marker."""

import mujoco

from sim.tasks.reaching import ReachingScene
from sim.tasks.thing import Tag, Thing
from sim.world.staging import AFFINITY, THING
from sim.world.tags import picture

OBJECT = "object"
"""Body and joint of the one that motions are relative to, whatever it is called."""

_FRICTION = [0.8, 0.005, 0.0001]
_LID_SHARE = 0.05  # of the mass
_WHITE = [1.0, 1.0, 1.0, 1.0]


def body_name(scene: ReachingScene, thing: Thing) -> str:
    """Return the name of an object's body and joint."""
    return OBJECT if thing is scene.target else f"thing/{thing.name}"


def add_things(spec: mujoco.MjSpec, scene: ReachingScene) -> None:
    """Add the objects of a task, each standing where it stands."""
    for thing in scene.things:
        _add(spec, thing, body_name(scene, thing))


def _add(spec: mujoco.MjSpec, thing: Thing, name: str) -> None:
    """A free-standing block with a lid that carries the marker; its frame is at the centre of both."""
    suffix = name.removeprefix(OBJECT)
    material = f"tag{suffix}"
    lid = (0.0, 0.0, 0.0) if thing.tag is None else thing.tag.lid
    width, depth, height = thing.size
    block = height - lid[2]
    body = spec.worldbody.add_body(name=name)
    if suffix:
        body.pos = thing.stands
    body.add_freejoint(name=name)
    solid = {"contype": THING, "conaffinity": AFFINITY[THING], "friction": _FRICTION}
    kind = mujoco.mjtGeom.mjGEOM_CYLINDER if thing.round else mujoco.mjtGeom.mjGEOM_BOX
    body.add_geom(
        name=f"{name}_block",
        type=kind,
        pos=[0.0, 0.0, -lid[2] / 2],
        size=[width / 2, block / 2, 0.0] if thing.round else [width / 2, depth / 2, block / 2],
        rgba=thing.rgba,
        mass=(1.0 - _LID_SHARE if thing.tag else 1.0) * thing.mass,
        **solid,
    )
    if thing.tag is None:
        return
    _add_texture(spec, thing.tag, material)
    top = height / 2
    body.add_geom(
        name=f"{name}_lid",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=[0.0, 0.0, top - lid[2] / 2],
        size=[edge / 2 for edge in lid],
        rgba=_WHITE,
        mass=_LID_SHARE * thing.mass,
        **solid,
    )
    body.add_geom(
        name=f"{name}_tag",
        type=mujoco.mjtGeom.mjGEOM_BOX,
        pos=[0.0, 0.0, top],
        size=[lid[0] / 2, lid[1] / 2, 0.0002],
        material=material,
        contype=0,
        conaffinity=0,
        mass=0.0,
    )


def _add_texture(spec: mujoco.MjSpec, tag: Tag, name: str) -> None:
    drawn = picture(tag)
    texture = spec.add_texture(
        name=name,
        type=mujoco.mjtTexture.mjTEXTURE_2D,
        width=drawn.shape[1],
        height=drawn.shape[0],
        nchannel=3,
    )
    texture.data = drawn.tobytes()
    material = spec.add_material(name=name, emission=0.3, specular=0.0, shininess=0.0)
    material.textures[mujoco.mjtTextureRole.mjTEXROLE_RGB] = name
