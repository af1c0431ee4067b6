"""Real cameras: a film that OpenCV opens stands in for a device here; nothing of a kernel's driver is tried."""

import logging
import threading
import time
from contextlib import closing

import cv2
import numpy as np
import pytest

from protocol.messages import Phase, Pose, RobotState
from protocol.topics import CAMERA_IMAGE, POINT_CLOUD, ROBOT_STATE
from services.bus.arrays import points_from_wire
from services.bus.memory import MemoryNetwork
from services.camera.capture import Shot, open_device
from services.camera.device import DeviceCamera
from services.camera.exceptions import CameraUnusable
from services.camera.optics import Optics, pinhole
from services.camera.places import Standing
from services.process.cameras import Device, RealSense
from services.process.clock import ManualClock, SystemClock
from services.process.config import CameraSection, Configuration

WIDTH, HEIGHT = 64, 48
HERE = Pose((0.5, -1.0, 0.8), (1.0, 0.0, 0.0, 0.0))
WITHIN_S = 10.0


def eventually(value):
    """What comes on another thread."""
    until = time.monotonic() + WITHIN_S
    while not (found := value()):
        assert time.monotonic() < until, "it does not come"
        time.sleep(0.002)
    return found


def film(path, colours, rate_hz=30.0):
    """Of pictures each of one colour, RGB."""
    writer = cv2.VideoWriter(str(path), cv2.VideoWriter_fourcc(*"MJPG"), rate_hz, (WIDTH, HEIGHT))
    for colour in colours:
        writer.write(np.full((HEIGHT, WIDTH, 3), colour[::-1], np.uint8))
    writer.release()
    return path


class Plugged:
    """A device that gives pictures while it is plugged in, each when it is asked for."""

    period_s = 0.0

    def __init__(self, *, depth=None):
        self.there, self.opened, self.asked = True, 0, 0
        self._depth = depth
        self._asked = threading.Semaphore(0)

    def __call__(self, camera, width, height):
        if not self.there:
            raise CameraUnusable(f"there is no {camera.device}: plug it in")
        self.opened += 1
        return self

    def take(self, count=1):
        """Take so many pictures."""
        self._asked.release(count)

    def pull(self):
        """Pull the plug."""
        self.there = False
        self._asked.release()

    def read(self):
        """See `Frames`."""
        self.asked += 1
        self._asked.acquire()
        return Shot(np.full((HEIGHT, WIDTH, 3), 90, np.uint8), self._depth) if self.there else None

    def close(self):
        """See `Frames`."""


@pytest.fixture
def plugged(monkeypatch):
    """A device, its clock, and the camera that it is."""
    monkeypatch.setattr("services.camera.device.AGAIN_S", 0.01)
    device, clock = Plugged(), ManualClock()
    camera = Device(name="side", device="/dev/video7", fovy=50.0)
    with closing(DeviceCamera(camera, Standing(HERE), clock, size=(WIDTH, HEIGHT), opens=device)) as looking:
        yield device, clock, looking
        device.pull()


def seen(looking, clock):
    return eventually(lambda: looking.look(clock.now_ns()))


def test_a_picture_is_seen_once_and_is_as_old_as_it_is_since_it_came(plugged):
    device, clock, looking = plugged
    device.take()
    eventually(lambda: device.asked == 2)
    came_ns = clock.now_ns()
    clock.advance(0.7)
    shown = looking.look(clock.now_ns())
    assert (shown.captured_ns, shown.pose, shown.object_pose, shown.depth) == (came_ns, HERE, None, None)
    np.testing.assert_allclose(shown.intrinsics, pinhole(50.0, WIDTH, HEIGHT).matrix)
    assert looking.look(clock.now_ns()) is None


def test_what_was_pulled_out_is_said_once_and_comes_back_when_it_is_plugged_in_again(plugged, caplog):
    device, clock, looking = plugged
    with caplog.at_level(logging.WARNING):
        device.take()
        seen(looking, clock)
        device.pull()
        eventually(lambda: len(caplog.records) == 2)
        clock.advance(2.0)
        assert looking.look(clock.now_ns()) is None
        device.there = True
        device.take()
        assert seen(looking, clock).captured_ns == clock.now_ns()
    assert [record.getMessage() for record in caplog.records] == [
        "camera side gives no pictures any more; it is looked for again",
        "camera side: there is no /dev/video7: plug it in; it is looked for again and again",
    ]
    assert device.opened == 2


def test_a_film_in_the_place_of_a_device_is_seen_in_its_colours_and_its_own_time(tmp_path):
    red, blue = (200, 20, 20), (20, 20, 200)
    camera = Device(name="side", device=str(film(tmp_path / "film.avi", [red] * 3 + [blue] * 30)))
    clock, began = SystemClock(), time.monotonic()
    with closing(DeviceCamera(camera, Standing(HERE), clock, size=(2 * WIDTH, 2 * HEIGHT))) as looking:
        first = seen(looking, clock)
        while seen(looking, clock).image[HEIGHT, WIDTH, 2] < 150:
            pass
    assert first.image.shape == (2 * HEIGHT, 2 * WIDTH, 3)
    np.testing.assert_allclose(first.image[HEIGHT, WIDTH], red, atol=12)
    assert time.monotonic() - began > 2 / 30, "no faster than it was filmed"


