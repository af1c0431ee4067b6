"""Draws the head and wrist cameras' pictures, and the head's point cloud, from the published state of the world.

It keeps a model of its own, in a process of its own: drawing can never disturb control.
"""

from __future__ import annotations

import logging
from collections import deque
from statistics import median

from protocol.messages import CameraImage, Figure, PointCloud, Pose, SceneState, WorldState
from protocol.topics import HEAD_IMAGE, POINT_CLOUD, SCENE_STATE, WORLD_STATE, WRIST_IMAGE, Topic
from services.bus.arrays import Floats, NotFinite, from_wire, points_to_wire, quaternion, vector3
from services.bus.bus import Bus
from services.camera.cloud import cloud
from services.camera.coding import coder
from services.camera.pacing import Pacing
from services.camera.wishes import Wish, Wishes
from services.process.clock import Clock
from services.process.config import CameraSection, Configuration
from services.process.robots import scene_of
from services.process.runner import Service
from services.process.schedule import Schedule
from sim.exceptions import RobotOfItsOwn, UnknownScene, UnknownVariant
from sim.robots.robot import HEAD_CAMERA, WRIST_CAMERA
from sim.tasks import AnyScene, described
from sim.world.cameras import Cameras

log = logging.getLogger(__name__)

_TOPICS: tuple[tuple[str, Topic[CameraImage]], ...] = ((HEAD_CAMERA, HEAD_IMAGE), (WRIST_CAMERA, WRIST_IMAGE))


def build(bus: Bus, clock: Clock, configuration: Configuration) -> Service:
    """The camera process.

    Raises:
        DrawingLibraryMissing: nothing on this machine can draw without a display.
        DescriptionMissing: the robot's meshes are not installed.
        UnknownScene: the configuration names a scene that is not there.
        RoomMissing: the library for the codec is not installed.
        UnusableSetting: the codec cannot code pictures of this size.
    """
    return CameraService(bus, clock, configuration)


