"""The point cloud: what a depth picture shows, where it is."""

import zlib
from contextlib import closing

import mujoco
import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.codec import decode, encode
from protocol.messages import MOST_POINTS, PointCloud, Pose
from protocol.topics import POINT_CLOUD
from services.bus.arrays import points_from_wire, points_to_wire, quaternion, vector3
from services.camera.cloud import FARTHEST_M, cloud, stride

UPRIGHT = (1.0, 0.0, 0.0, 0.0)
INTRINSICS = np.array([[100.0, 0.0, 15.5], [0.0, 100.0, 11.5], [0.0, 0.0, 1.0]])


def test_a_wall_before_the_camera_is_a_plane_of_points():
    """Each point lies on its pixel's ray, at the wall's distance along the optical axis."""
    image = np.zeros((24, 32, 3), dtype=np.uint8)
    positions, colours = cloud(image, np.full((24, 32), 2.0), INTRINSICS, Pose((0.0, 0.0, 1.0), UPRIGHT))
    assert positions.shape == colours.shape == (24 * 32, 3)
    np.testing.assert_allclose(positions[:, 2], 3.0)
    np.testing.assert_allclose(positions[0], [-15.5 * 0.02, -11.5 * 0.02, 3.0])


def test_the_camera_s_pose_carries_the_points_into_the_base_frame():
    """Half a turn about the optical axis: what was right is left."""
    depth = np.full((24, 32), 1.0)
    image = np.zeros((24, 32, 3), dtype=np.uint8)
    straight, _ = cloud(image, depth, INTRINSICS, Pose((0.0, 0.0, 0.0), UPRIGHT))
    turned, _ = cloud(image, depth, INTRINSICS, Pose((0.5, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0)))
    np.testing.assert_allclose(turned, straight * [-1.0, -1.0, 1.0] + [0.5, 0.0, 0.0], atol=1e-12)


def test_what_is_too_far_is_not_told():
    depth = np.full((24, 32), FARTHEST_M + 1.0)
    depth[3, 4] = 1.0
    image = np.arange(24 * 32 * 3, dtype=np.uint32).astype(np.uint8).reshape(24, 32, 3)
    positions, colours = cloud(image, depth, INTRINSICS, Pose((0.0, 0.0, 0.0), UPRIGHT))
    assert positions.shape == (1, 3)
    np.testing.assert_array_equal(colours, image[3:4, 4])


@given(st.integers(48, 1080), st.integers(64, 1920))
def test_a_cloud_fits_its_message_whatever_the_pictures_size(height, width):
    step = stride(height, width)
    assert len(range(0, height, step)) * len(range(0, width, step)) <= MOST_POINTS


@given(st.lists(st.tuples(*3 * [st.floats(-32.0, 32.0)]), max_size=50), st.integers(0, 8))
def test_points_come_over_the_wire_to_half_a_millimetre_and_what_is_left_over_is_nothing(places, left):
    positions = np.array(places).reshape(-1, 3)
    colours = np.arange(positions.size, dtype=np.uint8).reshape(-1, 3)
    told, painted = points_from_wire(points_to_wire(positions, colours) + bytes(left))
    np.testing.assert_allclose(told, positions, atol=0.000501)
    np.testing.assert_array_equal(painted, colours)


def test_a_cloud_that_cannot_be_packed_fits_its_message_too():
    rng = np.random.default_rng(3)
    colours = rng.integers(0, 256, (MOST_POINTS, 3), dtype=np.uint8)
    data = points_to_wire(rng.uniform(-32.0, 32.0, (MOST_POINTS, 3)), colours)
    message = PointCloud(camera="head", data=data)
    assert decode(POINT_CLOUD, encode(POINT_CLOUD, message)) == message


@pytest.mark.parametrize("data", [b"", b"no stream", zlib.compress(b"")])
def test_what_is_no_stream_of_points_has_none(data):
    assert len(points_from_wire(data)[0]) == 0


def test_a_stream_that_unpacks_to_more_than_a_message_holds_is_cut_there():
    assert len(points_from_wire(zlib.compress(bytes(100_000_000)))[0]) == MOST_POINTS


@pytest.mark.sim
def test_the_points_lie_where_a_ray_through_their_pixels_meets_the_world():
    """Against MuJoCo's own ray casting, which knows nothing of pictures."""
    from sim.robots.description import prepare
    from sim.tasks import scene
    from sim.world.cameras import Cameras
    from sim.world.physics import World

    place = scene("table")
    world = World(place, "clear", prepare())
    with closing(Cameras(place, prepare(), 64, 48)) as cameras:
        image = cameras.render("head", world.state)
        seen = cameras.pose("head", world.state)
        pose = Pose(vector3(seen.position), quaternion(seen.orientation))
        positions, _ = cloud(image, cameras.depth(), cameras.intrinsics("head"), pose)
        model, data = cameras._model, cameras._data
        drawn, misses = np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8), []
        for position in positions:
            ray = (position - seen.position) / np.linalg.norm(position - seen.position)
            origin = seen.position + 0.1 * ray  # outside the head, through which the camera looks
            distance = mujoco.mj_ray(model, data, origin, ray, drawn, 1, -1, np.zeros(1, dtype=np.int32), None)
            misses.append(np.linalg.norm(origin + distance * ray - position))
    assert len(positions) > 1000
    assert np.quantile(misses, 0.95) < 0.005, "all but those at edges"
