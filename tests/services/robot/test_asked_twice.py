"""A request whose answer was lost is asked again with its number: it gets that answer, and nothing changes."""

import pytest

from protocol import queries
from protocol.messages import Mode, Phase
from protocol.queries import Accepted, Refused
from tests.services.predictions import announce
from tests.services.robot.site import Site, straight


@pytest.fixture
def site():
    site = Site()
    site.acquire()
    return site


def execution(site, number):
    identity = announce(site.operator, straight())
    return queries.Execute(site.epoch, Mode.AUTONOMOUS, identity, 1.0, request=number)


def test_an_execution_is_begun_once_while_it_runs_and_after_its_end(site):
    asked = execution(site, 7)
    started = site.ask(queries.EXECUTE, asked)
    assert site.ask(queries.EXECUTE, asked) == started
    site.run(4.0)
    assert site.state.phase is Phase.IDLE
    assert site.ask(queries.EXECUTE, asked) == started
    site.run(0.5)
    assert (site.state.phase, site.state.episode) == (Phase.IDLE, started.episode)


def test_two_requests_of_one_number_that_wait_at_once_begin_one_episode(site):
    asked = execution(site, 7)
    pending = [site.operator.ask(queries.EXECUTE, asked) for _ in range(3)]
    site.run(0.02)
    assert len({one.poll() for one in pending}) == 1
    assert site.state.episode == 1


def test_a_finish_does_not_end_the_episode_after_the_one_that_it_ended(site):
    site.ask(queries.EXECUTE, execution(site, 7))
    finish = queries.Finish(site.epoch, request=8)
    assert site.ask(queries.FINISH, finish) == Accepted()
    site.run(1.0)
    site.ask(queries.EXECUTE, execution(site, 9))
    assert site.ask(queries.FINISH, finish) == Accepted()
    site.run(4.0)
    assert site.result.completed


def test_a_reset_does_not_put_back_what_was_arranged_since(site):
    first = queries.Reset(site.epoch, condition=(0.1, 0.1), request=7)
    assert site.ask(queries.RESET, first) == Accepted()
    assert site.ask(queries.RESET, queries.Reset(site.epoch, condition=(-0.1, 0.1), request=8)) == Accepted()
    assert site.ask(queries.RESET, first) == Accepted()
    assert tuple(site.arm.condition) == (-0.1, 0.1)


def test_a_release_of_the_stop_does_not_release_the_next_one(site):
    site.press()
    site.run(0.5)
    release = queries.ReleaseStop("ann", request=7)
    assert site.ask(queries.RELEASE_STOP, release) == Accepted()
    site.press("carol", "fire")
    site.run(0.5)
    assert site.ask(queries.RELEASE_STOP, release) == Accepted()
    assert site.safety.emergency_stop


def test_a_release_of_the_authority_does_not_take_the_next_lease(site):
    release = queries.ReleaseAuthority("ann", site.epoch, request=7)
    assert site.ask(queries.RELEASE, release) == Accepted()
    site.acquire("ann")
    assert site.ask(queries.RELEASE, release) == Accepted()
    site.run(0.1)
    assert site.authority_states.latest().message.holder == "ann"


def test_an_acquisition_gives_one_epoch(site):
    asked = queries.AcquireAuthority("bob", take_over=True, reason="it burns", request=7)
    granted = site.ask(queries.ACQUIRE, asked)
    site.acquire("ann", take_over=True)
    assert site.ask(queries.ACQUIRE, asked) == granted
    assert site.authority_states.latest().message.holder == "ann", "an epoch that has passed commands nothing"


def test_a_refusal_stays_one_until_it_is_another_request(site):
    site.press()
    refused = site.ask(queries.EXECUTE, execution(site, 7))
    assert isinstance(refused, Refused)
    site.run(0.5)
    site.release()
    site.acquire()
    assert site.ask(queries.EXECUTE, execution(site, 7)) == refused
    assert site.ask(queries.EXECUTE, execution(site, 8)).episode
