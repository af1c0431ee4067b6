"""A picture that needs others is shown with all of them, or not at all."""

import itertools

import pytest

from protocol.messages import CameraImage, Coding, Pose
from services.bus.identity import new_publisher
from services.bus.memory import MemoryNetwork
from services.bus.outbox import Outbox
from services.bus.picture_stream import MOST_BYTES, Group, PictureStream
from services.process.clock import ManualClock
from tests.cameras import HEAD_IMAGE

NOWHERE = Pose((0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


class Followed:
    """A camera, and who follows it."""

    def __init__(self):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.stream = PictureStream(self.network.bus("station").subscribe(HEAD_IMAGE))
        self.camera = Outbox(new_publisher(), self.network.robot, "camera")
        self._numbers = itertools.count()

    def send(self, after_key, data=None, *, coding=Coding.H264, lost=False):
        data = bytes([next(self._numbers)]) if data is None else data
        image = CameraImage(
            camera="head", width=8, height=8, data=data, intrinsics=(1.0,) * 4, pose=NOWHERE, coding=coding,
            after_key=after_key,
        )  # fmt: skip
        payload = self.camera.pack(HEAD_IMAGE, image, self.clock.now_ns())
        if not lost:
            self.network.deliver(HEAD_IMAGE, payload)

    @property
    def seen(self):
        self.stream.latest()
        return [data[0] for data in self.stream.group.pictures]


@pytest.fixture
def followed():
    return Followed()


def test_what_came_between_two_looks_is_there_in_order(followed):
    for place in (0, 1, 2):
        followed.send(place)
    assert followed.seen == [0, 1, 2]
    followed.send(3)
    assert followed.seen == [0, 1, 2, 3]
    followed.send(0)
    followed.send(1)
    assert followed.seen == [4, 5]


def test_after_one_that_was_lost_the_last_good_one_stays_until_a_key_picture(followed):
    followed.send(0)
    followed.send(1, lost=True)
    followed.send(2)
    followed.send(3)
    assert followed.seen == [0]
    assert followed.stream.waits
    assert followed.stream.latest().message.sequence == 1
    assert followed.stream.newest.message.sequence == 4
    followed.send(0)
    assert followed.seen == [4]
    assert not followed.stream.waits


def test_a_key_picture_that_was_lost_is_not_replaced_by_the_one_before(followed):
    followed.send(0)
    followed.send(1)
    followed.send(0, lost=True)
    followed.send(1)
    followed.send(2)
    assert followed.seen == [0, 1]
    assert followed.stream.waits


def test_who_comes_later_waits_for_a_key_picture(followed):
    followed.send(1)
    assert followed.seen == []
    assert followed.stream.waits
    assert followed.stream.latest() is None


def test_another_camera_process_does_not_go_on_where_one_ended(followed):
    followed.send(0)
    followed.camera = Outbox(new_publisher(), followed.network.robot, "camera")
    followed.send(1, lost=True)
    followed.send(1)
    assert followed.seen == [0]


def test_jpeg_files_need_nothing(followed):
    followed.send(0, coding=Coding.JPEG)
    followed.send(0, coding=Coding.JPEG, lost=True)
    followed.send(0, coding=Coding.JPEG)
    assert followed.seen == [2]
    followed.send(1)
    assert followed.seen == [2], "nothing goes on from a JPEG file"


def test_what_takes_too_much_memory_is_not_kept(followed):
    for place in range(8):
        followed.send(place, bytes(900_000))
        followed.stream.latest()
    assert sum(map(len, followed.stream.group.pictures)) <= MOST_BYTES
    assert followed.stream.waits


def test_who_has_decoded_the_beginning_needs_the_rest_and_who_has_not_all():
    beginning, whole = Group(1, Coding.H264, (b"a", b"b")), Group(1, Coding.H264, (b"a", b"b", b"c"))
    assert whole.after(beginning) == (b"c",)
    assert whole.after(whole) == ()
    assert whole.after(None) == whole.after(Group(2, Coding.H264, (b"x",))) == whole.pictures
