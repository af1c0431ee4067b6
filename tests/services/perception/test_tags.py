"""The object's marker: where it is, from pictures whose truth is known."""

from dataclasses import replace

import cv2
import numpy as np
import pytest

from services.perception.placement import angle_between, assembled, inverse, placement
from services.perception.tags import Candidate, TagFinder, Tagged, candidates, choose, decode
from sim.tasks import TABLE
from sim.tasks.thing import FAMILIES, Tag
from sim.world.tags import bits

WIDTH, HEIGHT, FOCAL = 320, 240, 290.0
INTRINSICS = (FOCAL, FOCAL, (WIDTH - 1) / 2, (HEIGHT - 1) / 2)
OVERSAMPLING = 4
TAGGED = Tagged.of(TABLE.target)
TAG = TAGGED.tag


def looking_down(height, pitch):
    """A camera this high above the base frame's origin, that looks forward and down by `pitch`."""
    x, y, z = np.array([0.0, -1.0, 0.0]), None, np.array([np.cos(pitch), 0.0, -np.sin(pitch)])
    y = np.cross(z, x)
    return assembled(np.column_stack([x, y, z]), [0.0, 0.0, height])


def upright(position, yaw):
    return placement(position, [np.cos(yaw / 2), 0.0, 0.0, np.sin(yaw / 2)])


def picture_of(base_from_object, base_from_camera, tag=TAG):
    """The marker as a pinhole camera sees it, with edges as soft as pixels make them."""
    marker = np.pad(np.pad(bits(tag) * 255, 1), 1, constant_values=255)
    texture = np.kron(marker, np.full((16, 16), 1, dtype=np.uint8))
    edge = tag.size * (tag.cells + 2) / tag.cells / 2
    square = np.array([[-edge, edge, 0, 1], [edge, edge, 0, 1], [edge, -edge, 0, 1], [-edge, -edge, 0, 1]])
    base_from_tag = base_from_object @ placement(TABLE.target.tag_pose.position, TABLE.target.tag_pose.orientation)
    seen = (inverse(base_from_camera) @ base_from_tag @ square.T)[:3]
    centres = FOCAL * seen[:2] / seen[2] + np.array([[INTRINSICS[2]], [INTRINSICS[3]]])
    fine = (centres.T + 0.5) * OVERSAMPLING - 0.5
    source = np.array([[0, 0], [1, 0], [1, 1], [0, 1]]) * len(texture) - 0.5
    warp = cv2.getPerspectiveTransform(source.astype(np.float32), fine.astype(np.float32))
    size = (WIDTH * OVERSAMPLING, HEIGHT * OVERSAMPLING)
    large = cv2.warpPerspective(texture, warp, size, borderMode=cv2.BORDER_CONSTANT, borderValue=130)
    return cv2.resize(large, (WIDTH, HEIGHT), interpolation=cv2.INTER_AREA)


def test_the_scenes_marker_is_the_dictionarys():
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, TAG.dictionary))
    cells = cv2.aruco.generateImageMarker(dictionary, TAG.id, 6)[1:-1, 1:-1] // 255
    np.testing.assert_array_equal(bits(TAG), cells)


@pytest.mark.parametrize("family", FAMILIES)
def test_every_family_is_one_of_opencvs_with_as_many_markers(family):
    dictionary = cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, family))
    assert (dictionary.markerSize, len(dictionary.bytesList)) == FAMILIES[family]


@pytest.mark.parametrize("tag", [Tag("DICT_APRILTAG_36h11", 3), Tag("DICT_5X5_100", 99)])
def test_markers_of_other_families_are_found(tag):
    camera, truth = looking_down(height=1.0, pitch=0.9), upright((0.5, 0.0, 0.6), 0.3)
    thing = replace(TABLE.target, tag=tag)
    corners = TagFinder(tag).find(picture_of(truth, camera, tag))
    choice = choose(candidates(corners, INTRINSICS, camera, Tagged.of(thing)), previous=None)
    assert np.linalg.norm(choice.base_from_object[:3, 3] - truth[:3, 3]) < 6e-3


@pytest.mark.parametrize("yaw", [-0.5, 0.0, 0.9])
@pytest.mark.parametrize("position", [(0.55, 0.0, 0.6), (0.7, -0.12, 0.6), (0.62, 0.1, 0.65)])
def test_a_known_pose_is_recovered_to_millimetres(position, yaw):
    camera = looking_down(height=1.15, pitch=0.8)
    truth = upright(position, yaw)
    corners = TagFinder(TAG).find(picture_of(truth, camera))
    choice = choose(candidates(corners, INTRINSICS, camera, TAGGED), previous=None)
    assert np.linalg.norm(choice.base_from_object[:3, 3] - truth[:3, 3]) < 4e-3
    assert angle_between(choice.base_from_object, truth) < np.radians(3.0)


def test_a_marker_that_is_covered_in_part_is_not_seen():
    camera = looking_down(height=1.15, pitch=0.8)
    picture = picture_of(upright((0.6, 0.0, 0.6), 0.0), camera)
    row, column = np.argwhere(picture < 60).mean(axis=0).astype(int)
    picture[row:, column:] = 130
    assert TagFinder(TAG).find(picture) is None


def test_a_camera_without_focal_length_gives_no_pose():
    corners = np.array([[10.0, 10.0], [30.0, 10.0], [30.0, 30.0], [10.0, 30.0]])
    assert candidates(corners, (0.0, 0.0, 0.0, 0.0), np.eye(4), TAGGED) == []


def leaning(angle):
    return placement((0.6, 0.0, 0.6), [np.cos(angle / 2), 0.0, np.sin(angle / 2), 0.0])


def test_where_the_picture_decides_the_better_explanation_counts():
    clear = [Candidate(leaning(1.2), error=0.2), Candidate(leaning(0.0), error=3.0)]
    choice = choose(clear, previous=leaning(0.0))
    assert choice.base_from_object is clear[0].base_from_object
    assert not choice.flipped


def test_where_it_does_not_the_object_stands_upright_at_first():
    ambiguous = [Candidate(leaning(1.2), error=0.20), Candidate(leaning(0.05), error=0.25)]
    choice = choose(ambiguous, previous=None)
    assert choice.base_from_object is ambiguous[1].base_from_object
    assert choice.flipped


def test_where_it_does_not_the_pose_before_decides_later():
    ambiguous = [Candidate(leaning(0.05), error=0.20), Candidate(leaning(1.2), error=0.25)]
    choice = choose(ambiguous, previous=leaning(1.1))
    assert choice.base_from_object is ambiguous[1].base_from_object
    assert choice.flipped


@pytest.mark.parametrize("data", [b"", b"garbage", b"\xff\xd8\xff\xe0 cut short"])
def test_bytes_that_are_no_picture_decode_to_nothing(data):
    assert decode(data) is None
