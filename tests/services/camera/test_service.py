"""The camera process, stepped by hand: pictures that perception can use."""

import numpy as np
import pytest

from protocol.messages import Coding, PictureQueue, Pose, SceneState, WorldState
from protocol.topics import OBJECT_POSE, PICTURE_QUEUE, POINT_CLOUD, SCENE_STATE, WORLD_STATE
from services.bus.arrays import points_from_wire, quaternion, to_wire, vector3
from services.bus.memory import MemoryNetwork
from services.perception.service import build as build_perception
from services.process.clock import ManualClock
from services.process.config import CameraSection, Configuration
from tests.cameras import HEAD_IMAGE, WRIST_IMAGE

pytestmark = pytest.mark.sim

OBJECT = (0.87, 0.05)


@pytest.fixture(scope="module")
def world():
    from sim.robots.description import prepare
    from sim.tasks import scene
    from sim.world.physics import World

    dishwasher = scene("dishwasher")
    world = World(dishwasher, "b1", prepare())
    world.reset(np.array([*OBJECT, dishwasher.region.lower[2]]))
    return world


@pytest.fixture
def system():
    from services.camera.service import build

    clock = ManualClock()
    network = MemoryNetwork(clock)
    service = build(network.bus(), clock, Configuration())
    yield network, clock, service
    service.close()


def particle_state(particle):
    pose = Pose((0.36, 0.0, 0.0), (1.0, 0.0, 0.0, 0.0))
    return WorldState(time=0.0, qpos=to_wire([*particle, 0.05, -0.05]), object_pose=pose)


def scene_state(name="dishwasher", variant="b1"):
    zero = (0.0, 0.0, 0.0)
    here = Pose(zero, (1.0, 0.0, 0.0, 0.0))
    return SceneState(
        name=name,
        variant=variant,
        boxes=(),
        object_size=zero,
        ellipsoid_radii=zero,
        kicked_over_thresholds=zero,
        start=here,
        object_region=(zero, zero),
    )


def world_state(world):
    seen = world.observe()
    pose = Pose(vector3(seen.object_position), quaternion(seen.object_orientation))
    return WorldState(time=seen.time, qpos=to_wire(world.state), object_pose=pose)


def figures(service):
    return {figure.name: figure.value for figure in service.figures()}


def test_perception_finds_the_object_in_the_head_cameras_picture(system, world):
    network, clock, camera = system
    perception = build_perception(network.bus(), clock, Configuration())
    robot = network.bus()
    heads, wrists, found = (robot.subscribe(topic) for topic in (HEAD_IMAGE, WRIST_IMAGE, OBJECT_POSE))
    robot.publish(SCENE_STATE, scene_state())
    robot.publish(WORLD_STATE, world_state(world))
    camera.step(clock.now_ns())
    perception.step(clock.now_ns())
    assert found.latest().message.error < 0.006
    for subscription in (heads, wrists):
        image = subscription.latest().message
        assert image.captured_ns == clock.now_ns()
        assert image.object_pose == world_state(world).object_pose
        assert 1_000 < len(image.data) < 60_000


def test_a_state_is_drawn_once(system, world):
    network, clock, camera = system
    robot = network.bus()
    heads = robot.subscribe(HEAD_IMAGE)
    robot.publish(SCENE_STATE, scene_state())
    robot.publish(WORLD_STATE, world_state(world))
    for _ in range(3):
        camera.step(clock.now_ns())
    assert heads.latest().message.sequence == 1


def test_the_cloud_comes_five_times_a_second_and_holds_the_object(system, world):
    network, clock, camera = system
    robot = network.bus()
    clouds, heads = robot.subscribe(POINT_CLOUD), robot.subscribe(HEAD_IMAGE)
    robot.publish(SCENE_STATE, scene_state())
    for _ in range(31):
        robot.publish(WORLD_STATE, world_state(world))
        camera.step(clock.now_ns())
        clock.advance(1 / 15)
    newest = clouds.latest().message
    assert (newest.sequence, heads.latest().message.sequence) == (11, 31)
    assert newest.captured_ns == heads.latest().message.captured_ns
    positions, _ = points_from_wire(newest.data)
    near = np.linalg.norm(positions - np.array(world_state(world).object_pose.position), axis=1) < 0.08
    assert len(positions) > 1_000
    assert np.count_nonzero(near) > 10


def test_a_state_of_another_model_is_counted_and_not_drawn(system, world):
    network, clock, camera = system
    robot = network.bus()
    heads = robot.subscribe(HEAD_IMAGE)
    robot.publish(SCENE_STATE, scene_state())
    robot.publish(WORLD_STATE, WorldState(time=0.0, qpos=to_wire(np.zeros(3)), object_pose=scene_state().start))
    camera.step(clock.now_ns())
    assert heads.latest() is None
    assert figures(camera)["unusable_states"] == 1


