"""How late pictures come is told whatever the clocks say, and for as long as a queue stands."""

import pytest

from protocol.messages import CameraImage, Coding, Pose
from protocol.topics import PICTURE_QUEUE
from services.bus.identity import new_publisher
from services.bus.memory import MemoryNetwork
from services.bus.outbox import Outbox
from services.bus.picture_queue import REMEMBERED_NS, QueueReport
from services.bus.picture_stream import PictureStream
from services.process.clock import ManualClock
from tests.cameras import HEAD_IMAGE

PERIOD_S = 1.0 / HEAD_IMAGE.rate_hz
AHEAD_NS = 5_000_000_000_000
NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


class Looking:
    """Somebody who looks at a camera on another machine, whose clock shows something else."""

    def __init__(self):
        self.clock = ManualClock()
        self._network = MemoryNetwork(self.clock)
        bus = self._network.bus("station")
        self.report = QueueReport(bus, PictureStream(bus.subscribe(HEAD_IMAGE)))
        self._told = self._network.bus("camera").subscribe(PICTURE_QUEUE)
        self._camera = Outbox(new_publisher() ^ (1 << 50), self._network.robot, "camera")

    def look(self, seconds, transit_s, drawn_s=0.0, **coded):
        """Pictures come, each so long after it was sent."""
        for _ in range(round(seconds / PERIOD_S)):
            self.clock.advance(PERIOD_S)
            now = self.clock.now_ns()
            stamp_ns = now - round(transit_s * 1e9) + AHEAD_NS
            captured_ns = stamp_ns - round(drawn_s * 1e9)
            image = CameraImage(
                camera="head",
                width=64,
                height=48,
                data=b"",
                intrinsics=(1.0, 1.0, 0.0, 0.0),
                pose=NOWHERE,
                captured_ns=captured_ns,
                **coded,
            )
            self._network.deliver(HEAD_IMAGE, self._camera.pack(HEAD_IMAGE, image, stamp_ns))
            self.report.step(now)

    @property
    def told(self):
        return self._told.latest().message

    @property
    def told_s(self):
        return self.told.late


@pytest.fixture
def looking():
    return Looking()


def test_before_the_first_picture_nothing_is_known(looking):
    looking.report.step(looking.clock.now_ns())
    assert looking.report.age_s(looking.clock.now_ns()) is None


def test_who_begins_to_look_says_so_before_the_first_picture(looking):
    looking.report.step(looking.clock.now_ns())
    assert looking.told_s == 0.0


def test_what_comes_late_now_is_told_whatever_came_before(looking):
    looking.look(2.0, 0.05)
    looking.look(0.4, 0.1)
    assert looking.told_s == pytest.approx(0.05)


def test_what_waits_for_a_packet_that_was_lost_is_no_queue(looking):
    looking.look(2.0 + 3.0 * PERIOD_S, 0.05)
    for transit_s in (0.25, 0.183, 0.117, 0.05):  # one waits, and those behind it with it
        looking.look(PERIOD_S, transit_s)
    assert looking.told_s == 0.0


def test_what_every_picture_takes_is_no_queue(looking):
    looking.look(3.0, 0.15)
    assert looking.told_s == 0.0


def test_a_queue_that_stands_is_told_for_as_long_as_it_stands(looking):
    looking.look(2.0, 0.05)
    looking.look(0.8 * REMEMBERED_NS / 1e9, 0.15)
    assert looking.told_s == pytest.approx(0.1)
    looking.look(2.0, 0.05)
    assert looking.told_s == 0.0


def test_after_a_minute_it_was_another_way_or_another_clock(looking):
    looking.look(2.0, 0.05)
    looking.look(1.1 * REMEMBERED_NS / 1e9, 0.15)
    assert looking.told_s == 0.0


def test_the_age_of_what_is_seen_counts_the_drawing_the_queue_and_the_silence_since(looking):
    looking.look(2.0, 0.05, 0.02)
    looking.look(PERIOD_S, 0.15, 0.02)
    assert looking.report.age_s(looking.clock.now_ns()) == pytest.approx(0.02 + PERIOD_S, abs=1e-6)
    looking.look(2.0, 0.15, 0.02)
    looking.clock.advance(0.5)
    assert looking.report.age_s(looking.clock.now_ns()) == pytest.approx(0.02 + 0.1 + 0.5, abs=1e-6)


def test_pictures_that_cannot_be_shown_are_told_and_make_nothing_younger(looking):
    looking.look(1.0, 0.05, coding=Coding.JPEG)
    assert not looking.told.waits
    looking.look(1.5, 0.05, coding=Coding.H264, after_key=3)
    assert looking.told.waits
    assert looking.told_s == 0.0
    assert looking.report.age_s(looking.clock.now_ns()) == pytest.approx(1.5, abs=PERIOD_S)
    looking.look(0.5, 0.05, coding=Coding.H264)
    assert not looking.told.waits


def test_who_can_show_only_jpeg_tells_so_before_anything_has_come(looking):
    looking.report.step(looking.clock.now_ns(), jpeg_only=True)
    assert looking.told.jpeg_only
