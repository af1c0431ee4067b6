"""A third camera is a line of configuration: it is drawn, sent, heard at the station, on the page and recorded."""

from contextlib import closing

import cv2
import msgspec
import numpy as np
import pytest

from protocol.messages import Pose, SceneState, WorldState
from protocol.topics import CAMERA_IMAGE, RECORDING, SCENE_STATE, WORLD_STATE
from services.bus.arrays import to_wire
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.process.config import load
from services.process.robots import camera_names
from services.station.ears import Ears
from services.station.live_view.description import described
from services.station.live_view.files import Files
from services.station.page.document import document
from sim.tasks.scene import Eye
from tests.services.viewer.read import Read

pytestmark = pytest.mark.sim

LINE = 'cameras = [{kind = "simulated", name = "side", position = [0.5, -1.0, 0.6], look_at = [0.5, 0.0, 0.1]}]'
ZERO = (0.0, 0.0, 0.0)
HERE = Pose((0.36, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))


@pytest.fixture
def chosen(configuration, tmp_path):
    """The configuration of a file with that line in it."""
    path = tmp_path / "retouch.toml"
    path.write_text(f'[robot]\nscene = "particle"\n\n[camera]\n{LINE}\n')
    return msgspec.structs.replace(load(path), viewer=configuration.viewer)


def test_a_line_of_configuration_is_a_camera_from_the_page_to_the_recording(chosen, files, monkeypatch):
    from services.camera import service as camera
    from services.viewer import service as viewer

    monkeypatch.setattr(viewer, "web_files", lambda: files)
    clock = ManualClock()
    network = MemoryNetwork(clock)
    robot, names = network.bus("robot"), camera_names(chosen)
    ears, announced = Ears(network.bus("station"), names), robot.subscribe(RECORDING)
    sent = robot.subscribe(CAMERA_IMAGE.of("side"))
    with (
        closing(camera.build(network.bus("camera"), clock, chosen)) as drawing,
        closing(viewer.build(network.bus("viewer"), clock, chosen)) as recording,
    ):
        robot.publish(
            SCENE_STATE,
            SceneState(
                name="particle",
                variant="free",
                boxes=(),
                object_size=ZERO,
                ellipsoid_radii=ZERO,
                kicked_over_thresholds=ZERO,
                start=HERE,
                object_region=(ZERO, ZERO),
            ),
        )
        robot.publish(WORLD_STATE, WorldState(time=0.0, qpos=to_wire([0.1, 0.0, 0.0, 0.05, -0.05]), object_pose=HERE))
        drawing.step(clock.now_ns())
        recording.step(clock.now_ns())
    image = sent.latest().message
    picture = cv2.imdecode(np.frombuffer(image.data, np.uint8), cv2.IMREAD_COLOR)
    assert (image.camera, picture.shape, picture.std() > 5.0) == ("side", (240, 320, 3), True)
    assert image.pose.position == pytest.approx((0.5, -1.0, 0.6))
    assert ears.cameras["side"].latest().message.data == image.data
    page = document("robot1", Files(described((), {}, Eye(), None)), names)
    assert 'data-camera="side"' in page
    assert "Camera side" in page
    path = announced.latest().message.path
    (recorded,) = Read(path).values("/cameras/side", "EncodedImage:blob")
    assert bytes(recorded[0]) == image.data
