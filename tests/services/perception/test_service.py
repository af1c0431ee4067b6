"""The perception process, stepped by hand."""

import cv2
import numpy as np
import pytest

from protocol.messages import CameraImage, Coding, Pose
from protocol.topics import OBJECT_POSE, PICTURE_QUEUE
from services.bus.memory import MemoryNetwork
from services.perception.service import build
from services.process.clock import ManualClock
from services.process.config import CameraSection, Configuration
from services.video import library
from tests.cameras import HEAD_IMAGE


@pytest.fixture
def system():
    clock = ManualClock()
    network = MemoryNetwork(clock)
    service = build(network.bus(), clock, Configuration())
    return network, clock, service


def image(data, truth=None, **coded):
    return CameraImage(
        camera="head",
        width=320,
        height=240,
        data=data,
        intrinsics=(300.0, 300.0, 159.5, 119.5),
        pose=Pose((0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 0.0)),  # looks straight down
        object_pose=truth,
        **coded,
    )


def marker():
    """A marker of 60 pixels in the middle of the picture: 0.3 m below the camera."""
    picture = np.full((240, 320), 200, dtype=np.uint8)
    dictionary = cv2.aruco.getPredefinedDictionary(cv2.aruco.DICT_4X4_50)
    picture[90:150, 130:190] = cv2.aruco.generateImageMarker(dictionary, 7, 60)
    return cv2.imencode(".jpg", picture)[1].tobytes()


def figures(service):
    return {figure.name: figure.value for figure in service.figures()}


def test_the_object_is_published_with_its_distance_to_the_truth(system):
    network, clock, service = system
    other = network.bus()
    seen = other.subscribe(OBJECT_POSE)
    truth = Pose((0.0, 0.0, 0.65), (1.0, 0.0, 0.0, 0.0))  # the marker lies 0.05 m above the centre
    other.publish(HEAD_IMAGE, image(marker(), truth))
    service.step(clock.now_ns())
    found = seen.latest().message
    np.testing.assert_allclose(found.pose.position, truth.position, atol=2e-3)
    assert found.error == pytest.approx(np.linalg.norm(np.subtract(found.pose.position, truth.position)))
    assert (found.tag, found.pictures) == (7, 1)


def test_a_picture_is_looked_at_once(system):
    network, clock, service = system
    other = network.bus()
    seen = other.subscribe(OBJECT_POSE)
    other.publish(HEAD_IMAGE, image(marker()))
    for _ in range(3):
        service.step(clock.now_ns())
        clock.advance(1 / 30)
    assert seen.latest().message.sequence == 1
    assert seen.latest().message.error == -1.0


def test_what_is_no_picture_is_dropped_and_counted(system):
    network, clock, service = system
    other = network.bus()
    seen = other.subscribe(OBJECT_POSE)
    for _ in range(2):
        other.publish(HEAD_IMAGE, image(b"not a picture"))
        service.step(clock.now_ns())
    assert seen.latest() is None
    assert figures(service)["undecodable_pictures"] == 2


def test_while_the_marker_is_hidden_nothing_is_published(system):
    network, clock, service = system
    other = network.bus()
    seen = other.subscribe(OBJECT_POSE)
    empty = cv2.imencode(".jpg", np.full((240, 320), 200, dtype=np.uint8))[1].tobytes()
    other.publish(HEAD_IMAGE, image(empty))
    service.step(clock.now_ns())
    assert seen.latest() is None
    assert figures(service)["pictures_without_tag"] == 1


def test_in_h264_the_object_is_found_as_well(system):
    pytest.importorskip("av")
    from services.camera.coding import coder
    from services.camera.wishes import Wish

    network, clock, service = system
    other = network.bus()
    seen = other.subscribe(OBJECT_POSE)
    picture = cv2.imdecode(np.frombuffer(marker(), np.uint8), cv2.IMREAD_COLOR)
    camera = coder(CameraSection(codec=Coding.H264))
    for _ in range(4):
        for _ in range(2):  # perception is slower, and needs both all the same
            coded = camera.encode(picture, 80, clock.now_ns(), Wish())
            other.publish(HEAD_IMAGE, image(coded.data, coding=coded.coding, after_key=coded.after_key))
            clock.advance(1 / 15)
        service.step(clock.now_ns())
    assert (seen.latest().message.sequence, seen.latest().message.pictures) == (4, 4)
    np.testing.assert_allclose(seen.latest().message.pose.position, (0.0, 0.0, 0.65), atol=3e-3)
    assert figures(service)["undecodable_pictures"] == 0


def test_what_is_no_h264_is_counted_and_a_key_picture_asked_for(system):
    pytest.importorskip("av")
    network, clock, service = system
    other = network.bus()
    seen, asked = other.subscribe(OBJECT_POSE), other.subscribe(PICTURE_QUEUE)
    for place in (0, 1, 7):
        other.publish(HEAD_IMAGE, image(b"not a picture", coding=Coding.H264, after_key=place))
        service.step(clock.now_ns())
        clock.advance(0.25)
    assert seen.latest() is None
    assert figures(service)["undecodable_pictures"] == 2, "the last one nobody tries: what it needs never came"
    assert asked.latest().message.waits
    assert not asked.latest().message.jpeg_only
    other.publish(HEAD_IMAGE, image(marker()))
    service.step(clock.now_ns())
    assert seen.latest().message.sequence == 1


def test_where_nothing_else_can_be_decoded_jpeg_is_asked_for(monkeypatch):
    monkeypatch.setattr(library, "MODULE", "there_is_no_such_module")
    clock = ManualClock()
    network = MemoryNetwork(clock)
    service = build(network.bus(), clock, Configuration())
    asked = network.bus().subscribe(PICTURE_QUEUE)
    service.step(clock.now_ns())
    assert asked.latest().message.jpeg_only


def test_where_all_is_well_nothing_is_asked_for(system):
    pytest.importorskip("av")
    network, clock, service = system
    other = network.bus()
    asked = other.subscribe(PICTURE_QUEUE)
    other.publish(HEAD_IMAGE, image(marker()))
    service.step(clock.now_ns())
    assert asked.latest() is None
