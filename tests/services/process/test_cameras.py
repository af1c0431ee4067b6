"""Cameras that a configuration names: what is read, what is refused, and where they look."""

import numpy as np
import pytest

from lfd.motion.rotations import rotate
from services.bus.memory import MemoryNetwork
from services.process.cameras import Simulated
from services.process.clock import ManualClock
from services.process.config import load
from services.process.exceptions import ConfigurationError, UnusableSetting
from services.process.robots import camera_names

SIDE = '{kind = "simulated", name = "side", position = [0.9, -1.1, 1.1], look_at = [0.8, 0.0, 0.6]}'


def configured(folder, *cameras):
    path = folder / "retouch.toml"
    path.write_text(f"[camera]\ncameras = [{', '.join(cameras)}]\n")
    return load(path)


def axes(camera):
    """The camera's axes in the frame that it is fixed in, one a row, by roll, pitch and yaw about that frame's."""
    vectors = np.eye(3)
    for axis, angle in zip(np.eye(3), camera.turned, strict=True):
        vectors = rotate(np.concatenate([[np.cos(angle / 2)], np.sin(angle / 2) * axis]), vectors)
    return vectors


def test_a_camera_is_a_line_and_comes_after_the_robots_own(tmp_path):
    assert camera_names(configured(tmp_path, SIDE)) == ("head", "wrist", "side")


def test_one_that_is_called_as_one_of_the_robots_own_takes_that_ones_place(tmp_path):
    assert camera_names(configured(tmp_path, SIDE.replace("side", "wrist"))) == ("head", "wrist")


@pytest.mark.parametrize(
    ("cameras", "said"),
    [
        ((SIDE, SIDE), "two of [[camera.cameras]] are called side: give each a name of its own"),
        ((SIDE.replace("side", "live"),), "name"),
        ((SIDE.replace("side", "a/b"),), "name"),
        ((SIDE.replace("simulated", "film"),), "one of simulated, v4l2, realsense"),
        ((SIDE.replace("position", "place"),), "place"),
    ],
)
def test_what_is_no_camera_is_one_line_that_says_so(tmp_path, cameras, said):
    with pytest.raises(ConfigurationError) as caught:
        configured(tmp_path, *cameras)
    assert said in str(caught.value)
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize("place", [(1.0, 0.2, 0.5), (-0.5, 0.1, 1.5), (0.0, 2.0, 0.0), (0.3, -0.4, -1.0)])
def test_a_camera_looks_at_what_it_is_to_look_at_with_its_picture_upright(place):
    camera = Simulated(name="side", position=(0.1, -0.3, 0.2), look_at=place)
    right, down, forward = axes(camera)
    way = np.subtract(place, camera.position)
    np.testing.assert_allclose(forward, way / np.linalg.norm(way), atol=1e-12)
    assert abs(right[2]) < 1e-12
    assert down[2] < 0.0


def test_a_camera_that_looks_straight_down_has_forward_up_in_its_picture():
    right, down, forward = axes(Simulated(name="above", position=(0.0, 0.0, 2.0), look_at=(0.0, 0.0, 0.0)))
    np.testing.assert_allclose(np.array([right, down, forward]), [[0, -1, 0], [-1, 0, 0], [0, 0, -1]], atol=1e-12)


@pytest.mark.parametrize(
    ("room", "section", "said"),
    [
        ("services.camera.service", "[camera]\ncloud", "[camera] cloud"),
        ("services.perception.service", "[perception]\ncamera", "[perception] camera"),
    ],
)
def test_a_setting_that_names_no_camera_is_one_line(tmp_path, room, section, said):
    path = tmp_path / "retouch.toml"
    path.write_text(f'{section} = "nose"\n')
    build = pytest.importorskip(room).build
    clock = ManualClock()
    with pytest.raises(UnusableSetting) as caught:
        build(MemoryNetwork(clock).bus(), clock, load(path))
    assert str(caught.value).startswith(said)
    assert "there is no camera nose: name one of head, wrist" in str(caught.value)
