"""Episodes of the particle: the control, execution and reports of the arm drive it, in the rollout and on the bus."""

import itertools

import numpy as np
import pytest

from lfd.motion.resampling import from_samples
from lfd.motion.trajectory import Trajectory
from protocol import messages, queries, topics
from protocol.messages import Mode
from protocol.queries import Accepted, EpisodeStarted, Refused
from services.bus.arrays import from_wire, motion_to_wire
from services.offline.demonstrations import demonstrations
from services.offline.rollout import rollout
from services.process.config import Configuration, RobotSection
from services.robot.assembly import simulated_arm
from services.robot.correction import Correction
from services.robot.memory import Volatile
from services.robot.service import build
from services.robot.starts import StartImpossible
from sim.pose import Pose
from sim.robots.description import prepare
from sim.robots.gripper import pitched_down
from sim.tasks import PARTICLE
from sim.tasks.particle import OBSTACLE_TRAINING
from tests.services.predictions import announce
from tests.services.robot.operated import Operated

pytestmark = pytest.mark.sim

FREE, OBSTACLE = PARTICLE.variants
IDENTITY = np.array([1.0, 0.0, 0.0, 0.0])


def particle(variant=FREE):
    return simulated_arm(PARTICLE, variant, prepare())


def way(variant, condition, duration=10.0, n=75):
    corridor = PARTICLE.corridor(variant, condition)
    return from_samples(np.linspace(0.0, duration, len(corridor.positions)), *corridor[:2], n)


def straight(y=0.0, n=75):
    positions = np.column_stack([np.linspace(0.0, 0.4, n), np.full(n, y), np.zeros(n)])
    return Trajectory(positions, np.tile(IDENTITY, (n, 1)), 4.0)


@pytest.mark.parametrize("variant", PARTICLE.variants)
def test_the_corridor_succeeds_for_every_condition_up_to_twice_the_trained_ones(variant):
    arm = particle(variant)
    for condition in itertools.product((-0.2, -0.1, 0.0, 0.1, 0.2), repeat=2):
        outcome = rollout(arm, way(variant, np.array(condition), 4.0), np.array(condition))
        assert outcome.verdict.success
        assert outcome.clamped == 0


def test_the_demonstrations_of_the_obstacle_analysis_run_into_it():
    arm = particle(OBSTACLE)
    for condition in OBSTACLE_TRAINING:
        outcome = rollout(arm, way(FREE, condition), condition)
        assert outcome.verdict.reached
        assert outcome.verdict.collision is not None


def test_the_displacement_of_the_stylus_is_added_to_y_and_to_nothing_else():
    arm = particle()
    wanted = Correction(np.array([0.05, 0.03, -0.04]), np.array([0.0, 0.0, 0.4]))
    outcome = rollout(arm, straight(), np.zeros(2), operator=lambda view: wanted, after=0.0)
    np.testing.assert_allclose(outcome.refined.positions[1:-1, 1], 0.03, atol=1e-9)
    np.testing.assert_allclose(outcome.refined.positions[:, [0, 2]], straight().positions[:, [0, 2]], atol=1e-6)
    np.testing.assert_array_equal(outcome.refined.orientations, straight().orientations)
    assert outcome.operator_input


def test_a_stylus_that_is_displaced_otherwise_is_no_input():
    wanted = Correction(np.array([0.1, 0.0, 0.1]), np.array([0.0, 0.3, 0.0]))
    outcome = rollout(particle(), straight(), np.zeros(2), operator=lambda view: wanted)
    assert not outcome.operator_input
    np.testing.assert_allclose(outcome.refined.positions, straight().positions, atol=1e-6)


def test_the_lesson_is_the_thesis_initial_model():
    (taught,) = demonstrations(PARTICLE)
    np.testing.assert_array_equal(taught.condition, [0.0, 0.0])
    np.testing.assert_array_equal(taught.origin, 0.0)
    np.testing.assert_allclose(taught.trajectory.positions[:, 0], np.linspace(0.0, 0.4, 75), atol=2e-3)
    at_via_points = np.interp(PARTICLE.via_x, *taught.trajectory.positions.T[:2])
    np.testing.assert_allclose(at_via_points, 0.0, atol=PARTICLE.tolerance)


def test_any_conditions_can_be_demonstrated_in_any_variant():
    taught = demonstrations(PARTICLE, OBSTACLE_TRAINING, OBSTACLE)
    np.testing.assert_array_equal([d.condition for d in taught], OBSTACLE_TRAINING)
    for demonstration in taught:
        height = np.interp(0.07, *demonstration.trajectory.positions.T[:2])
        assert height > 0.03


