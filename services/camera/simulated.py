"""The simulated world, drawn from its published state: what the cameras see that stand in it."""

from __future__ import annotations

import logging

from protocol.messages import Pose, SceneState, WorldState
from protocol.topics import SCENE_STATE, WORLD_STATE
from services.bus.arrays import NotFinite, from_wire, quaternion, vector3
from services.bus.bus import Bus
from services.camera.calibrated import Calibrated
from services.camera.optics import Optics
from services.camera.places import Mounting
from services.camera.seen import Seen
from services.process.cameras import Simulated
from services.process.config import CameraSection, RobotSection
from services.process.robots import scene_of
from sim.exceptions import CameraUnfit, RobotOfItsOwn, UnknownScene, UnknownVariant
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

    def check(self, camera: str, mounting: Mounting) -> None:
        """Let pass a camera that is fixed to a link that is there; raises CameraUnfit."""
        try:
            self._cameras.link(mounting.link)
        except KeyError:
            raise CameraUnfit(camera, mounting.link) from None

    def carried(self, mounting: Mounting) -> Pose:
        """Where what is fixed so was in the state that was drawn last."""
        at = self._cameras.link(mounting.link)
        return mounting.on(at.position, at.orientation)

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


class SimulatedCamera:
    """See `Source`. What was measured of it counts, as of a real one.

    Args:
        world: that it stands in.
        name: of the camera.
        known: what was measured of it.
    """

    def __init__(self, world: DrawnWorld, name: str, known: Calibrated) -> None:
        self._world, self._name, self._known = world, name, known
        self._optics: Optics | None = None

    def look(self, now_ns: int) -> Seen | None:
        """See `Source.look`."""
        seen = self._world.look(self._name, now_ns)
        if seen is None:
            return None
        if self._known.optics is not None:
            seen = self._straightened(seen, self._known.optics)
        mounting = self._known.mounting
        return seen if mounting is None else seen._replace(pose=self._world.carried(mounting))

    def _straightened(self, seen: Seen, measured: Optics) -> Seen:
        height, width, _ = seen.image.shape
        if self._optics is None:  # a lens is laid out once
            self._optics = measured.of_size(width, height)
        optics, depth = self._optics, seen.depth
        return seen._replace(
            image=optics.straightened(seen.image),
            intrinsics=optics.matrix,
            depth=None if depth is None else lambda: optics.straightened_depth(depth()),
        )


def _camera(said: Simulated) -> Camera:
    return Camera(said.name, Mount(said.link, said.position, said.turned), said.fovy)
