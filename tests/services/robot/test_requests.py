"""What the robot process is asked for, carries out or refuses."""

import numpy as np
import pytest

from protocol import messages, queries, topics
from protocol.messages import Mode, Phase
from protocol.queries import Accepted, EpisodeStarted, Refused
from services.bus.arrays import motion_to_wire
from tests.services.predictions import announce
from tests.services.robot.arm_site import DURATION, SCENE, Site

pytestmark = pytest.mark.sim


@pytest.fixture
def site():
    return Site()


def test_a_prediction_that_was_not_heard_is_refused_with_what_to_do(site):
    site.acquire()
    refused = site.ask(queries.EXECUTE, queries.Execute(site.epoch, Mode.AUTONOMOUS, 12345, DURATION, request=1))
    assert refused == Refused("no prediction 12345 was heard from the model: predict again")
    assert site.state.phase is Phase.IDLE


def test_a_prediction_is_executed_in_the_time_that_was_asked_for(site):
    site.acquire()
    identity = announce(site.operator, site.lift())
    asked = queries.Execute(site.epoch, Mode.AUTONOMOUS, identity, 2.0 * DURATION, request=1)
    assert site.ask(queries.EXECUTE, asked) == EpisodeStarted(1)
    site.run(6.0)
    assert site.take_results()[0].refined.duration == pytest.approx(2.0 * DURATION)


def test_wrong_requests_are_refused_with_one_line(site):
    assert "nobody holds the authority" in site.execute().reason
    site.acquire()
    assert "ann holds" in site.ask(queries.ACQUIRE, queries.AcquireAuthority("bob")).reason
    assert "nothing to finish" in site.ask(queries.FINISH, queries.Finish(site.epoch)).reason
    assert "not latched" in site.ask(queries.RELEASE_STOP, queries.ReleaseStop("ann")).reason
    assert "no variant 'b9'" in site.ask(queries.RESET, queries.Reset(site.epoch, variant="b9")).reason
    nan = motion_to_wire(np.full((75, 3), np.nan), np.tile([1.0, 0.0, 0.0, 0.0], (75, 1)), 10.0)
    assert "not finite" in site.execute(motion=nan).reason
    assert "m/s" in site.execute(motion=site.lift(height=2.0)).reason
    assert isinstance(site.execute(), EpisodeStarted)
    assert "an episode is running" in site.execute().reason
    assert "an episode is running" in site.ask(queries.RESET, queries.Reset(site.epoch)).reason
    site.epoch += 1
    assert "epoch" in site.ask(queries.FINISH, queries.Finish(site.epoch)).reason


def test_reset_brings_arm_and_object_back_and_changes_the_variant(site):
    site.acquire()
    site.execute()
    site.run(3.0)
    world, scenes = site.operator.subscribe(topics.WORLD_STATE), site.operator.subscribe(topics.SCENE_STATE)
    place = tuple(SCENE.training_positions[1].tolist())
    assert site.ask(queries.RESET, queries.Reset(site.epoch, "b2", place)) == Accepted()
    site.run(1.1)
    assert scenes.latest().message.variant == "b2"
    np.testing.assert_allclose(world.latest().message.object_pose.position, place, atol=2e-3)
    np.testing.assert_allclose(site.state.measured.position, SCENE.start.position, atol=1e-3)


def test_reset_takes_a_start_keeps_it_and_announces_it_at_once(site):
    site.acquire()
    scenes = site.operator.subscribe(topics.SCENE_STATE)
    x, y, z = SCENE.start.position.tolist()
    w, i, j, k = SCENE.start.orientation.tolist()
    start = messages.Pose((x - 0.05, y + 0.1, z), (w, i, j, k))
    assert site.ask(queries.RESET, queries.Reset(site.epoch, start=start)) == Accepted()
    assert scenes.latest().message.start.position == start.position
    np.testing.assert_allclose(site.state.measured.position, start.position, atol=1e-3)
    assert site.ask(queries.RESET, queries.Reset(site.epoch)) == Accepted()
    np.testing.assert_allclose(site.state.measured.position, start.position, atol=1e-3)


@pytest.mark.parametrize(
    ("offset", "reason"),
    [
        ((0.0, 0.0, 0.4), "give a place within"),
        ((-0.3, 0.3, 0.3), "does not reach it in that orientation: give another start"),
        ((0.09, 0.04, 0.01), "would touch basket_front: give another start"),
    ],
)
def test_a_start_that_cannot_be_is_refused_and_nothing_changes(site, offset, reason):
    site.acquire()
    before = site.state
    start = messages.Pose(tuple((SCENE.start.position + offset).tolist()), tuple(SCENE.start.orientation.tolist()))
    refused = site.ask(queries.RESET, queries.Reset(site.epoch, "b2", start=start))
    assert isinstance(refused, Refused)
    assert reason in refused.reason
    assert "\n" not in refused.reason
    site.run(0.2)
    np.testing.assert_allclose(site.state.q, before.q, atol=1e-4)
    assert site.service._control.arm.variant == "b1"
