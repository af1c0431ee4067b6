"""The perception process, stepped by hand."""

import cv2
import numpy as np
import pytest

from protocol.messages import CameraImage, Pose
from protocol.topics import HEAD_IMAGE, OBJECT_POSE
from services.bus.memory import MemoryNetwork
from services.perception.service import build
from services.process.clock import ManualClock
from services.process.config import Configuration


@pytest.fixture
def system():
    clock = ManualClock()
    network = MemoryNetwork(clock)
    service = build(network.bus(), clock, Configuration())
    return network, clock, service


def image(data, truth=None):
    return CameraImage(
        camera="head",
        width=320,
        height=240,
        data=data,
        intrinsics=(300.0, 300.0, 159.5, 119.5),
        pose=Pose((0.0, 0.0, 1.0), (0.0, 1.0, 0.0, 0.0)),  # looks straight down
        object_pose=truth,
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
