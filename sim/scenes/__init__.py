"""The scenes, by name; each has a file of its own."""

from sim.exceptions import UnknownScene
from sim.scenes.dishwasher import DISHWASHER
from sim.scenes.scene import Scene
from sim.scenes.table import TABLE

SCENES: dict[str, Scene] = {scene.name: scene for scene in (DISHWASHER, TABLE)}


def scene(name: str) -> Scene:
    """Return the scene of that name.

    Raises:
        UnknownScene: There is none.
    """
    try:
        return SCENES[name]
    except KeyError:
        raise UnknownScene(name, SCENES) from None
