"""The viewer process: a recording that Rerun itself finds sound."""

import subprocess

import numpy as np
import pytest

from protocol.messages import (
    Box,
    CameraImage,
    MasterState,
    ObjectPose,
    Phase,
    PointCloud,
    Pose,
    Prediction,
    RobotState,
    SceneState,
    Verdict,
    WorldState,
)
from protocol.topics import (
    MASTER_STATE,
    OBJECT_POSE,
    POINT_CLOUD,
    PREDICTION,
    RECORDING,
    ROBOT_STATE,
    SCENE_STATE,
    VERDICT,
    WORLD_STATE,
)
from services.bus.arrays import motion_to_wire, to_wire
from tests.cameras import HEAD_IMAGE

pytestmark = pytest.mark.sim

HERE = Pose((0.5, 0.0, 0.5), (1.0, 0.0, 0.0, 0.0))
JOINTS = ("torso_lift_joint", "arm_1_joint", "no_such_joint")


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
    bus.publish(POINT_CLOUD, PointCloud(camera="head", data=bytes(18)))


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
        entities.CLOUD,
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
        entities.CORRECTION_OFFSET,
        entities.CORRECTION_TURN,
        entities.GRASP,
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
