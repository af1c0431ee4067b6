"""The operator's hand leads the robot alone: by the rules of a refinement, from the bus to where the robot is."""

import numpy as np
import pytest

from protocol import queries, topics
from protocol.messages import Cut, Mode, Phase
from protocol.queries import EpisodeStarted, Refused
from services.bus.arrays import motion_from_wire
from services.robot.safety import REFERENCE_SPEED
from tests.services.robot.site import Site

REST = (0.0, 0.0, 0.0)


@pytest.fixture
def site():
    site = Site()
    site.acquire()
    return site


def teleoperate(site):
    return site.ask(queries.TELEOPERATE, queries.Teleoperate(site.epoch))


def led(site, *, hand=REST):
    """A robot that a hand has just taken up."""
    assert isinstance(teleoperate(site), EpisodeStarted)
    site.run(0.05, master=hand)


def steer(site, start, end, seconds):
    for share in np.linspace(0.0, 1.0, round(100 * seconds) + 1)[1:]:
        site.run(0.01, master=tuple((np.array(start) + share * np.subtract(end, start)).tolist()))


def at(site):
    return np.array(site.state.measured.position)


def test_the_robot_goes_where_the_hand_goes_and_tells_the_way(site):
    led(site)
    steer(site, REST, (0.0, 0.15, 0.0), 1.0)
    np.testing.assert_allclose(at(site), (0.0, 0.15, 0.0), atol=1e-9)
    assert (site.state.mode, site.state.phase) == (Mode.TEACH, Phase.EXECUTE)
    site.finish()
    site.run(0.6, master=(0.0, 0.15, 0.0))
    result = site.result
    assert (result.mode, result.prediction, result.cut) == (Mode.TEACH, 0, Cut.FINISHED)
    assert result.reason == "finished by ann"
    assert result.operator_input
    for motion in (result.refined, result.commanded, result.measured):
        positions, _, duration, _ = motion_from_wire(motion)
        np.testing.assert_allclose(positions[[0, -1]], [REST, (0.0, 0.15, 0.0)], atol=1e-9)
        assert duration == pytest.approx(1.06, abs=0.03)


def test_a_hand_that_was_elsewhere_before_asks_for_nothing(site):
    led(site, hand=(0.0, 0.2, 0.0))
    np.testing.assert_array_equal(at(site), REST)
    steer(site, (0.0, 0.2, 0.0), (0.0, 0.25, 0.0), 0.5)
    np.testing.assert_allclose(at(site), (0.0, 0.05, 0.0), atol=1e-9)


def test_decoupled_the_robot_stands_and_coupled_again_it_goes_on_without_a_jump(site):
    led(site)
    steer(site, REST, (0.0, 0.1, 0.0), 1.0)
    site.run(2.0, master=(0.0, -0.2, 0.0), engaged=False)
    np.testing.assert_allclose(at(site), (0.0, 0.1, 0.0), atol=1e-9)
    assert (site.state.phase, site.state.waiting) == (Phase.EXECUTE, False)
    site.run(0.05, master=(0.0, -0.2, 0.0))
    np.testing.assert_allclose(at(site), (0.0, 0.1, 0.0), atol=1e-9)
    steer(site, (0.0, -0.2, 0.0), (0.0, -0.1, 0.0), 1.0)
    np.testing.assert_allclose(at(site), (0.0, 0.2, 0.0), atol=1e-9)


def test_a_hand_that_was_off_between_two_samples_of_one_period_is_coupled_anew(site):
    led(site)
    for engaged, hand in ((False, (0.0, 0.2, 0.0)), (True, (0.0, 0.2, 0.0))):
        site.say(hand, engaged=engaged)
    site.run(0.05)
    np.testing.assert_array_equal(at(site), REST)


def test_another_master_is_coupled_anew(site):
    led(site)
    site.operator = site.network.bus()
    site.run(0.5, master=(0.0, 0.2, 0.0))
    np.testing.assert_array_equal(at(site), REST)


def test_a_silent_master_holds_and_after_a_moment_somebody_has_to_ask(site):
    led(site)
    site.run(0.3)
    assert (site.state.phase, site.state.waiting) == (Phase.HOLD, False)
    site.run(0.5)
    assert site.state.waiting
    site.run(0.2, master=(0.0, 0.1, 0.0))
    assert site.state.phase is Phase.HOLD
    site.ask(queries.RESUME, queries.Resume(site.epoch))
    site.run(0.1, master=(0.0, 0.1, 0.0))
    np.testing.assert_array_equal(at(site), REST)
    steer(site, (0.0, 0.1, 0.0), (0.0, 0.2, 0.0), 0.5)
    np.testing.assert_allclose(at(site), (0.0, 0.1, 0.0), atol=1e-9)


def test_without_its_operator_it_holds(site):
    led(site)
    site.run(0.3, renew=False, master=(0.0, 0.1, 0.0))
    assert site.state.phase is Phase.HOLD
    assert at(site)[1] < 0.1


def test_a_master_of_another_epoch_leads_nothing(site):
    teleoperate(site)
    site.run(0.2, master=REST, epoch=site.epoch + 1)
    site.run(0.2, master=(0.0, 0.1, 0.0), epoch=site.epoch + 1)
    np.testing.assert_array_equal(at(site), REST)
    assert site.state.phase is Phase.HOLD


def test_a_hand_that_jumps_is_followed_at_the_reference_s_speed_and_no_further_than_the_leash(site):
    led(site)
    before = at(site)
    for _ in range(40):
        site.run(0.01, master=(0.0, 0.3, 0.0))
        assert np.linalg.norm(at(site) - before) <= REFERENCE_SPEED * 0.01 + 1e-9
        before = at(site)
    assert before[1] < 0.3
    assert site.state.phase is Phase.EXECUTE


def test_the_emergency_stop_ends_it(site):
    led(site)
    steer(site, REST, (0.0, 0.1, 0.0), 0.5)
    site.press()
    site.run(0.5, master=(0.0, 0.3, 0.0))
    np.testing.assert_allclose(at(site), (0.0, 0.1, 0.0), atol=0.005)
    assert site.result.cut is Cut.STOPPED


def test_it_needs_the_authority_and_a_robot_that_stands(site):
    site.execute()
    refused = teleoperate(site)
    assert isinstance(refused, Refused)
    assert "running" in refused.reason
    site.epoch += 1
    assert isinstance(teleoperate(site), Refused)


def test_asked_twice_it_begins_once(site):
    request = queries.Teleoperate(site.epoch, request=7)
    first, second = site.ask(queries.TELEOPERATE, request), site.ask(queries.TELEOPERATE, request)
    assert first == second


def test_what_leads_is_told(site):
    states = site.operator.subscribe(topics.EXECUTION)
    led(site)
    site.run(0.3, master=REST)
    said = states.latest().message
    assert (said.mode, said.prediction, said.episode) == (Mode.TEACH, 0, 1)
