"""The scenes, by name; each has a file of its own."""

from sim.exceptions import UnknownScene
from sim.tasks.dishwasher import DISHWASHER
from sim.tasks.particle import PARTICLE, ParticleScene
from sim.tasks.post import POST
from sim.tasks.scene import ReachingScene
from sim.tasks.table import TABLE

AnyScene = ReachingScene | ParticleScene
"""What scenes differ in is told apart by their kind."""

REACHING: dict[str, ReachingScene] = {scene.name: scene for scene in (DISHWASHER, TABLE, POST)}
"""Those in which an arm reaches for an object."""

SCENES: dict[str, AnyScene] = {**REACHING, PARTICLE.name: PARTICLE}


def scene(name: str) -> AnyScene:
    """Return the scene of that name.

    Raises:
        UnknownScene: There is none.
    """
    try:
        return SCENES[name]
    except KeyError:
        raise UnknownScene(name, SCENES) from None
