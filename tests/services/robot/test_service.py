import numpy as np
import pytest

from lfd.motion.rotations import exp_map, multiply
from protocol import messages, queries, topics
from protocol.messages import Mode, Phase
from protocol.queries import Accepted, AuthorityGranted, EpisodeStarted, Refused
from services.bus.arrays import from_wire, motion_to_wire
from services.bus.memory import MemoryNetwork
from services.process.clock import ManualClock
from services.process.config import Configuration
from services.robot import safety
from services.robot.memory import Volatile
from services.robot.service import build
from sim.tasks import scene
from tests.services.predictions import announce

pytestmark = pytest.mark.sim

SCENE = scene("dishwasher")
DURATION = 1.48  # [s]: a look-ahead of two control periods


class Site:
    """A robot process, an operator, and a clock that is moved by hand."""

    def __init__(self):
        self.clock = ManualClock()
        self.network = MemoryNetwork(self.clock)
        self.operator = self.network.bus()
        self.service = build(self.network.bus(), self.clock, Configuration(), Volatile())
        self.robot_state = self.operator.subscribe(topics.ROBOT_STATE)
        self.results = self.operator.subscribe(topics.EPISODE_RESULT)
        self.safety = self.operator.subscribe(topics.SAFETY_STATE)
        self.execution = self.operator.subscribe(topics.EXECUTION)
        self.epoch = 0

    def run(self, seconds, *, renew=True, master=None, rotation=(0.0, 0.0, 0.0), epoch=None):
        for _ in range(round(seconds * 100)):
            self.clock.advance(0.01)
            epoch_now = self.epoch if epoch is None else epoch
            if renew:
                self.operator.publish(
                    topics.AUTHORITY_RENEWAL, messages.AuthorityRenewal(holder="ann", epoch=self.epoch)
                )
            if master is not None:
                state = messages.MasterState(
                    displacement=master, rotation=rotation, engaged=True, holder="ann", epoch=epoch_now
                )
                self.operator.publish(topics.MASTER_STATE, state)
            self.service.step(self.clock.now_ns())

    def ask(self, query, request):
        pending = self.operator.ask(query, request)
        self.run(0.01)
        return pending.poll()

    def acquire(self, holder="ann", *, take_over=False):
        reply = self.ask(queries.ACQUIRE, queries.AcquireAuthority(holder, take_over=take_over))
        assert isinstance(reply, AuthorityGranted)
        self.epoch = reply.epoch

    def execute(self, mode=Mode.AUTONOMOUS, *, request=1, motion=None, adapt=queries.Adapt.NEXT):
        motion = self.lift() if motion is None else motion
        self.predicted, self.identity = motion, announce(self.operator, motion)
        asked = queries.Execute(self.epoch, mode, self.identity, motion.duration, adapt, request=request)
        return self.ask(queries.EXECUTE, asked)

    def refine(self, **asked):
        """Begin a refinement with a hand that rests until the ramp is over."""
        assert isinstance(self.execute(Mode.REFINE, **asked), EpisodeStarted)
        self.run(0.6, master=(0.0, 0.0, 0.0))

    def lift(self, height=0.03, n=75, duration=DURATION):
        """A motion from the start backwards and up, clear of everything."""
        positions = np.tile(SCENE.start.position, (n, 1))
        positions[:, 2] += np.linspace(0.0, height, n)
        return motion_to_wire(positions, np.tile(SCENE.start.orientation, (n, 1)), duration)

    @property
    def state(self):
        return self.robot_state.latest().message

    def take_results(self):
        return [received.message for received in self.results.take()]


@pytest.fixture
def site():
    return Site()