@pytest.mark.parametrize("variant", PARTICLE.variants)
def test_a_motion_from_another_start_leads_to_the_same_via_points(variant):
    arm, condition = particle(variant), np.array([0.1, -0.1])
    start = Pose(np.array([0.0, 0.04, 0.0]), IDENTITY)
    positions, orientations, _ = PARTICLE.corridor(variant, condition, start)
    motion = from_samples(np.linspace(0.0, 10.0, len(positions)), positions, orientations, 75)
    outcome = rollout(arm, motion, condition, start=start)
    np.testing.assert_allclose(outcome.measured.positions[0], start.position, atol=1e-6)
    assert outcome.verdict.success


def test_no_motion_starts_in_the_obstacle_beside_the_plane_or_turned():
    arm = particle(OBSTACLE)
    for position, orientation, reason in (
        ([0.07, 0.0, 0.0], IDENTITY, "particle would touch block"),
        ([0.0, 0.0, 0.05], IDENTITY, "does not reach it"),
        ([0.0, 0.0, 0.0], pitched_down(0.3), "does not reach it"),
    ):
        with pytest.raises(StartImpossible, match=reason):
            arm.reset(np.zeros(2), OBSTACLE, Pose(np.array(position), orientation))
    assert arm.start is PARTICLE.start


class Site(Operated):
    """One with the particle."""

    def __init__(self):
        configuration = Configuration(robot=RobotSection(scene="particle"))
        super().__init__(lambda bus, clock: build(bus, clock, configuration, Volatile()))
        self.scenes = self.operator.subscribe(topics.SCENE_STATE)
        self.worlds = self.operator.subscribe(topics.WORLD_STATE)
        self.results = self.operator.subscribe(topics.EPISODE_RESULT)


@pytest.fixture
def site():
    site = Site()
    site.acquire()
    return site


def test_a_reset_takes_a_condition_and_the_robot_says_at_once_where_it_stands(site):
    assert site.scenes.latest().message.condition == (0.0, 0.0)
    assert site.scenes.latest().message.condition_region == ((-0.1, -0.1), (0.1, 0.1))
    assert site.ask(queries.RESET, queries.Reset(site.epoch, OBSTACLE, condition=(0.1, -0.2))) == Accepted()
    scene = site.scenes.latest()
    assert scene.received_ns == site.clock.now_ns()
    assert (scene.message.variant, scene.message.condition) == (OBSTACLE, (0.1, -0.2))
    rings = [box for box in scene.message.boxes if box.name.startswith("via_point_2")]
    np.testing.assert_allclose(np.mean([box.centre for box in rings], axis=0), [0.36, -0.2, 0.0], atol=1e-12)
    assert site.ask(queries.RESET, queries.Reset(site.epoch)) == Accepted()
    site.run(1.0)
    assert site.scenes.latest().message.condition == (0.1, -0.2)
    np.testing.assert_allclose(from_wire(site.worlds.latest().message.qpos), [0.0, 0.0, 0.0, 0.1, -0.2])


def test_what_the_scene_does_not_have_is_refused(site):
    for request, reason in (
        (queries.Reset(site.epoch, object_position=(0.8, 0.0, 0.5)), "has no object: give a condition"),
        (queries.Reset(site.epoch, condition=(0.3, 0.0)), r"give a place from (-0.200, -0.200) to (0.200, 0.200) m"),
        (queries.Reset(site.epoch, condition=(0.1,)), "cannot stand at (0.100) m"),
        (queries.Reset(site.epoch, "b2"), "free, obstacle"),
    ):
        refused = site.ask(queries.RESET, request)
        assert isinstance(refused, Refused)
        assert reason in refused.reason


def test_a_reset_takes_a_start_beside_a_condition(site):
    start = messages.Pose((0.0, -0.05, 0.0), (1.0, 0.0, 0.0, 0.0))
    assert site.ask(queries.RESET, queries.Reset(site.epoch, FREE, None, (0.1, 0.0), start)) == Accepted()
    scene = site.scenes.latest().message
    assert (scene.start, scene.condition) == (start, (0.1, 0.0))
    turned = messages.Pose((0.0, 0.0, 0.0), (0.0, 0.0, 0.0, 1.0))
    refused = site.ask(queries.RESET, queries.Reset(site.epoch, start=turned))
    assert isinstance(refused, Refused)
    assert "no motion can start at" in refused.reason


def test_an_operator_refines_it_over_the_bus(site):
    site.ask(queries.RESET, queries.Reset(site.epoch, FREE, condition=(0.05, 0.05)))
    motion = motion_to_wire(straight().positions, straight().orientations, 4.0)
    started = site.ask(
        queries.EXECUTE, queries.Execute(site.epoch, Mode.REFINE, announce(site.operator, motion), 4.0, request=1)
    )
    assert isinstance(started, EpisodeStarted)
    site.run(0.6, master=(0.0, 0.0, 0.0))
    site.run(5.4, master=(0.02, 0.05, 0.0))
    result = site.results.latest().message
    assert result.completed
    assert result.operator_input
    assert result.verdict.reached
    assert not result.verdict.collision
    assert {f.name: f.value for f in site.service.figures()}["touching"] == 0.0
