"""The viewer's pictures: JPEG files in the recording, whatever they come as; what is lost or damaged is not drawn."""

import cv2
import numpy as np
import pytest

from protocol.messages import Coding
from protocol.topics import PICTURE_QUEUE
from services.camera.coding import Coded
from tests.cameras import HEAD_IMAGE
from tests.services.video.moving import PERIOD_S, Filmed, image, number, scene

pytest.importorskip("rerun")
pytest.importorskip("av")


class Drawing:
    """A recording's entities and what was logged there."""

    def __init__(self):
        self.logged = []

    def log(self, path, picture):
        data = picture.blob.as_arrow_array().to_pylist()[0]
        self.logged.append((path, bytes(data)))


@pytest.fixture
def viewed():
    """A camera that films, what looks, and what is drawn."""
    from services.viewer.pictures import Pictures

    filmed, drawing = Filmed(), Drawing()
    return filmed, Pictures(filmed.network.bus("viewer"), drawing, ("head",)), drawing


def test_h264_is_recorded_as_jpeg_files_the_newest_of_what_came(viewed):
    filmed, pictures, drawing = viewed
    ticks = [[filmed.film(), filmed.film()][-1] for _ in range(3) if not pictures.draw(filmed.clock.now_ns())]
    pictures.draw(filmed.clock.now_ns())
    pictures.draw(filmed.clock.now_ns())
    assert len(drawing.logged) == 3
    path, data = drawing.logged[-1]
    picture = cv2.cvtColor(cv2.imdecode(np.frombuffer(data, np.uint8), cv2.IMREAD_COLOR), cv2.COLOR_BGR2RGB)
    assert path.endswith("head")
    assert number(picture) == ticks[-1]
    assert cv2.PSNR(picture, scene(ticks[-1])) > 28.0
    assert pictures.undecodable == 0


def test_garbage_is_counted_and_a_key_picture_asked_for(viewed):
    filmed, pictures, drawing = viewed
    asked, camera = (filmed.network.bus("camera") for _ in range(2))
    asked = asked.subscribe(PICTURE_QUEUE)
    for place in range(4):
        camera.publish(HEAD_IMAGE, image(Coded(b"no picture", Coding.H264, place)))
        pictures.draw(filmed.clock.now_ns())
        filmed.clock.advance(0.25)
    assert drawing.logged == []
    assert pictures.undecodable == 1
    assert asked.latest().message.waits
    filmed.clock.advance(PERIOD_S)
    filmed.film()
    pictures.draw(filmed.clock.now_ns())
    assert len(drawing.logged) == 1