@pytest.mark.parametrize(
    ("camera", "said"),
    [
        (Device(name="side", device="/dev/video63"), "there is no /dev/video63: plug it in, or name another one"),
        (Device(name="side", device="no such film.avi"), "gives no pictures"),
        (RealSense(name="side"), "reads no RealSense camera: build it with WITH_LIBREALSENSE"),
    ],
)
def test_a_device_that_is_not_there_is_one_line(camera, said, capfd):
    with pytest.raises(CameraUnusable) as caught:
        open_device(camera, WIDTH, HEIGHT)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)
    assert capfd.readouterr().err == ""


def test_the_pinhole_of_larger_pictures_shows_the_same_place_at_the_same_share_of_them():
    small = Optics(320, 240, (300.0, 310.0), (150.0, 130.0))
    point = np.array([0.1, -0.07, 1.0])
    at = [(optics.matrix @ point)[:2] + 0.5 for optics in (small, small.of_size(640, 480))]
    np.testing.assert_allclose(at[1], 2.0 * at[0])


def test_a_lens_that_bends_is_straightened():
    bent = Optics(320, 240, (300.0, 300.0), (159.5, 119.5), (-0.3, 0.05, 0.0, 0.0, 0.0))
    place = np.array([[[0.3, 0.2, 1.0]]])
    ((at,), _) = cv2.projectPoints(place, np.zeros(3), np.zeros(3), bent.matrix, np.array(bent.distortion))
    picture = np.zeros((240, 320, 3), np.uint8)
    cv2.circle(picture, tuple(np.round(at.ravel()).astype(int).tolist()), 3, (255, 255, 255), -1)
    rows, columns = np.nonzero(bent.straightened(picture)[..., 0] > 128)
    expected = (bent.matrix @ place.ravel())[:2]
    np.testing.assert_allclose([columns.mean(), rows.mean()], expected, atol=1.0)
    assert np.linalg.norm(at.ravel() - expected) > 3.0


def configured(*cameras):
    return Configuration(camera=CameraSection(width=WIDTH, height=HEIGHT, cameras=cameras))


@pytest.mark.sim
def test_a_camera_that_is_not_there_keeps_no_other_from_going_on(tmp_path, caplog):
    from services.camera.service import build

    clock = SystemClock()
    network = MemoryNetwork(clock)
    there = Device(name="side", device=str(film(tmp_path / "film.avi", [(90, 90, 90)] * 90)))
    side = network.bus("robot").subscribe(CAMERA_IMAGE.of("side"))
    chosen = configured(Device(name="above", device="/dev/video63"), there)
    with caplog.at_level(logging.WARNING), closing(build(network.bus("camera"), clock, chosen)) as camera:
        while not (side.latest() and caplog.records):
            camera.step(clock.now_ns())
            time.sleep(0.01)
    assert side.latest().message.camera == "side"
    (record,) = caplog.records
    assert record.getMessage().startswith("camera above: there is no /dev/video63")


@pytest.mark.sim
def test_a_camera_on_a_link_is_where_the_joints_had_it_when_its_picture_came_and_its_depth_is_a_cloud(monkeypatch):
    from services.camera import sources
    from services.camera.service import build
    from sim.robots.description import prepare
    from sim.tasks import DISHWASHER
    from sim.world.links import Links

    device = Plugged(depth=np.full((HEIGHT, WIDTH), 0.5))
    monkeypatch.setattr(sources, "DeviceCamera", lambda *args, **named: DeviceCamera(*args, **named, opens=device))
    clock = ManualClock()
    network = MemoryNetwork(clock)
    robot = network.bus("robot")
    sent, clouds = robot.subscribe(CAMERA_IMAGE.of("head")), robot.subscribe(POINT_CLOUD)
    eye = RealSense(name="head", link="arm_7_link", position=(0.0, 0.0, 0.1))
    arm = DISHWASHER.manipulator
    with closing(build(network.bus("camera"), clock, configured(eye))) as camera:
        device.take()
        eventually(lambda: device.asked == 2)
        camera.step(clock.now_ns())
        assert sent.latest() is None, "nobody knows yet where it is"
        known = {"joint_names": arm.joint_names, "measured": HERE, "reference": HERE, "phase": Phase.IDLE}
        state = RobotState(q=arm.home, **known)
        clock.advance(0.2)
        robot.publish(ROBOT_STATE, state)
        device.take()
        eventually(lambda: device.asked == 3)
        robot.publish(ROBOT_STATE, RobotState(q=(1.0,) * len(arm.home), **known))
        camera.step(clock.now_ns())
        device.pull()
    at = Links(DISHWASHER, prepare()).pose("arm_7_link", dict(zip(arm.joint_names, arm.home, strict=True)))
    position = np.array(sent.latest().message.pose.position)
    assert np.linalg.norm(position - at.position) == pytest.approx(0.1)
    positions, _ = points_from_wire(clouds.latest().message.data)
    away = np.linalg.norm(positions - position, axis=1)
    assert (len(positions), away.min() >= 0.499, away.max() < 0.7) == (WIDTH * HEIGHT, True, True)
