"""The viewer process: a recording that Rerun itself finds sound, and a page that asks nobody else."""

import gzip
import http.client
import socket
import subprocess

import msgspec
import numpy as np
import pytest

from protocol.messages import (
    Box,
    CameraImage,
    MasterState,
    ObjectPose,
    Phase,
    Pose,
    Prediction,
    RobotState,
    SceneState,
    Verdict,
    WorldState,
)
from protocol.topics import (
    HEAD_IMAGE,
    MASTER_STATE,
    OBJECT_POSE,
    PREDICTION,
    RECORDING,
    ROBOT_STATE,
    SCENE_STATE,
    VERDICT,
    WORLD_STATE,
)
from services.bus.arrays import motion_to_wire, to_wire
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.process.config import Configuration, RobotSection, ViewerSection

pytestmark = pytest.mark.sim

HERE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
JOINTS = ("torso_lift_joint", "arm_1_joint", "no_such_joint")


def free_port():
    with socket.socket() as probe:
        probe.bind(("127.0.0.1", 0))
        return probe.getsockname()[1]


@pytest.fixture
def configuration(tmp_path):
    section = ViewerSection(web_port=free_port(), stream_port=free_port(), folder=str(tmp_path / "runs"))
    return Configuration(name="testbed", viewer=section)


@pytest.fixture
def files(tmp_path):
    folder = tmp_path / "web"
    folder.mkdir()
    for name in ("re_viewer.js", "re_viewer_bg.wasm"):
        (folder / f"{name}.gz").write_bytes(gzip.compress(name.encode()))
    return folder


@pytest.fixture
def build(configuration, files, monkeypatch):
    """A function that starts a viewer for a scene; returns network, clock and viewer."""
    from services.viewer import service

    monkeypatch.setattr(service, "web_files", lambda: files)
    started = []

    def build_(scene):
        clock = ManualClock()
        network = MemoryNetwork(clock)
        configured = msgspec.structs.replace(configuration, robot=RobotSection(scene=scene))
        started.append(service.build(network.bus(), clock, configured))
        return network, clock, started[-1]

    yield build_
    for viewer in started:
        viewer.close()


@pytest.fixture
def system(build):
    return build("dishwasher")


def publish_everything(bus, tick, object_size=(0.05, 0.05, 0.1)):
    motion = motion_to_wire(np.linspace((0.4, 0, 0.4), (0.6, 0, 0.5), 20), np.tile([1.0, 0, 0, 0], (20, 1)), 5.0)
    box = Box("table", (0.8, 0.0, 0.3), (0.3, 0.3, 0.02), (1.0, 0.0, 0.0, 0.0), (0.5, 0.4, 0.3, 1.0))
    bus.publish(
        SCENE_STATE,
        SceneState(
            name="table",
            variant="clear",
            boxes=(box,),
            object_size=object_size,
            ellipsoid_radii=(0.05, 0.06, 0.05),
            kicked_over_thresholds=(0.1, 0.1, 0.1),
            start=HERE,
            object_region=((0.0, 0.0, 0.0), (1.0, 1.0, 1.0)),
        ),
    )
    q = (0.1, 0.01 * tick, 0.0)
    robot = RobotState(
        joint_names=JOINTS,
        q=q,
        qd=q,
        measured=HERE,
        reference=HERE,
        phase=Phase.EXECUTE,
        offset=(0.05, 0.0, 0.0),
        turn=(0.0, np.pi / 6, 0.0),
    )
    bus.publish(ROBOT_STATE, robot)
    bus.publish(MASTER_STATE, MasterState(force=(0.0, 0.0, 1.0 * tick)))
    bus.publish(WORLD_STATE, WorldState(time=0.0, qpos=to_wire(np.zeros(5)), object_pose=HERE))
    bus.publish(OBJECT_POSE, ObjectPose(pose=HERE, tag=7, error=0.001))
    bus.publish(
        VERDICT, Verdict(reached=False, kicked_over=False, collision=tick > 2, collision_position=(0.5, 0, 0.5))
    )
    bus.publish(
        PREDICTION,
        Prediction(
            motion=motion, deviations=to_wire(np.full((20, 3), 0.01)), model_version=1, object_position=HERE.position
        ),
    )
    bus.publish(
        HEAD_IMAGE,
        CameraImage(camera="head", width=64, height=48, data=b"\xff\xd8", intrinsics=(50, 50, 32, 24), pose=HERE),
    )


def test_the_recording_is_sound_and_holds_what_was_published(system):
    from rerun.chunk import RrdReader

    from services.viewer import entities
    from services.viewer.web_files import sdk_program

    network, clock, viewer = system
    bus = network.bus()
    announced = bus.subscribe(RECORDING)
    for tick in range(6):
        publish_everything(bus, tick)
        viewer.step(clock.now_ns())
        clock.advance(1 / 30)
    viewer.close()
    recording = announced.latest().message
    verified = subprocess.run(
        [sdk_program(), "rrd", "verify", recording.path], capture_output=True, text=True, timeout=60, check=False
    )
    assert verified.returncode == 0, verified.stderr
    paths = {chunk.entity_path for chunk in RrdReader(recording.path).stream()}
    drawn = (
        entities.ENVIRONMENT,
        entities.OBJECT_SEEN,
        entities.OBJECT_TRUTH,
        entities.PREDICTION,
        entities.UNCERTAINTY,
        entities.REACHED,
        entities.KICK_LIMITS,
        entities.COLLISION,
        entities.FORCE,
        entities.JOINTS,
        entities.JOURNAL,
        f"{entities.CORRECTION}/offset",
        f"{entities.CORRECTION}/turn",
        f"{entities.CAMERAS}/head",
        f"{entities.ROBOT}/moving",
    )
    assert set(drawn) <= paths
    assert recording.path.rsplit("/", 1)[1].startswith("testbed-")


