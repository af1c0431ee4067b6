"""What the station hears of a camera: how old a picture is, and which way one looks in it."""

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lfd.motion.rotations import exp_map, multiply
from protocol.codec import encode
from protocol.messages import CameraImage, Coding, Pose
from services.bus.arrays import quaternion
from services.bus.clocks import Clocks
from services.bus.memory import MemoryNetwork
from services.bus.picture_stream import PictureStream
from services.bus.subscription import Subscription
from services.process.clock import ManualClock
from services.station.ears import PICTURES_WITHIN_S, Ears, heading, picture
from tests.cameras import HEAD_IMAGE

MS = 1_000_000
HERE, ELSEWHERE = 1 << 47, 2 << 47
LEVEL = (0.5, -0.5, 0.5, -0.5)  # the optical frame of a camera that looks along x, its picture upright
DOWN = (0.0, 0.70710678, -0.70710678, 0.0)  # straight down, what lies ahead at the top


def heard(publisher, *, captured_ms, sent_ms, came_ms):
    """A camera's subscription to which one picture has come."""
    came = Subscription(HEAD_IMAGE, "robot1", HERE, Clocks(HERE))
    shown = CameraImage(
        camera="head", width=1, height=1, data=b"x", intrinsics=(1.0,) * 4, pose=Pose((0.0,) * 3, LEVEL),
        captured_ns=captured_ms * MS, robot="robot1", topic="cam/image/head", process="camera", publisher=publisher,
        sequence=1, stamp_ns=sent_ms * MS,
    )  # fmt: skip
    came.receive(encode(HEAD_IMAGE, shown), HEAD_IMAGE.schema, came_ms * MS)
    return PictureStream(came)


def test_a_picture_is_as_old_as_what_it_shows():
    camera = heard(HERE, captured_ms=1_000, sent_ms=1_040, came_ms=1_050)
    assert picture(camera, 1_070 * MS, HERE).age_s == pytest.approx(0.070)
    assert picture(camera, 3_000 * MS, HERE).age_s == pytest.approx(2.0)


def test_of_another_machine_s_clock_only_what_passed_there_is_counted():
    camera = heard(ELSEWHERE, captured_ms=9_001_000, sent_ms=9_001_040, came_ms=1_050)
    assert picture(camera, 1_070 * MS, HERE).age_s == pytest.approx(0.060)


def test_of_a_camera_that_does_not_say_when_the_age_since_it_was_sent_is_known():
    camera = heard(HERE, captured_ms=0, sent_ms=1_040, came_ms=1_050)
    assert picture(camera, 1_070 * MS, HERE).age_s == pytest.approx(0.030)


def test_before_the_first_picture_there_is_none():
    nothing = PictureStream(Subscription(HEAD_IMAGE, "robot1", HERE, Clocks(HERE)))
    assert picture(nothing, MS, HERE) is None


@pytest.mark.parametrize("camera", [LEVEL, DOWN], ids=["level", "straight down"])
@given(yaw=st.floats(-3.1, 3.1))
def test_a_camera_that_is_turned_looks_so_far_to_the_side(camera, yaw):
    turned = multiply(exp_map(np.array((0.0, 0.0, yaw))), np.array(camera))
    assert heading(Pose((1.0, 2.0, 3.0), quaternion(turned))) == pytest.approx(yaw, abs=1e-6)


@pytest.fixture
def looking():
    """A station's ears, and its clock; a camera's picture comes when it is asked for."""
    clock = ManualClock()
    network = MemoryNetwork(clock)
    ears, camera = Ears(network.bus("station")), network.bus("camera")

    def show(**coded):
        shown = CameraImage(
            camera="head", width=1, height=1, data=b"x", intrinsics=(1.0,) * 4, pose=Pose((0.0,) * 3, LEVEL), **coded
        )
        camera.publish(HEAD_IMAGE, shown)
        ears.queue.step(clock.now_ns())

    return ears, clock, show


def test_by_pictures_that_were_there_and_are_too_old_nobody_corrects(looking):
    ears, clock, show = looking
    clock.advance(60.0)
    assert not ears.blind(clock.now_ns()), "where no camera is there is none to wait for"
    show()
    clock.advance(PICTURES_WITHIN_S)
    assert not ears.blind(clock.now_ns())
    clock.advance(0.001)
    assert ears.blind(clock.now_ns())
    show()
    assert not ears.blind(clock.now_ns())


def test_of_pictures_that_need_others_all_of_them_are_there(looking):
    ears, clock, show = looking
    show(coding=Coding.H264)
    show(coding=Coding.H264, after_key=1)
    assert len(picture(ears.cameras["head"], clock.now_ns(), HERE).group.pictures) == 2
    show()
    assert picture(ears.cameras["head"], clock.now_ns(), HERE).group is None


def test_by_pictures_that_come_and_cannot_be_shown_nobody_corrects_either(looking):
    ears, clock, show = looking
    show()
    clock.advance(PICTURES_WITHIN_S + 0.001)
    show(coding=Coding.H264, after_key=1)
    assert ears.blind(clock.now_ns())
    show(coding=Coding.H264)
    assert not ears.blind(clock.now_ns())