def test_an_autonomous_episode_runs_to_its_end_and_is_reported_until_the_next_one(site):
    site.acquire()
    assert site.execute(request=42) == EpisodeStarted(1)
    assert site.state.phase is Phase.RAMP
    site.run(1.0)
    assert site.state.phase is Phase.EXECUTE
    shown = site.execution.latest().message
    assert (shown.episode, shown.prediction) == (1, site.identity)
    assert 0.0 < shown.progress < 1.0
    site.run(2.0)
    results = site.take_results()
    assert (results[0].episode, results[0].request, results[0].completed) == (1, 42, True)
    assert results[0].prediction == site.identity
    assert not results[0].operator_input
    assert results[0].verdict.collision is False
    refined, measured = (from_wire(m.positions) for m in (results[0].refined, results[0].measured))
    np.testing.assert_allclose(refined, from_wire(site.predicted.positions), atol=1e-6)
    np.testing.assert_allclose(measured, refined, atol=1e-3)
    assert results[0].refined.duration == pytest.approx(DURATION)
    assert site.state.phase is Phase.IDLE
    site.run(3.0)
    assert [r.episode for r in site.take_results()] == [1, 1, 1]
    assert site.execute(request=43) == EpisodeStarted(2)
    site.take_results()
    site.run(1.5)
    assert site.take_results() == []


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


def test_an_episode_does_not_go_on_under_another_operator(site):
    site.acquire("ann")
    site.execute()
    site.run(1.0)
    site.acquire("bob", take_over=True)
    site.run(1.0, renew=False)
    result = site.take_results()[0]
    assert not result.completed
    assert "bob took the authority over from ann" in result.reason
    assert site.state.phase is Phase.IDLE


def test_an_episode_goes_on_when_its_operator_is_back_and_asks_for_it(site):
    site.acquire("ann")
    site.execute()
    site.run(1.0)
    site.run(2.0, renew=False)
    assert site.state.phase is Phase.HOLD
    site.acquire("ann")
    site.run(1.0)
    assert site.state.phase is Phase.HOLD
    assert site.ask(queries.RESUME, queries.Resume(site.epoch)) == Accepted()
    site.run(3.0)
    assert site.take_results()[0].completed


def test_the_operators_displacement_becomes_the_refinement(site):
    site.acquire()
    site.refine()
    site.run(2.5, master=(0.0, 0.0, 0.02))
    result = site.take_results()[0]
    assert result.operator_input
    assert result.completed
    correction = from_wire(result.refined.positions) - from_wire(site.predicted.positions)
    np.testing.assert_allclose(correction[[0, -1]], [[0.0, 0.0, 0.0], [0.0, 0.0, 0.02]], atol=1e-5)
    assert site.state.applied_sequence > 0
    assert site.state.applied_latency >= 0.0
    assert site.state.measured.position[2] == pytest.approx(SCENE.start.position[2] + 0.05, abs=2e-3)


@pytest.mark.parametrize("adapt", queries.Adapt)
def test_the_operators_rotation_becomes_the_refinement_s_orientation(site, adapt):
    turn = np.array([0.0, -0.2, 0.1])
    site.acquire()
    site.refine(motion=site.lift(duration=3.0), adapt=adapt)
    site.run(1.4, master=(0.0, 0.0, 0.0), rotation=tuple(turn.tolist()))
    np.testing.assert_allclose(site.state.turn, turn, atol=1e-6)
    site.run(2.5, master=(0.0, 0.0, 0.0), rotation=tuple(turn.tolist()))
    result = site.take_results()[0]
    assert result.operator_input, "turning alone is input too"
    assert result.completed
    wanted = multiply(exp_map(turn), SCENE.start.orientation)
    for motion in (result.refined, result.commanded, result.measured):
        orientations = from_wire(motion.orientations)
        np.testing.assert_allclose(np.linalg.norm(orientations, axis=1), 1.0, atol=1e-12)
        assert abs(orientations[-1] @ wanted) == pytest.approx(1.0, abs=1e-5)
    moved = from_wire(result.commanded.positions) - from_wire(site.predicted.positions)
    np.testing.assert_allclose(moved, 0.0, atol=3e-3)
    np.testing.assert_allclose(moved[-1], 0.0, atol=1e-4)


def test_a_rotation_beyond_the_reach_is_clamped_and_said(site):
    site.acquire()
    site.refine(motion=site.lift(duration=3.0))
    site.run(0.6, master=(0.0, 0.0, 0.0), rotation=(0.0, -1e9, 0.0))
    assert "rotation" in site.state.clamped
    site.run(3.0, master=(0.0, 0.0, 0.0), rotation=(0.0, -1e9, 0.0))
    assert np.linalg.norm(site.state.turn) <= safety.ROTATION_REACH * (1.0 + 1e-6)


