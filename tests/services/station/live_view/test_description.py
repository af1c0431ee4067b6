"""What the browser is told once of the robot: read as its scripts read it."""

import json

import numpy as np
import pytest

from lfd.motion.rotations import exp_map, multiply, rotate
from services.station.live_view import description
from services.station.live_view.description import describe, described
from sim.exceptions import DescriptionMissing
from sim.robots import meshes
from sim.robots.catalogue import robot
from sim.robots.description import prepare
from sim.robots.links import Mesh, read_links
from sim.tasks import DISHWASHER, PARTICLE, scene
from sim.tasks.scene import Eye

pytestmark = pytest.mark.sim


@pytest.fixture(scope="module")
def told():
    """The dishwasher's description."""
    return describe(DISHWASHER)


@pytest.fixture(scope="module")
def words(told):
    return json.loads(told.words)


def placed(words, positions):
    """Pose of every link in the robot's base, by name: as the page's robot.js composes them."""
    poses, base = [], (np.zeros(3), np.array([1.0, 0.0, 0.0, 0.0]))
    for link in words["links"]:
        position, orientation = np.array(link["position"]), np.array(link["orientation"])
        if link["joint"] >= 0:
            moved = positions[link["joint"]] * np.array(link["axis"])
            if link["slides"]:
                position = position + rotate(orientation, moved)
            else:
                orientation = multiply(orientation, exp_map(moved))
        above, turned = poses[link["parent"]] if link["parent"] >= 0 else base
        poses.append((above + rotate(turned, position), multiply(turned, orientation)))
    return {link["name"]: pose for link, pose in zip(words["links"], poses, strict=True)}


def test_the_links_are_where_pinocchio_has_them_in_any_posture(told, words):
    pinocchio = pytest.importorskip("pinocchio")
    model = pinocchio.buildModelFromUrdf(str(prepare().urdf))
    random = np.random.default_rng(4)
    low, high = model.lowerPositionLimit, model.upperPositionLimit
    for _ in range(20):
        q = random.uniform(low, high)
        data = model.createData()
        pinocchio.framesForwardKinematics(model, data, q)
        positions = [q[model.joints[model.getJointId(joint)].idx_q] for joint in told.joints]
        for name, (position, orientation) in placed(words, positions).items():
            frame = data.oMf[model.getFrameId(name, pinocchio.BODY)]
            np.testing.assert_allclose(position, frame.translation, atol=1e-9)
            np.testing.assert_allclose(rotate(orientation, np.eye(3)).T, frame.rotation, atol=1e-9)


def test_as_long_as_nothing_is_heard_the_robot_rests_in_the_scenes_posture(told, words):
    rest = dict(zip(told.joints, words["rest"], strict=True))
    assert [rest[joint] for joint in DISHWASHER.manipulator.joint_names] == DISHWASHER.posture.tolist()
    assert rest["head_2_joint"] == DISHWASHER.stance.held[1]


def test_the_shapes_numbers_give_the_meshes_back(told, words):
    counts = [(mesh["vertices"], mesh["triangles"]) for mesh in words["meshes"]]
    vertices, triangles = (3 * sum(column) for column in zip(*counts, strict=True))
    places = np.frombuffer(told.shapes, "<u2", vertices).reshape(-1, 3)
    corners = np.frombuffer(told.shapes, "<u2", triangles, 2 * vertices).reshape(-1, 3)
    assert len(told.shapes) == 2 * vertices + 2 * triangles + vertices
    forms = [part.form for link in read_links(prepare().urdf) for part in link.shapes]
    paths = list(dict.fromkeys(form.path for form in forms if isinstance(form, Mesh)))
    vertex = triangle = 0
    for mesh, path in zip(words["meshes"], paths, strict=True):
        own = places[vertex : vertex + mesh["vertices"]] * mesh["step"] + mesh["corner"]
        drawn = own[corners[triangle : triangle + mesh["triangles"]]]
        np.testing.assert_allclose(drawn, meshes.read_stl(path), atol=2e-5)
        vertex += mesh["vertices"]
        triangle += mesh["triangles"]


def test_it_is_small_enough_to_be_loaded_at_once_and_drawn_without_a_graphics_card(told, words):
    assert len(told.words) < 20_000
    assert len(told.shapes) < 400_000
    assert sum(mesh["triangles"] for mesh in words["meshes"]) <= 20_000


def test_the_gripper_reaches_as_far_ahead_of_the_grasping_frame_as_its_fingers_do(words):
    ahead = max(block["centre"][0] + block["half_sizes"][0] for block in words["gripper"])
    assert ahead == pytest.approx(0.027)  # 157 mm from the wrist, the frame at 130 mm


def test_another_robot_is_told_as_it_stands_in_the_scene():
    arm = robot("panda")
    other = describe(scene("table", arm), arm)
    words = json.loads(other.words)
    assert set(other.joints) == set(arm.moving_names)
    rest = dict(zip(other.joints, words["rest"], strict=True))
    assert [rest[joint] for joint in arm.joint_names] == list(arm.home)
    positions = dict(placed(words, words["rest"]))
    np.testing.assert_allclose(positions["panda_link0"][0], arm.base.position, atol=1e-9)
    ahead = max(block["centre"][0] + block["half_sizes"][0] for block in words["gripper"])
    assert ahead == pytest.approx(0.112 - arm.gripper.grasp_distance)


def test_a_robot_that_is_a_point_is_told_as_one():
    words = json.loads(describe(PARTICLE).words)
    assert (words["point"], words["links"]) == (PARTICLE.radius, [])
    assert words["eye"] == [list(PARTICLE.eye.position), list(PARTICLE.eye.target)]


def test_a_scene_that_is_not_known_here_has_an_arm_like_ours(told):
    unknown = describe(None)
    assert unknown.joints == told.joints
    assert set(json.loads(unknown.words)["rest"]) == {0.0}


def test_where_no_robot_is_installed_the_rest_is_shown(monkeypatch, caplog):
    def missing(scene):
        raise DescriptionMissing("example-robot-data")

    monkeypatch.setattr(description, "description_of", missing)
    assert describe(DISHWASHER).joints == ()
    assert "the robot itself is not shown" in caplog.text


def test_nothing_is_a_description_too():
    nothing = described((), {}, Eye(), None)
    assert (nothing.shapes, nothing.joints) == (b"", ())
