from contextlib import closing

import cv2
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from sim.robots.description import RobotDescription
from sim.tasks import REACHING, scene
from sim.tasks.reaching import ReachingScene
from sim.tasks.thing import Tag
from sim.world.cameras import Cameras
from sim.world.physics import World
from sim.world.tags import bits

pytestmark = pytest.mark.sim
SCENE = pytest.mark.parametrize("place", REACHING.values(), ids=REACHING)
TAG = Tag()
CORNERS = 0.5 * np.array([[-1.0, 1.0, 0.0], [1.0, 1.0, 0.0], [1.0, -1.0, 0.0], [-1.0, -1.0, 0.0]])  # of a tag of 1 m


def _corners_in_picture(picture: np.ndarray) -> np.ndarray | None:
    """Find the tag's corners, shape (4, 2) [px]."""
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, TAG.dictionary))
    parameters = cv2.aruco.DetectorParameters()
    parameters.adaptiveThreshWinSizeStep = 4  # the default of 10 misses one tag in fifteen at this resolution
    detector = cv2.aruco.ArucoDetector(dictionary, parameters)
    corners, ids, _ = detector.detectMarkers(cv2.cvtColor(picture, cv2.COLOR_RGB2GRAY))
    found = [] if ids is None else ids.ravel().tolist()
    return corners[found.index(TAG.id)].reshape(4, 2) if TAG.id in found else None


def test_the_tag_is_the_one_of_the_dictionary() -> None:
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, TAG.dictionary))
    marker = cv2.aruco.generateImageMarker(dictionary, TAG.id, 6)
    np.testing.assert_array_equal(marker[1:-1, 1:-1] // 255, bits(TAG))


@SCENE
def test_the_head_sees_the_tag_from_the_start_wherever_the_object_stands(
    place: ReachingScene, description: RobotDescription
) -> None:
    """Each corner is found within two pixels of where the object's pose puts it."""
    world = World(place, place.variants[0], description)
    tag_pose, tag = world.scene.target.tag_pose, world.scene.target.tag
    assert tag is not None
    tag_corners = tag.size * CORNERS
    tag_rotation = Rotation.from_quat(tag_pose.orientation, scalar_first=True)
    lower, upper = place.region.lower, place.region.upper
    with closing(Cameras(place, description)) as cameras:
        for x in np.linspace(lower[0], upper[0], 3):
            for y in np.linspace(lower[1], upper[1], 4):
                world.reset(np.array([x, y, lower[2]]))
                corners = _corners_in_picture(cameras.render("head", world.state))
                assert corners is not None
                camera = cameras.pose("head", world.state)
                in_base = world.observe().object_position + tag_pose.position + tag_rotation.apply(tag_corners)
                in_camera = (
                    Rotation.from_quat(camera.orientation, scalar_first=True).inv().apply(in_base - camera.position)
                )
                projected = in_camera @ cameras.intrinsics("head").T
                np.testing.assert_allclose(corners, projected[:, :2] / projected[:, 2:], atol=2.0)


def test_the_changed_variant_looks_different(description: RobotDescription) -> None:
    place = scene("dishwasher")
    world = World(place, "b1", description)
    with closing(Cameras(place, description)) as cameras:
        before = cameras.render("head", world.state)
        cameras.show("b2")
        assert np.mean(before != cameras.render("head", world.state)) > 0.1


def test_pictures_have_the_size_that_was_asked_for(description: RobotDescription) -> None:
    place = scene("table")
    world = World(place, "clear", description)
    with closing(Cameras(place, description, width=64, height=48)) as cameras:
        assert {"head", "wrist"} <= cameras.names
        for name in ("head", "wrist"):
            picture = cameras.render(name, world.state)
            assert picture.shape == (48, 64, 3)
            assert picture.dtype == np.uint8
            assert picture.std() > 5.0
