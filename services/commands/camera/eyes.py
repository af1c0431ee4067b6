"""All cameras of a configuration, by what they are fixed to."""

from __future__ import annotations

from dataclasses import dataclass

from services.camera.places import Mounting, mounting
from services.process.cameras import Device, Mounted, Simulated
from services.process.config import Configuration
from services.process.robots import scene_of
from sim.robots.robot import Camera
from sim.tasks.reaching import ReachingScene


@dataclass(frozen=True)
class Eye:
    """One camera.

    Attributes:
        name: of the camera.
        kind: of it, in a word or two.
        mounting: as it is said, not measured.
    """

    name: str
    kind: str
    mounting: Mounting

    @property
    def link(self) -> str:
        """That carries it; empty where it stands."""
        return self.mounting.link

    def __str__(self) -> str:
        return f"{self.kind}, {f'on {self.link}' if self.link else 'stands in the scene'}"


def eyes(chosen: Configuration) -> dict[str, Eye]:
    """By name: the robot's own, then what the configuration adds.

    Raises:
        SimError: the scene or robot is not there.
        ConfigurationError: the robot file cannot be used.
    """
    scene = scene_of(chosen.robot)
    own = {one.name: _own(one) for one in scene.manipulator.cameras} if isinstance(scene, ReachingScene) else {}
    return {**own, **{one.name: Eye(one.name, _kind(one), mounting(one)) for one in chosen.camera.cameras}}


def _own(camera: Camera) -> Eye:
    said = Mounted(camera.mount.link, camera.mount.position, rpy=camera.mount.rpy)
    return Eye(camera.name, "simulated", mounting(said))


def _kind(camera: Mounted) -> str:
    match camera:
        case Simulated():
            return "simulated"
        case Device():
            return f"device {camera.device}"
        case _:
            return "RealSense"
