"""Pictures for tests of video: a scene that moves, coded, sent and lost as it takes."""

import itertools

import cv2
import numpy as np

from protocol.messages import CameraImage, Coding, Pose
from services.bus.identity import new_publisher
from services.bus.memory import MemoryNetwork
from services.bus.outbox import Outbox
from services.bus.picture_stream import PictureStream
from services.camera.coding import coder
from services.camera.wishes import Wish
from services.process.clock import ManualClock
from services.process.config import CameraSection
from tests.cameras import HEAD_IMAGE

WIDTH, HEIGHT = 192, 144
H264 = CameraSection(codec=Coding.H264, width=WIDTH, height=HEIGHT)
PERIOD_S = 1 / H264.rate_hz
NOTHING = Wish()
NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


def scene(tick):
    """A panorama of which the camera sees another part in each tick, and the tick's number in light and dark."""
    rough = np.random.default_rng(1).integers(60, 200, (HEIGHT // 16, WIDTH // 2, 3), dtype=np.uint8)
    panorama = cv2.resize(rough, (8 * WIDTH, HEIGHT), interpolation=cv2.INTER_CUBIC)
    picture = np.roll(panorama, -3 * tick, axis=1)[:, :WIDTH].copy()
    for bit in range(8):
        picture[8:24, 8 + 16 * bit : 24 + 16 * bit] = 255 if tick >> bit & 1 else 0
    return picture


def number(picture):
    """The tick of which it is a picture."""
    brightness = [picture[12:20, 12 + 16 * bit : 20 + 16 * bit].mean() for bit in range(8)]
    assert all(light < 60 or light > 195 for light in brightness), "not one picture, but parts of several"
    return sum((light > 128) << bit for bit, light in enumerate(brightness))


def image(coded, camera="head"):
    """The message that a camera sends."""
    return CameraImage(
        camera=camera,
        width=WIDTH,
        height=HEIGHT,
        data=coded.data,
        intrinsics=(300.0, 300.0, 159.5, 119.5),
        pose=NOWHERE,
        coding=coded.coding,
        after_key=coded.after_key,
    )


class Filmed:
    """A camera that films the scene as H.264, and one who follows it.

    Args:
        section: of the camera.
    """

    def __init__(self, section=H264):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.stream = PictureStream(self.network.bus("station").subscribe(HEAD_IMAGE))
        self.coder = coder(section)
        self.ticks = itertools.count()
        self.sent = []
        self._camera = Outbox(new_publisher(), self.network.robot, "camera")

    def film(self, *, lost=False, quality=80, wish=NOTHING):
        """One more picture; its number."""
        tick = next(self.ticks)
        self.clock.advance(PERIOD_S)
        coded = self.coder.encode(scene(tick), quality, self.clock.now_ns(), wish)
        self.sent.append(coded)
        payload = self._camera.pack(HEAD_IMAGE, image(coded), self.clock.now_ns())
        if not lost:
            self.network.deliver(HEAD_IMAGE, payload)
        return tick
