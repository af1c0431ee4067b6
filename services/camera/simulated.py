"""The simulated world, drawn from its published state: what the cameras see that stand in it."""

from __future__ import annotations

import logging
from dataclasses import dataclass

from protocol.messages import Pose, SceneState, WorldState
from protocol.topics import SCENE_STATE, WORLD_STATE
from services.bus.arrays import NotFinite, from_wire, quaternion, vector3
from services.bus.bus import Bus
from services.camera.seen import Seen
from services.process.cameras import Simulated
from services.process.config import CameraSection, RobotSection
from services.process.robots import scene_of
from sim.exceptions import RobotOfItsOwn, UnknownScene, UnknownVariant
from sim.robots.gripper import Mount
from sim.robots.robot import Camera
from sim.tasks import AnyScene, described
from sim.world.cameras import Cameras

log = logging.getLogger(__name__)


class DrawnWorld:
    """Keeps a model of its own, so that drawing can never disturb control.

    Args:
        bus: to the robot.
        robot: which one, and in which scene.
        section: size of the pictures, and the cameras beside the robot's own.

    Attributes:
        unusable: states that could not be drawn so far.

    Raises:
        DrawingLibraryMissing: nothing on this machine can draw without a display.
        DescriptionMissing: the robot's meshes are not installed.
        UnknownScene: the configuration names a scene that is not there.
        CameraUnfit: a camera is fixed to a link that is not there.
    """

    def __init__(self, bus: Bus, robot: RobotSection, section: CameraSection) -> None:
        self.unusable = 0
        self._robot = robot
        self._section = section
        self._more = tuple(_camera(one) for one in section.cameras if isinstance(one, Simulated))
        self._world = bus.subscribe(WORLD_STATE)
        self._scene = bus.subscribe(SCENE_STATE)
        self._cameras = self._open(scene_of(robot))
        self._shown = self._refused = ("", "")
        self._drawn_ns: dict[str, int] = {}
        self._unusable_ns = 0

    def look(self, camera: str, now_ns: int) -> Seen | None:
        """What a camera sees of the newest state; None where it was drawn already, or is too old to show."""
        arrangement, world = self._scene.latest(), self._world.fresh(now_ns)
        if arrangement is None or world is None or world.stamp_ns in (self._drawn_ns.get(camera), self._unusable_ns):
            return None
        if not self._arrange(arrangement.message) or camera not in self._cameras.names:
            return None
        try:
            seen = self._draw(camera, world)
        except (NotFinite, ValueError):  # a state of another model, or none at all
            self.unusable += 1
            self._unusable_ns = world.stamp_ns
            return None
        self._drawn_ns[camera] = world.stamp_ns
        return seen

    def close(self) -> None:
        """Give the drawing library's resources back."""
        self._cameras.close()

    def _open(self, scene: AnyScene) -> Cameras:
        return Cameras(scene, described(scene), self._section.width, self._section.height, self._more)

    def _arrange(self, arrangement: SceneState) -> bool:
        """Stand where the robot says that it stands; whether that is known here."""
        wanted = (arrangement.name, arrangement.variant)
        if wanted == self._shown:
            return True
        try:
            if arrangement.name != self._cameras.scene.name:
                elsewhere = scene_of(self._robot, arrangement.name)
                self._cameras.close()
                self._cameras = self._open(elsewhere)
            self._cameras.show(arrangement.variant)
        except (UnknownScene, UnknownVariant, RobotOfItsOwn) as error:
            if self._refused != wanted:
                log.warning("%s; nothing is drawn until the robot announces another", error)
            self._refused, self._shown = wanted, ("", "")
            return False
        self._shown = wanted
        return True

    def _draw(self, camera: str, world: WorldState) -> Seen:
        qpos = from_wire(world.qpos)
        image = self._cameras.render(camera, qpos)
        at = self._cameras.pose(camera, qpos)
        return Seen(
            image=image,
            intrinsics=self._cameras.intrinsics(camera),
            pose=Pose(vector3(at.position), quaternion(at.orientation)),
            captured_ns=world.stamp_ns,
            object_pose=world.object_pose,
            depth=self._cameras.depth,
        )


@dataclass(frozen=True)
class SimulatedCamera:
    """See `Source`.

    Attributes:
        world: that it stands in.
        name: of the camera.
    """

    world: DrawnWorld
    name: str

    def look(self, now_ns: int) -> Seen | None:
        """See `Source.look`."""
        return self.world.look(self.name, now_ns)


def _camera(said: Simulated) -> Camera:
    return Camera(said.name, Mount(said.link, said.position, said.turned), said.fovy)
