"""What the station hears of the others."""

from __future__ import annotations

import math
from collections.abc import Iterable
from typing import NamedTuple, TypeVar

import msgspec
import numpy as np

from lfd.motion.rotations import rotate
from protocol import messages, topics
from protocol.messages import Message
from services.bus.arrays import points_unpacked
from services.bus.bus import Bus
from services.bus.identity import same_clock
from services.bus.picture_queue import QueueReport
from services.bus.picture_stream import PictureStream
from services.bus.predictions import Predictions
from services.bus.subscription import Received, Subscription
from services.station.page.view import Picture
from sim.robots.robot import USUAL_CAMERAS

M = TypeVar("M", bound=Message)
_FORWARD, _UP = (0.0, 0.0, 1.0), (0.0, -1.0, 0.0)
"""Of an optical frame."""

PICTURES_WITHIN_S = 2.0
"""By pictures that show what was longer ago nobody corrects: slow ones, and those of a camera that fell silent."""

HEARD_S = 0.3
"""Age at which the robot's state is not shown as its present one any more, on a busy machine too."""


class Clouds:
    """A camera's point clouds, each unpacked once, as browsers draw them.

    Args:
        subscription: to them.
    """

    def __init__(self, subscription: Subscription[messages.PointCloud]) -> None:
        self._subscription = subscription
        self._packed: Received[messages.PointCloud] | None = None
        self._newest: Received[messages.PointCloud] | None = None

    def latest(self) -> Received[messages.PointCloud] | None:
        """The newest, however old it has become since."""
        packed = self._subscription.latest()
        if packed is not None and packed is not self._packed:
            data = points_unpacked(packed.message.data)
            self._packed = packed
            self._newest = Received(msgspec.structs.replace(packed.message, data=data), packed.received_ns)
        return self._newest


Camera = PictureStream | Clouds


class RobotClock(NamedTuple):
    """The clock of a robot's machine against this one's.

    Attributes:
        publisher: of the robot's process.
        ahead_s: by how much it is ahead [s].
    """

    publisher: int
    ahead_s: float


class Ears:
    """What the station subscribes to.

    Args:
        bus: to the others.
        cameras: their names.
    """

    def __init__(self, bus: Bus, cameras: Iterable[str] = USUAL_CAMERAS) -> None:
        self.robot = bus.subscribe(topics.ROBOT_STATE)
        self.authority = bus.subscribe(topics.AUTHORITY_STATE)
        self.safety = bus.subscribe(topics.SAFETY_STATE)
        self.scene = bus.subscribe(topics.SCENE_STATE)
        self.model = bus.subscribe(topics.MODEL_STATE)
        self.seen = bus.subscribe(topics.OBJECT_POSE)
        self.results = bus.subscribe(topics.EPISODE_RESULT)
        self.verdict = bus.subscribe(topics.VERDICT)
        self.recording = bus.subscribe(topics.RECORDING)
        self.master = bus.subscribe(topics.MASTER_STATE)
        self.execution = bus.subscribe(topics.EXECUTION)
        self.predictions = Predictions(bus)
        self.cameras = {name: PictureStream(bus.subscribe(topics.CAMERA_IMAGE.of(name))) for name in cameras}
        self.queue = QueueReport(bus, *self.cameras.values())
        self.cloud = Clouds(bus.subscribe(topics.POINT_CLOUD))

    def robot_clock(self, own: int) -> RobotClock | None:
        """What is known of it: at once on one machine, else while a master of this machine commands the robot.

        Args:
            own: this process' identity.
        """
        robot, master = message(self.robot.latest()), message(self.master.latest())
        if robot is None:
            return None
        if same_clock(robot.publisher, own):
            return RobotClock(robot.publisher, 0.0)
        commands = message(self.authority.latest())
        mine = master is not None and same_clock(master.publisher, own)
        if master is None or robot.ahead is None or commands is None or not mine or master.holder != commands.holder:
            return None
        return RobotClock(robot.publisher, robot.ahead)

    def blind(self, now_ns: int) -> bool:
        """Whether there were pictures, and they are too old to correct by."""
        age_s = self.queue.age_s(now_ns)
        return age_s is not None and age_s > PICTURES_WITHIN_S


def young(received: Received[M] | None, now_ns: int) -> M | None:
    """The message, where it came within `HEARD_S`."""
    return received.message if received is not None and received.age_s(now_ns) <= HEARD_S else None


def message(received: Received[M] | None) -> M | None:
    """The message, however old."""
    return received.message if received is not None else None


def came_s(received: Received[M] | None) -> float:
    """When it came, by the receiver's clock [s]; 0 where it has not."""
    return received.received_ns / 1e9 if received is not None else 0.0


def picture(camera: Camera, now_ns: int, own: int, clock: RobotClock | None = None) -> Picture | None:
    """What a camera showed last, and how old that is since it was captured.

    A camera stands beside its robot, by whose clock it says when: what passed there until it sent is known wherever it
    stands. What the network took is known where the clocks compare; else it counts as nothing.

    Args:
        camera: its newest.
        now_ns: the time.
        own: this process' identity.
        clock: of the robot's machine, where it is known.
    """
    received = camera.latest()
    if received is None:
        return None
    shown = received.message
    there_ns = max(0, shown.stamp_ns - shown.captured_ns) if shown.captured_ns else 0
    under_way_ns = max(0, received.received_ns - shown.stamp_ns) if same_clock(shown.publisher, own) else 0
    if clock is not None and same_clock(shown.publisher, clock.publisher):
        under_way_ns = max(0, received.received_ns - shown.stamp_ns + round(1e9 * clock.ahead_s))
    age_s = (there_ns + under_way_ns) / 1e9 + received.age_s(now_ns)
    if not isinstance(shown, messages.CameraImage):
        return Picture(shown.data, age_s)
    group = camera.group if isinstance(camera, PictureStream) and shown.coding is not messages.Coding.JPEG else None
    return Picture(shown.data, age_s, heading(shown.pose), group)


def heading(camera: messages.Pose) -> float:
    """By how much a camera looks to the left of the base's x axis [rad]; straight down, the picture's up does so.

    Args:
        camera: its optical frame (x right, y down, z forward) in the base frame.
    """
    forward, up = (rotate(np.array(camera.orientation), np.array(axis)) for axis in (_FORWARD, _UP))
    x, y, _ = forward - forward[2] * up
    return math.atan2(y, x)


def prediction_of(
    prediction: messages.Prediction | None, model: messages.ModelState | None
) -> messages.Prediction | None:
    """The prediction while it is the model's: what has been learnt or taken back since makes another one."""
    if prediction is None or model is None:
        return None
    current = (prediction.model_version, prediction.skill) == (model.version, model.skill)
    return prediction if current else None