def test_a_refinement_holds_when_the_master_falls_silent_and_goes_on_when_it_is_back(site):
    site.acquire()
    site.refine()
    site.run(0.4, master=(0.0, 0.0, 0.01), rotation=(0.0, -0.1, 0.0))
    site.run(0.09)
    assert site.state.phase is Phase.EXECUTE
    site.run(0.04)
    held = site.state
    assert held.phase is Phase.HOLD
    assert "100 ms" in held.hold_reason
    site.run(0.4)
    assert held.turn[1] < 0.0
    assert (site.state.progress, site.state.offset, site.state.turn, site.state.reference) == (
        held.progress,
        held.offset,
        held.turn,
        held.reference,
    )
    site.run(2.0, master=(0.0, 0.0, 0.01))
    result = site.take_results()[0]
    assert result.completed
    assert result.held == pytest.approx(0.42, abs=0.03)
    assert result.refined.duration == pytest.approx(DURATION)


def test_a_master_of_another_epoch_moves_nothing(site):
    site.acquire()
    site.execute(Mode.REFINE)
    site.run(1.0, master=(0.0, 0.0, 0.01), epoch=site.epoch - 1)
    assert site.state.phase is Phase.HOLD
    assert site.state.offset == (0.0, 0.0, 0.0)


def test_every_episode_holds_when_the_lease_runs_out(site):
    site.acquire()
    site.execute()
    site.run(1.2, renew=False)
    assert site.state.phase is Phase.HOLD
    assert site.state.hold_reason == "nobody holds the authority"


def test_the_emergency_stop_latches_and_asks_for_release_and_a_new_authority(site):
    site.acquire()
    site.execute()
    site.run(0.8)
    site.operator.publish(topics.EMERGENCY_STOP, messages.EmergencyStop(pressed=True, by="bob", reason="smoke"))
    site.run(0.01)
    assert site.state.phase is Phase.STOPPED
    assert site.safety.latest().message.emergency_stop
    result = site.take_results()[0]
    assert not result.completed
    assert result.reason == "emergency stop by bob: smoke"
    before = site.state.q
    for refused in (
        site.execute(),
        site.ask(queries.RESET, queries.Reset(site.epoch)),
        site.ask(queries.ACQUIRE, queries.AcquireAuthority("ann", take_over=True)),
    ):
        assert isinstance(refused, Refused)
        assert "smoke" in refused.reason
    site.run(0.5)
    np.testing.assert_allclose(site.state.q, before, atol=2e-3)
    assert site.ask(queries.RELEASE_STOP, queries.ReleaseStop("ann")) == Accepted()
    assert isinstance(site.execute(), Refused)
    site.acquire()
    assert isinstance(site.execute(), EpisodeStarted)


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


def test_finish_ends_the_episode_with_the_part_that_was_done(site):
    site.acquire()
    site.execute()
    site.run(1.2)
    share = site.state.progress
    assert site.ask(queries.FINISH, queries.Finish(site.epoch)) == Accepted()
    site.run(0.6)
    result = site.take_results()[0]
    assert not result.completed
    assert "finished by ann" in result.reason
    assert result.refined.positions.shape == (75, 3)
    assert result.refined.duration == pytest.approx(share * DURATION, abs=0.03)


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


def test_every_topic_comes_at_the_rate_of_the_registry(site):
    published = (
        topics.ROBOT_STATE,
        topics.WORLD_STATE,
        topics.VERDICT,
        topics.AUTHORITY_STATE,
        topics.SAFETY_STATE,
        topics.SCENE_STATE,
    )
    observer = site.network.bus()
    for topic in published:
        observer.subscribe(topic)
    observer.figures()
    site.run(4.0, renew=False)
    for topic, figures in zip(published, observer.figures(), strict=True):
        assert figures.rate_hz == pytest.approx(topic.rate_hz, rel=0.05, abs=0.5)


def test_the_figures_have_names_and_units(site):
    site.acquire()
    site.refine()
    site.run(1.0, master=(0.0, 0.0, 0.01))
    figures = {figure.name: figure for figure in site.service.figures()}
    assert figures["simulation_lag"].value == pytest.approx(0.0, abs=0.011)
    assert figures["touching"].value == 0.0
    assert figures["sample_to_command_p99"].unit == "ms"
