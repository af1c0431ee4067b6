"""The scenes, by name; each has a file of its own."""

from dataclasses import replace
from pathlib import Path

from sim.exceptions import RobotOfItsOwn, UnknownScene
from sim.robots.description import RobotDescription, prepare
from sim.robots.robot import Manipulator
from sim.tasks.dishwasher import DISHWASHER
from sim.tasks.particle import PARTICLE, ParticleScene
from sim.tasks.post import POST
from sim.tasks.reaching import ReachingScene
from sim.tasks.table import TABLE

NO_DESCRIPTION = RobotDescription(Path("a particle needs none"))

AnyScene = ReachingScene | ParticleScene
"""What scenes differ in is told apart by their kind."""

REACHING: dict[str, ReachingScene] = {scene.name: scene for scene in (DISHWASHER, TABLE, POST)}
"""Those in which an arm reaches for an object."""

SCENES: dict[str, AnyScene] = {**REACHING, PARTICLE.name: PARTICLE}


def scene(name: str, manipulator: Manipulator | None = None) -> AnyScene:
    """Return the scene of that name.

    Args:
        name: Of the scene.
        manipulator: That is to stand in it; by default the one that it was made for.

    Raises:
        UnknownScene: There is none.
        RobotOfItsOwn: No manipulator stands in that scene.
    """
    try:
        found = SCENES[name]
    except KeyError:
        raise UnknownScene(name, SCENES) from None
    if manipulator is None or getattr(found, "manipulator", None) == manipulator:
        return found
    if not isinstance(found, ReachingScene):
        raise RobotOfItsOwn(name, found.robot.kind, REACHING)
    return replace(found, manipulator=manipulator)


def described(scene: AnyScene, cache: Path | None = None) -> RobotDescription:
    """Return the description of the robot that stands in a scene, as it stands there, making it at first use.

    Args:
        scene: Which.
        cache: Where to keep it; see `sim.cache`.

    Raises:
        SimError: It cannot be made; see `prepare`.
    """
    if not isinstance(scene, ReachingScene):
        return NO_DESCRIPTION
    return prepare(cache, scene.manipulator, scene.stance.base)