class CameraService:
    """One picture a camera and period, of the newest state.

    Args:
        bus: to the robot's other processes.
        clock: what durations are measured on.
        configuration: of the whole system.
    """

    def __init__(self, bus: Bus, clock: Clock, configuration: Configuration) -> None:
        self._bus = bus
        self._clock = clock
        self._section: CameraSection = configuration.camera
        self._world = bus.subscribe(WORLD_STATE)
        self._scene = bus.subscribe(SCENE_STATE)
        self._coders = {camera: coder(self._section) for camera, _ in _TOPICS}
        self._wishes = Wishes(bus)
        self._wish = Wish()
        self._robot = configuration.robot
        self._cameras = self._open(scene_of(self._robot))
        self._refused = ("", "")
        self._schedule = Schedule()
        self._drawn_ns = dict.fromkeys(self._coders, 0)
        self._durations_ns: deque[int] = deque(maxlen=256)
        self._ages_ns: deque[int] = deque(maxlen=256)
        self._codings_ns: deque[int] = deque(maxlen=512)
        self._sizes: deque[int] = deque(maxlen=512)
        self._pacing = Pacing(bus, self._section.rate_hz, self._section.quality)
        self._unusable = 0
        self._counted_from_ns = clock.now_ns()

    @property
    def rate_hz(self) -> float:
        """Of the steps: in each period of the pictures as many as there are cameras, see `Pacing.turns`."""
        return self._section.rate_hz * len(_TOPICS)

    def step(self, now_ns: int) -> None:
        """Draw the newest state, unless it is drawn already or too old to show, or pictures queue on their way."""
        turns = self._pacing.turns(now_ns, _TOPICS)
        if not turns:
            return
        self._wish = self._wishes.at(now_ns)
        arrangement = self._scene.latest()
        world = self._world.fresh(now_ns)
        if arrangement is None or world is None or world.stamp_ns == self._drawn_ns[turns[0][0]]:
            return
        if not self._arrange(arrangement.message):
            return
        try:
            qpos = from_wire(world.qpos)
            for camera, topic in turns:
                self._drawn_ns[camera] = world.stamp_ns
                self._show(camera, topic, qpos, world, now_ns)
        except (NotFinite, ValueError):  # a state of another model, or none at all
            self._unusable += 1
            return
        ended_ns = self._clock.now_ns()
        self._durations_ns.append((ended_ns - now_ns) * len(_TOPICS) // len(turns))
        self._ages_ns.append(ended_ns - world.stamp_ns)

    def figures(self) -> tuple[Figure, ...]:
        """Of the pictures since the last call, and states that were no use; what share of them is sent."""
        now_ns = self._clock.now_ns()
        elapsed_s = max(now_ns - self._counted_from_ns, 1) / 1e9
        result = (
            Figure("picture_rate", len(self._sizes) / len(_TOPICS) / elapsed_s, "Hz"),
            Figure("draw_p50", median(self._durations_ns or (0,)) / 1e9, "s"),
            Figure("encode_p50", median(self._codings_ns or (0,)) / 1e9, "s"),
            Figure("picture_size_p50", float(median(self._sizes or (0,))), "B"),
            Figure("picture_age_p50", median(self._ages_ns or (0,)) / 1e9, "s"),
            Figure("unusable_states", float(self._unusable), "1"),
            Figure("sent_share", self._pacing.share, "1"),
        )
        for figures in (self._durations_ns, self._ages_ns, self._codings_ns, self._sizes):
            figures.clear()
        self._counted_from_ns = now_ns
        return result

    def close(self) -> None:
        """Give the drawing library's resources back."""
        self._cameras.close()

    def _open(self, scene: AnyScene) -> Cameras:
        return Cameras(scene, described(scene), self._section.width, self._section.height)

    def _arrange(self, arrangement: SceneState) -> bool:
        """Stand where the robot says that it stands; whether that is known here."""
        try:
            if arrangement.name != self._cameras.scene.name:
                elsewhere = scene_of(self._robot, arrangement.name)
                self._cameras.close()
                self._cameras = self._open(elsewhere)
            self._cameras.show(arrangement.variant)
        except (UnknownScene, UnknownVariant, RobotOfItsOwn) as error:
            if self._refused != (arrangement.name, arrangement.variant):
                log.warning("%s; nothing is drawn until the robot announces another", error)
            self._refused = (arrangement.name, arrangement.variant)
            return False
        return True

    def _show(self, camera: str, topic: Topic[CameraImage], qpos: Floats, world: WorldState, now_ns: int) -> None:
        image = self._cameras.render(camera, qpos)
        intrinsics = self._cameras.intrinsics(camera)
        at = self._cameras.pose(camera, qpos)
        pose = Pose(vector3(at.position), quaternion(at.orientation))
        (fx, _, cx), (_, fy, cy), _ = intrinsics.tolist()
        began_ns = self._clock.now_ns()
        coded = self._coders[camera].encode(image, self._pacing.quality, now_ns, self._wish)
        self._codings_ns.append(self._clock.now_ns() - began_ns)
        self._sizes.append(len(coded.data))
        self._bus.publish(
            topic,
            CameraImage(
                camera=camera,
                width=self._section.width,
                height=self._section.height,
                data=coded.data,
                intrinsics=(fx, fy, cx, cy),
                pose=pose,
                captured_ns=world.stamp_ns,
                object_pose=world.object_pose,
                coding=coded.coding,
                after_key=coded.after_key,
            ),
        )
        if camera == HEAD_CAMERA and self._schedule.due(POINT_CLOUD, now_ns, self._pacing.share):
            points = points_to_wire(*cloud(image, self._cameras.depth(), intrinsics, pose))
            self._bus.publish(POINT_CLOUD, PointCloud(camera=camera, data=points, captured_ns=world.stamp_ns))
