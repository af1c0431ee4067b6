from dataclasses import replace

import numpy as np
import pytest

from lfd.motion.resampling import at_phases, from_samples
from lfd.motion.rotations import rotate
from lfd.motion.trajectory import Trajectory
from services.offline.rollout import rollout
from services.offline.steering import steered
from services.robot.assembly import simulated_arm
from services.robot.correction import UNCORRECTED, Correction
from services.robot.starts import StartImpossible
from sim.pose import Pose
from sim.robots.description import prepare
from sim.tasks import THESIS, scene

pytestmark = pytest.mark.sim

SCENE = scene("dishwasher")
PLACE = SCENE.training_positions[0]
ROLL = np.array([0.3, 0.0, 0.0])  # [rad] about the gripper's own axis


@pytest.fixture(scope="module")
def arm():
    return simulated_arm(SCENE, "b1", prepare())


def corridor(variant, duration=6.0):
    """The corridor of a variant, in the tempo of the first one so that the two pair."""
    steps = np.linalg.norm(np.diff(SCENE.corridor("b1", PLACE).positions, axis=0), axis=1)
    times = np.concatenate([[0.0], np.cumsum(steps)]) / np.sum(steps) * duration
    return from_samples(times, *SCENE.corridor(variant, PLACE)[:2], n=75)


def test_the_corridor_of_the_scene_succeeds_without_an_operator(arm):
    prediction = corridor("b1")
    outcome = rollout(arm, prediction, PLACE, variant="b1")
    assert outcome.verdict.success
    assert outcome.completed
    assert not outcome.operator_input
    np.testing.assert_allclose(outcome.refined.positions, prediction.positions, atol=1e-4)
    # Its corners are rounded: no joint turns there at once.
    np.testing.assert_allclose(outcome.measured.positions, outcome.refined.positions, atol=0.01)


def test_in_the_changed_scene_it_collides_gently_and_the_operator_saves_it(arm):
    prediction, wanted = corridor("b1"), corridor("b2")
    alone = rollout(arm, prediction, PLACE, variant="b2")
    assert alone.verdict.collision is not None
    assert alone.completed, "a collision is shown by the verdict, the episode goes on"

    def operator(view):
        phases = np.array([0.0, min(1.0, view.progress + 1 / 74)])
        offset = at_phases(wanted, phases).positions[1] - at_phases(prediction, phases).positions[1]
        return Correction(offset, np.zeros(3))

    refined = rollout(arm, prediction, PLACE, variant="b2", operator=operator)
    assert refined.verdict.success
    assert refined.operator_input
    np.testing.assert_allclose(refined.refined.positions, wanted.positions, atol=0.01)


def test_an_arm_that_something_blocks_at_the_end_of_its_motion_stands_there(arm):
    rollout(arm, corridor("b1"), PLACE, variant="b2")
    for _ in range(100):
        before = arm.tick(UNCORRECTED).observation.q
    for _ in range(1000):
        after = arm.tick(UNCORRECTED).observation.q
    np.testing.assert_allclose(after, before, atol=1e-3)


def test_a_quaternion_and_its_negative_are_the_same_episode(arm):
    """Which of the two stands for the predicted rotation reaches neither the arm nor the correction."""
    motion = corridor("b1", 4.0)
    signs = [Trajectory(motion.positions, sign * motion.orientations, motion.duration) for sign in (1.0, -1.0)]

    def operator(view):
        return Correction(np.zeros(3), min(1.0, 2.0 * view.progress) * rotate(view.nominal.orientation, ROLL))

    one, other = (rollout(arm, prediction, PLACE, variant="b1", operator=operator) for prediction in signs)
    for a, b in zip((one.commanded, one.measured), (other.commanded, other.measured), strict=True):
        np.testing.assert_array_equal(a.positions, b.positions)
        np.testing.assert_array_equal(a.orientations, b.orientations)
    np.testing.assert_array_equal(one.refined.orientations, -other.refined.orientations)


def test_a_motion_begins_at_the_start_that_it_is_given_and_the_next_one_there_too(arm):
    start = Pose(SCENE.start.position + np.array([-0.06, 0.08, -0.04]), SCENE.start.orientation)
    way = SCENE.corridor("b1", PLACE, start)
    prediction = from_samples(np.linspace(0.0, 6.0, len(way.positions)), *way[:2], n=75)
    outcome = rollout(arm, prediction, PLACE, variant="b1", start=start)
    assert outcome.verdict.success
    np.testing.assert_allclose(outcome.measured.positions[0], start.position, atol=1e-3)
    assert arm.start is start
    arm.reset(PLACE, "b1")
    np.testing.assert_allclose(arm.measured.position, start.position, atol=1e-3)
    arm.reset(PLACE, "b1", SCENE.start)


@pytest.mark.parametrize(
    ("offset", "reason"),
    [((0.09, 0.04, 0.01), "would touch basket_front"), ((-0.3, 0.3, 0.3), "does not reach")],
    ids=["blocked", "out of reach"],
)
def test_an_impossible_start_is_refused_and_nothing_changes(arm, offset, reason):
    rollout(arm, corridor("b1", 4.0), PLACE, variant="b1")
    for _ in range(50):
        before = arm.tick(UNCORRECTED)
    start = Pose(SCENE.start.position + offset, SCENE.start.orientation)
    with pytest.raises(StartImpossible, match=reason):
        arm.reset(PLACE + 0.01, "b2", start)
    after = arm.tick(UNCORRECTED)
    assert arm.variant == "b1"
    assert arm.start is not start
    np.testing.assert_allclose(after.observation.world, before.observation.world, atol=1e-3)
    np.testing.assert_allclose(after.observation.q, before.observation.q, atol=1e-3)


def test_the_same_rollout_twice_is_the_same(arm):
    first, second = (rollout(arm, corridor("b1", 4.0), PLACE, variant="b1") for _ in range(2))
    np.testing.assert_array_equal(first.measured.positions, second.measured.positions)


@pytest.mark.parametrize("reaching", THESIS.values(), ids=THESIS)
def test_an_object_that_topples_is_kicked_over_though_its_centre_moved_less_than_is_allowed(
    reaching,
):
    """On its way down the open gripper moves sideways: a finger tips the object over its edge."""
    place, trained = reaching.training_positions[0], reaching.variants[0]
    way = replace(steered(reaching.corridor(trained, place), None), duration=5.0)
    share = np.clip((np.linspace(0.0, 1.0, len(way.positions)) - 0.75) / 0.2, 0.0, 1.0)
    pushing = Trajectory(way.positions + np.outer(share, [0.0, 0.08, 0.02]), way.orientations, way.duration)
    verdict = rollout(simulated_arm(reaching, trained, prepare()), pushing, place).verdict
    assert np.all(np.abs(verdict.displacement) < reaching.kicked_thresholds)
    assert verdict.tilt > np.radians(45.0)
    assert verdict.kicked_over