def test_the_scene_follows_what_the_robot_announces(system, world):
    network, clock, camera = system
    robot = network.bus()
    heads = robot.subscribe(HEAD_IMAGE)
    pictures = []
    for name, variant in (("dishwasher", "b1"), ("dishwasher", "b2"), ("nowhere", "b1"), ("table", "box")):
        clock.advance(0.1)
        robot.publish(SCENE_STATE, scene_state(name, variant))
        robot.publish(WORLD_STATE, world_state(world))
        camera.step(clock.now_ns())
        pictures.append(heads.latest().message.data)
    assert pictures[0] != pictures[1]
    assert pictures[2] == pictures[1]
    assert pictures[3] != pictures[1]


def test_the_particles_plane_is_drawn_and_perception_finds_no_object_in_it(system):
    network, clock, camera = system
    perception = build_perception(network.bus(), clock, Configuration())
    robot = network.bus()
    heads, wrists, found = (robot.subscribe(topic) for topic in (HEAD_IMAGE, WRIST_IMAGE, OBJECT_POSE))
    pictures = []
    for variant, x in (("free", 0.0), ("free", 0.2), ("obstacle", 0.0)):
        clock.advance(0.1)
        robot.publish(SCENE_STATE, scene_state("particle", variant))
        robot.publish(WORLD_STATE, particle_state((x, 0.0, 0.0)))
        camera.step(clock.now_ns())
        perception.step(clock.now_ns())
        pictures += [heads.latest().message.data, wrists.latest().message.data]
    assert len(set(pictures)) == len(pictures)
    assert found.latest() is None


@pytest.fixture
def filming():
    pytest.importorskip("av")
    from services.camera.service import build

    clock = ManualClock()
    network = MemoryNetwork(clock)
    service = build(network.bus("camera"), clock, Configuration(camera=CameraSection(codec=Coding.H264)))
    yield network, clock, service
    service.close()


def film(network, clock, service, world, pictures):
    """So many more pictures; how each of the head camera's is coded, and how far from a key picture it is."""
    robot, heads = network.bus("robot"), network.bus().subscribe(HEAD_IMAGE)
    robot.publish(SCENE_STATE, scene_state())
    for _ in range(pictures):
        clock.advance(1 / 15)
        robot.publish(WORLD_STATE, world_state(world))
        service.step(clock.now_ns())
    came = [received.message for received in heads.take()]
    assert len(came) == pictures
    return [(one.coding, one.after_key) for one in came]


def test_as_h264_perception_finds_the_object_too_in_fewer_bytes(filming, world):
    network, clock, camera = filming
    perception = build_perception(network.bus(), clock, Configuration())
    found = network.bus().subscribe(OBJECT_POSE)
    for _ in range(15):
        film(*filming, world, 1)
        perception.step(clock.now_ns())
    assert found.latest().message.sequence == 15
    assert found.latest().message.error < 0.006
    assert 0 < figures(camera)["picture_size_p50"] < 4_000


def test_who_has_lost_a_picture_gets_a_key_picture_and_who_can_show_only_jpeg_gets_that(filming, world):
    network, clock, _ = filming
    assert film(*filming, world, 6) == [(Coding.H264, place) for place in range(6)]
    looker = network.bus("station")
    looker.publish(PICTURE_QUEUE, PictureQueue(waits=True))
    assert film(*filming, world, 1) == [(Coding.H264, 0)]
    looker.publish(PICTURE_QUEUE, PictureQueue())
    assert film(*filming, world, 2) == [(Coding.H264, 1), (Coding.H264, 2)]
    looker.publish(PICTURE_QUEUE, PictureQueue(jpeg_only=True))
    assert film(*filming, world, 2) == [(Coding.JPEG, 0)] * 2
    clock.advance(3.0)  # who fell silent looks no more
    assert film(*filming, world, 2) == [(Coding.H264, 0), (Coding.H264, 1)]


def test_where_pictures_queue_h264_is_made_smaller_at_once(filming, world):
    network, clock, camera = filming
    robot, looker, heads = network.bus("robot"), network.bus("station"), network.bus().subscribe(HEAD_IMAGE)
    film(*filming, world, 15)
    full = max(len(received.message.data) for received in heads.take())
    shares = []
    for _ in range(30):
        looker.publish(PICTURE_QUEUE, PictureQueue(late=1.0))
        clock.advance(1 / 15)
        robot.publish(WORLD_STATE, world_state(world))
        if not shares or shares[-1] == 1.0:
            heads.take()
        camera.step(clock.now_ns())
        shares.append(figures(camera)["sent_share"])
    fewer = [received.message for received in heads.take()]
    assert shares[-1] < 0.1
    assert fewer[0].after_key == 0
    assert max(len(one.data) for one in fewer) < 0.5 * full
