"""What was measured of a camera counts in the place of what is said of it, in all that is published of its pictures."""

from contextlib import closing

import numpy as np
import pytest

from protocol.messages import Pose, SceneState, WorldState
from protocol.topics import SCENE_STATE, WORLD_STATE
from services.bus.arrays import quaternion, to_wire, vector3
from services.bus.memory import MemoryNetwork
from services.process.calibration import Calibration, Fixed, calibration_path, save_calibration
from services.process.clock import ManualClock
from services.process.config import Configuration
from services.process.exceptions import ConfigurationError
from sim.exceptions import CameraUnfit
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE

pytestmark = pytest.mark.sim

ZERO, LEVEL = (0.0, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0)
MEASURED = Calibration(
    width=640,
    height=480,
    focal=(500.0, 510.0),
    centre=(330.0, 230.0),
    distortion=(0.0, 0.0, 0.0, 0.0, 0.0),
    pictures=12,
    error=0.1,
    fixed=Fixed("wrist_camera_frame", (0.02, 0.0, 0.0), LEVEL, poses=12, spread=0.001),
)


def fixed_to(link):
    return Calibration(**{**{name: getattr(MEASURED, name) for name in MEASURED.__struct_fields__}, "fixed": link})


@pytest.fixture
def published():
    """A function: what is published of the head's and the wrist's picture."""
    from services.camera.service import build
    from sim.robots.description import prepare
    from sim.tasks import scene
    from sim.world.physics import World

    dishwasher = scene("dishwasher")
    world = World(dishwasher, "b1", prepare())
    seen = world.observe()
    pose = Pose(vector3(seen.object_position), quaternion(seen.object_orientation))

    def publish():
        clock = ManualClock()
        network = MemoryNetwork(clock)
        robot = network.bus("robot")
        came = [robot.subscribe(topic) for topic in (HEAD_IMAGE, WRIST_IMAGE)]
        with closing(build(network.bus("camera"), clock, Configuration())) as camera:
            robot.publish(
                SCENE_STATE,
                SceneState(
                    name="dishwasher",
                    variant="b1",
                    boxes=(),
                    object_size=ZERO,
                    ellipsoid_radii=ZERO,
                    kicked_over_thresholds=ZERO,
                    start=Pose(ZERO, LEVEL),
                    object_region=(ZERO, ZERO),
                ),
            )
            robot.publish(WORLD_STATE, WorldState(time=seen.time, qpos=to_wire(world.state), object_pose=pose))
            camera.step(clock.now_ns())
        return [subscription.latest().message for subscription in came]

    return publish


def test_where_and_how_a_camera_was_measured_to_see_is_published_and_no_other_changes(published):
    head, wrist = published()
    save_calibration(calibration_path("robot1", "wrist"), MEASURED)
    head_after, wrist_after = published()
    assert (head_after.pose, head_after.intrinsics) == (head.pose, head.intrinsics)
    assert wrist_after.intrinsics == pytest.approx((250.0, 255.0, 164.75, 114.75)), "of pictures half as large"
    moved = np.subtract(wrist_after.pose.position, wrist.pose.position)
    assert np.linalg.norm(moved) == pytest.approx(0.02, abs=1e-6)
    assert abs(np.dot(wrist_after.pose.orientation, wrist.pose.orientation)) == pytest.approx(1.0)


@pytest.mark.parametrize(
    ("text", "said"),
    [("focal = 3", "focal"), ("wide = 640", "unknown key wide"), ("", "the key is missing")],
)
def test_a_file_that_is_no_calibration_is_one_line(published, text, said):
    path = calibration_path("robot1", "wrist")
    path.parent.mkdir(parents=True)
    path.write_text(text)
    with pytest.raises(ConfigurationError, match=said) as caught:
        published()
    assert str(path) in str(caught.value)


def test_one_that_was_measured_on_another_robot_is_named(published):
    save_calibration(calibration_path("robot1", "wrist"), fixed_to(Fixed("elbow", ZERO, LEVEL, poses=9, spread=0.001)))
    with pytest.raises(CameraUnfit, match="camera wrist: there is no link 'elbow'"):
        published()
