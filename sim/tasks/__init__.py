"""The scenes: a task of an arm is a file, `NAME.toml` here or wherever a person keeps it; the particle is Python."""

from dataclasses import replace
from pathlib import Path

from sim.exceptions import RobotOfItsOwn, UnknownScene
from sim.robots.description import RobotDescription, prepare
from sim.robots.robot import Manipulator
from sim.tasks.particle import PARTICLE, ParticleScene
from sim.tasks.reaching import ReachingScene
from sim.tasks.task_file import SUFFIX, load_task

NO_DESCRIPTION = RobotDescription(Path("a particle needs none"))

AnyScene = ReachingScene | ParticleScene
"""What scenes differ in is told apart by their kind."""

_THESIS = ("dishwasher", "table", "post")
"""The first is the default."""

_FILES = {path.stem: path for path in sorted(Path(__file__).parent.glob(f"*{SUFFIX}"))}

REACHING: dict[str, ReachingScene] = {
    name: load_task(_FILES[name], ships=True) for name in (*_THESIS, *(one for one in _FILES if one not in _THESIS))
}
"""Those in which an arm reaches for an object, by name."""

THESIS: dict[str, ReachingScene] = {name: REACHING[name] for name in _THESIS}
"""Those that the thesis' analyses are made in: their ways are drawn."""

DISHWASHER, TABLE, POST = THESIS.values()

SCENES: dict[str, AnyScene] = {**REACHING, PARTICLE.name: PARTICLE}


def is_path(name: str) -> bool:
    """Say whether a task is meant by its file, not by its name."""
    return "/" in name or name.endswith(SUFFIX)


def scene(name: str, manipulator: Manipulator | None = None) -> AnyScene:
    """Return the scene of that name.

    Args:
        name: Of the scene, or the path of a task file.
        manipulator: That is to stand in it; by default the one that it was made for.

    Raises:
        UnknownScene: There is none.
        TaskUnfit: The file cannot be used.
        RobotOfItsOwn: No manipulator stands in that scene.
    """
    if is_path(name):
        found: AnyScene = load_task(Path(name))
    elif name in SCENES:
        found = SCENES[name]
    else:
        raise UnknownScene(name, SCENES)
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
