"""Publishes what the cameras see, and one's depth and point cloud.

Simulated ones are drawn in a process of their own: drawing can never disturb control. One that is real and not there is
looked for, and the others go on.
"""

from __future__ import annotations

from collections import deque
from statistics import median

from protocol.messages import CameraImage, DepthPicture, Figure, PointCloud
from protocol.topics import CAMERA_IMAGE, DEPTH, POINT_CLOUD
from services.bus.arrays import Floats, points_to_wire
from services.bus.bus import Bus
from services.bus.depth import depth_to_wire
from services.camera.cloud import cloud
from services.camera.coding import coder
from services.camera.pacing import Pacing
from services.camera.seen import Seen
from services.camera.sources import Sources
from services.camera.wishes import Wish, Wishes
from services.process.clock import Clock
from services.process.config import CameraSection, Configuration
from services.process.robots import camera_names, check_camera
from services.process.runner import Service
from services.process.schedule import Schedule


def build(bus: Bus, clock: Clock, configuration: Configuration) -> Service:
    """The camera process.

    Raises:
        DrawingLibraryMissing: nothing on this machine can draw without a display.
        DescriptionMissing: the robot's meshes are not installed.
        UnknownScene: the configuration names a scene that is not there.
        CameraUnfit: a camera is fixed to a link that is not there.
        RoomMissing: the library for the codec is not installed.
        UnusableSetting: the codec cannot code pictures of this size, or the camera whose depth is meant is not there.
    """
    check_camera("[camera] cloud", configuration.camera.cloud, configuration)
    return CameraService(bus, clock, configuration)


class CameraService:
    """One picture a camera and period, the newest.

    Args:
        bus: to the robot's other processes.
        clock: what durations are measured on.
        configuration: of the whole system.
    """

    def __init__(self, bus: Bus, clock: Clock, configuration: Configuration) -> None:
        self._bus = bus
        self._clock = clock
        self._section: CameraSection = configuration.camera
        self._names = camera_names(configuration)
        self._coders = {name: coder(self._section) for name in self._names}
        self._wishes = Wishes(bus)
        self._wish = Wish()
        self._sources = Sources(bus, clock, configuration)
        self._schedule = Schedule()
        self._durations_ns: deque[int] = deque(maxlen=256)
        self._ages_ns: deque[int] = deque(maxlen=256)
        self._codings_ns: deque[int] = deque(maxlen=512)
        self._sizes: deque[int] = deque(maxlen=512)
        self._pacing = Pacing(bus, self._section.rate_hz, self._section.quality)
        self._counted_from_ns = clock.now_ns()

    @property
    def rate_hz(self) -> float:
        """Of the steps: in each period of the pictures as many as there are cameras, see `Pacing.turns`."""
        return self._section.rate_hz * len(self._names)

    def step(self, now_ns: int) -> None:
        """Show what was not shown yet, unless pictures queue on their way."""
        turns = self._pacing.turns(now_ns, self._names)
        if not turns:
            return
        self._wish = self._wishes.at(now_ns)
        captured_ns = 0
        for name in turns:
            seen = self._sources.cameras[name].look(now_ns)
            if seen is not None:
                self._show(name, seen, now_ns)
                captured_ns = seen.captured_ns
        if captured_ns:
            ended_ns = self._clock.now_ns()
            self._durations_ns.append((ended_ns - now_ns) * len(self._names) // len(turns))
            self._ages_ns.append(ended_ns - captured_ns)

    def figures(self) -> tuple[Figure, ...]:
        """Of the pictures since the last call, and states that were no use; what share of them is sent."""
        now_ns = self._clock.now_ns()
        elapsed_s = max(now_ns - self._counted_from_ns, 1) / 1e9
        result = (
            Figure("picture_rate", len(self._sizes) / len(self._names) / elapsed_s, "Hz"),
            Figure("draw_p50", median(self._durations_ns or (0,)) / 1e9, "s"),
            Figure("encode_p50", median(self._codings_ns or (0,)) / 1e9, "s"),
            Figure("picture_size_p50", float(median(self._sizes or (0,))), "B"),
            Figure("picture_age_p50", median(self._ages_ns or (0,)) / 1e9, "s"),
            Figure("unusable_states", float(self._sources.unusable), "1"),
            Figure("sent_share", self._pacing.share, "1"),
        )
        for figures in (self._durations_ns, self._ages_ns, self._codings_ns, self._sizes):
            figures.clear()
        self._counted_from_ns = now_ns
        return result

    def close(self) -> None:
        """Give devices and the drawing library's resources back."""
        self._sources.close()

    def _show(self, camera: str, seen: Seen, now_ns: int) -> None:
        (fx, _, cx), (_, fy, cy), _ = seen.intrinsics.tolist()
        height, width, _ = seen.image.shape
        began_ns = self._clock.now_ns()
        coded = self._coders[camera].encode(seen.image, self._pacing.quality, now_ns, self._wish)
        self._codings_ns.append(self._clock.now_ns() - began_ns)
        self._sizes.append(len(coded.data))
        self._bus.publish(
            CAMERA_IMAGE.of(camera),
            CameraImage(
                camera=camera,
                width=width,
                height=height,
                data=coded.data,
                intrinsics=(fx, fy, cx, cy),
                pose=seen.pose,
                captured_ns=seen.captured_ns,
                object_pose=seen.object_pose,
                coding=coded.coding,
                after_key=coded.after_key,
            ),
        )
        depth = seen.depth if camera == self._section.cloud else None
        if depth is not None and self._schedule.due(POINT_CLOUD, now_ns, self._pacing.share):
            self._show_depth(camera, seen, depth())

    def _show_depth(self, camera: str, seen: Seen, depth: Floats) -> None:
        points = points_to_wire(*cloud(seen.image, depth, seen.intrinsics, seen.pose))
        self._bus.publish(POINT_CLOUD, PointCloud(camera=camera, data=points, captured_ns=seen.captured_ns))
        (fx, _, cx), (_, fy, cy), _ = seen.intrinsics.tolist()
        height, width = depth.shape
        self._bus.publish(
            DEPTH,
            DepthPicture(
                camera=camera,
                width=width,
                height=height,
                data=depth_to_wire(depth),
                intrinsics=(fx, fy, cx, cy),
                pose=seen.pose,
                captured_ns=seen.captured_ns,
            ),
        )
