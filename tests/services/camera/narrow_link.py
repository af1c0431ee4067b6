"""Cameras on one machine and who looks on another, joined by a link that carries so much a second; stepped by hand."""

from protocol.messages import CameraImage, Pose
from protocol.topics import PICTURE_QUEUE
from services.bus.identity import new_publisher
from services.bus.memory import MemoryNetwork
from services.bus.outbox import Outbox
from services.bus.picture_queue import QueueReport
from services.bus.picture_stream import PictureStream
from services.camera.pacing import Pacing
from services.process.clock import ManualClock
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE

RATE_HZ, QUALITY = 15.0, 80
STEP_S = 0.005
WAY_S = 0.02
OTHERS_BITS = 400e3
"""What all but the pictures takes of the link [bit/s]."""

CAMERAS = (HEAD_IMAGE, WRIST_IMAGE)
NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


def size(quality):
    """Of a finely detailed picture of 320 x 240 as JPEG [B]."""
    return 6_300 + 108 * quality


class NarrowLink:
    """See the module.

    Args:
        rate: that the link carries [bit/s].

    Attributes:
        waits: how long what is sent now would wait in the queue, step by step [s].
        came: when pictures came [s].
    """

    def __init__(self, rate):
        self.waits, self.came = [], []
        self.narrow(rate)
        self._clock = ManualClock()
        self._near, self._far = MemoryNetwork(self._clock), MemoryNetwork(self._clock)
        self.pacing = Pacing(self._near.bus("camera"), RATE_HZ, QUALITY)
        self._camera = Outbox(new_publisher() ^ (1 << 50), self._far.robot, "camera")
        self._looker = Outbox(new_publisher() ^ (1 << 51), self._near.robot, "station")
        bus = self._far.bus("station")
        self._report = QueueReport(bus, *(PictureStream(bus.subscribe(topic)) for topic in CAMERAS))
        self._told = self._far.bus("camera").subscribe(PICTURE_QUEUE)
        self._free_s, self._due_s = 0.0, self._clock.now_ns() / 1e9
        self._under_way, self._reports = [], []

    def narrow(self, rate):
        """It carries so much from now on [bit/s]."""
        self._bytes_s = (rate - OTHERS_BITS) / 8.0

    def run(self, seconds):
        for _ in range(round(seconds / STEP_S)):
            self._clock.advance(STEP_S)
            now_s = self._clock.now_ns() / 1e9
            self.waits.append(max(0.0, self._free_s - now_s))
            if now_s >= self._due_s:
                self._due_s += 1.0 / RATE_HZ / len(CAMERAS)
                self._send(now_s)
            self._carry(now_s)

    def _send(self, now_s):
        for topic in self.pacing.turns(self._clock.now_ns(), CAMERAS):
            data = bytes(size(self.pacing.quality))
            image = CameraImage(
                camera=topic.name,
                width=64,
                height=48,
                data=data,
                intrinsics=(1.0, 1.0, 0.0, 0.0),
                pose=NOWHERE,
                captured_ns=self._clock.now_ns(),
            )
            self._free_s = max(self._free_s, now_s) + len(data) / self._bytes_s
            payload = self._camera.pack(topic, image, self._clock.now_ns())
            self._under_way.append((self._free_s + WAY_S, topic, payload))

    def _carry(self, now_s):
        while self._under_way and self._under_way[0][0] <= now_s:
            _, topic, payload = self._under_way.pop(0)
            self.came.append(now_s)
            self._far.deliver(topic, payload)
        self._report.step(self._clock.now_ns())
        self._reports += [(now_s + WAY_S, told.message) for told in self._told.take()]
        while self._reports and self._reports[0][0] <= now_s:
            _, message = self._reports.pop(0)
            self._near.deliver(PICTURE_QUEUE, self._looker.pack(PICTURE_QUEUE, message, self._clock.now_ns()))

    def pictures_hz(self, seconds):
        """That came in the last time."""
        now_s = self._clock.now_ns() / 1e9
        return sum(came > now_s - seconds for came in self.came) / seconds
