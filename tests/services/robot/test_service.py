"""The robot process with the arm: episodes, and what it reports."""

import numpy as np
import pytest

from protocol import messages, queries, topics
from protocol.messages import Cut, Phase
from protocol.queries import Accepted, EpisodeStarted, Refused
from services.bus.arrays import from_wire
from tests.services.robot.arm_site import DURATION, Site

pytestmark = pytest.mark.sim


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
    assert results[0].cut is None
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


def test_an_episode_does_not_go_on_under_another_operator(site):
    site.acquire("ann")
    site.execute()
    site.run(1.0)
    site.acquire("bob", take_over=True)
    site.run(1.0, renew=False)
    result = site.take_results()[0]
    assert not result.completed
    assert result.cut is Cut.TAKEN_OVER
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


def test_every_episode_holds_when_the_lease_runs_out(site):
    site.acquire()
    site.execute()
    site.run(1.2, renew=False)
    assert site.state.phase is Phase.HOLD
    assert "nobody holds the authority" in site.state.hold_reason


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
        site.ask(queries.ACQUIRE, queries.AcquireAuthority("ann", take_over=True, reason="it burns")),
    ):
        assert isinstance(refused, Refused)
        assert "smoke" in refused.reason
    site.run(0.5)
    np.testing.assert_allclose(site.state.q, before, atol=2e-3)
    assert site.ask(queries.RELEASE_STOP, queries.ReleaseStop("ann")) == Accepted()
    assert isinstance(site.execute(), Refused)
    site.acquire()
    assert isinstance(site.execute(), EpisodeStarted)


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


def test_what_whoever_has_no_authority_sends_is_counted_and_counts_for_nothing(site):
    site.acquire()
    before = site.service.figures()
    for _ in range(3):
        site.operator.publish(topics.MASTER_STATE, messages.MasterState(holder="eve", epoch=site.epoch))
        site.operator.publish(topics.AUTHORITY_RENEWAL, messages.AuthorityRenewal(holder="eve", epoch=site.epoch))
        site.run(0.01)
    counted = [{figure.name: figure.value for figure in figures} for figures in (before, site.service.figures())]
    assert counted[1]["without_authority"] - counted[0]["without_authority"] == 6.0