def test_a_particle_is_a_point_and_there_is_neither_arm_nor_object(build):
    from rerun.chunk import RrdReader

    from services.viewer import entities

    network, clock, viewer = build("particle")
    bus = network.bus()
    announced = bus.subscribe(RECORDING)
    for tick in range(3):
        publish_everything(bus, tick, object_size=(0.0, 0.0, 0.0))
        viewer.step(clock.now_ns())
        clock.advance(1 / 30)
    viewer.close()
    paths = {chunk.entity_path for chunk in RrdReader(announced.latest().message.path).stream()}
    assert {entities.POINT, entities.GRASP, entities.ENVIRONMENT, entities.PREDICTION, entities.REACHED} <= paths
    assert not paths & {entities.OBJECT_TRUTH, entities.KICK_LIMITS}
    assert not any(path.startswith(f"{entities.ROBOT}/") for path in paths)


def test_the_joints_move_as_the_sdk_says():
    import pyarrow as pa
    import rerun as rr

    from services.viewer.robot_model import _Joints
    from sim.robots.description import CONTROLLED_JOINTS, prepare

    tree = rr.urdf.UrdfTree.from_file_path(prepare().urdf)
    q = np.linspace(-0.5, 0.4, len(CONTROLLED_JOINTS))
    translations, quaternions = _Joints(tree, CONTROLLED_JOINTS).transforms(q)
    expected = tree.compute_joint_transform_batches(pa.array([list(CONTROLLED_JOINTS)]), pa.array([q])).flatten()
    np.testing.assert_allclose(translations, expected.field("translation").to_pylist(), atol=1e-6)
    dots = np.sum(quaternions * np.array(expected.field("quaternion").to_pylist()), axis=1)
    np.testing.assert_allclose(np.abs(dots), 1.0, atol=1e-6)


def get(port, path):
    connection = http.client.HTTPConnection("127.0.0.1", port, timeout=5)
    connection.request("GET", path)
    response = connection.getresponse()
    body = response.read()
    connection.close()
    return response, body


def test_the_page_names_the_stream_and_may_load_nothing_from_elsewhere(system, configuration):
    section = configuration.viewer
    response, page = get(section.web_port, "/?anything")
    assert f"rerun+http://localhost:{section.stream_port}/proxy".encode() in page
    policy = response.getheader("Content-Security-Policy")
    sources = policy.split("frame-ancestors", maxsplit=1)[0]
    assert "default-src 'none'" in sources
    assert sources.count("http://") == 1
    assert f"http://localhost:{section.stream_port}" in sources


def test_the_sdks_files_are_served_compressed_and_no_other_file_is(system, configuration):
    response, body = get(configuration.viewer.web_port, "/re_viewer_bg.wasm")
    assert response.getheader("Content-Encoding") == "gzip"
    assert gzip.decompress(body) == b"re_viewer_bg.wasm"
    response, _ = get(configuration.viewer.web_port, "/../web.py")
    assert response.status == http.HTTPStatus.NOT_FOUND


@pytest.mark.parametrize("setting", ["web_port", "stream_port"])
def test_a_port_in_use_is_named_with_its_setting(configuration, files, monkeypatch, setting):
    from services.process.exceptions import PortInUse
    from services.viewer import service

    monkeypatch.setattr(service, "web_files", lambda: files)
    clock = ManualClock()
    with socket.socket() as other:
        other.bind(("127.0.0.1", getattr(configuration.viewer, setting)))
        other.listen()
        with pytest.raises(PortInUse, match=setting):
            service.build(MemoryNetwork(clock).bus(), clock, configuration)


def test_a_folder_that_cannot_be_written_to_is_named(configuration, tmp_path):
    import msgspec

    from services.viewer.exceptions import ViewerError
    from services.viewer.recording import Recording
    from sim.tasks.scene import Eye

    (tmp_path / "runs").write_text("a file")
    with pytest.raises(ViewerError, match="folder"):
        Recording(msgspec.structs.replace(configuration.viewer, folder=str(tmp_path / "runs")), "testbed", 0, Eye())


def test_the_correction_is_shown_in_millimetres_and_degrees(tmp_path):
    import rerun as rr
    from rerun.chunk import RrdReader

    from services.viewer import entities, series

    path = tmp_path / "correction.rrd"
    with rr.RecordingStream("test") as stream:
        stream.save(path)
        series.log_correction(stream, (0.05, 0.0, -0.01), (0.0, np.pi / 6, 0.0))
        stream.disconnect()
    shown = {c.entity_path: c.to_record_batch().to_pydict().get("Scalars:scalars") for c in RrdReader(path).stream()}
    np.testing.assert_allclose(shown[f"{entities.CORRECTION}/offset"], [[50.0, 0.0, -10.0]])
    np.testing.assert_allclose(shown[f"{entities.CORRECTION}/turn"], [[0.0, 30.0, 0.0]])
