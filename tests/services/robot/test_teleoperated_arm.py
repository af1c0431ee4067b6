"""The arm under the operator's hand alone: coupled anew it does not jump, and out of reach nothing winds up."""

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lfd.motion.rotations import conjugate, exp_map, log_map, multiply
from protocol import queries
from protocol.messages import Phase
from protocol.queries import EpisodeStarted
from services.robot.teleoperation import LEASH
from tests.services.robot.arm_site import SCENE, Site

pytestmark = pytest.mark.sim

STILL = ((0.0, 0.0, 0.0), (0.0, 0.0, 0.0))
NO_JUMP_M, NO_JUMP_RAD = 1e-3, np.radians(0.2)

hands = st.tuples(st.tuples(*[st.floats(-0.3, 0.3)] * 3), st.tuples(*[st.floats(-1.0, 1.0)] * 3))


@pytest.fixture(scope="module")
def standing():
    return Site()


@pytest.fixture
def site(standing):
    """A robot at its start, just taken up by a hand at rest."""
    standing.acquire(take_over=True)
    if standing.state.phase is Phase.STOPPED:
        standing.ask(queries.RELEASE_STOP, queries.ReleaseStop("ann"))
    if standing.state.phase.running:
        standing.ask(queries.FINISH, queries.Finish(standing.epoch))
        standing.run(0.7)
    standing.ask(queries.RESET, queries.Reset(standing.epoch))
    assert isinstance(standing.ask(queries.TELEOPERATE, queries.Teleoperate(standing.epoch)), EpisodeStarted)
    be(standing, STILL, 0.05)
    return standing


def be(site, hand, seconds, *, engaged=True):
    site.run(seconds, master=hand[0], rotation=hand[1], engaged=engaged)


def steer(site, start, end, seconds):
    for share in np.linspace(0.0, 1.0, round(100 * seconds) + 1)[1:]:
        displacement, rotation = (
            tuple(float(a + share * (b - a)) for a, b in zip(*ends, strict=True))
            for ends in zip(start, end, strict=True)
        )
        be(site, (displacement, rotation), 0.01)


def apart(one, other):
    turn = log_map(multiply(conjugate(np.array(one.orientation)), np.array(other.orientation)))
    return np.linalg.norm(np.subtract(one.position, other.position)), np.linalg.norm(turn)


def test_position_and_orientation_follow_the_hand(site):
    turned = ((-0.05, 0.0, 0.05), (0.0, 0.2, 0.1))
    steer(site, STILL, turned, 1.5)
    be(site, turned, 0.5)
    measured = site.state.measured
    np.testing.assert_allclose(measured.position, SCENE.start.position + turned[0], atol=5e-3)
    wanted = multiply(exp_map(np.array(turned[1])), SCENE.start.orientation)
    assert abs(np.array(measured.orientation) @ wanted) == pytest.approx(1.0, abs=1e-4)


@settings(max_examples=8, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(st.lists(st.tuples(hands, st.floats(0.0, 0.04), st.sampled_from([-1, 1])), min_size=1, max_size=4))
def test_a_hand_that_couples_anew_moves_the_arm_by_less_than_a_millimetre(site, pauses):
    for (displacement, rotation), stroke, sign in pauses:
        be(site, (displacement, rotation), 0.45, engaged=False)
        before = site.state
        be(site, (displacement, rotation), 0.02)
        after = site.state
        for one, other in ((before.measured, after.measured), (before.reference, after.reference)):
            far, wide = apart(one, other)
            assert far < NO_JUMP_M
            assert wide < NO_JUMP_RAD
        moved = (tuple(np.add(displacement, (0.0, 0.0, sign * stroke)).tolist()), rotation)
        steer(site, (displacement, rotation), moved, 0.4)


def test_a_hand_that_pulls_out_of_reach_slips_and_is_followed_back_at_once(site):
    far = ((0.0, 0.0, 1.6), STILL[1])
    steer(site, STILL, far, 6.0)
    assert any(name.startswith("reach") for name in site.state.clamped)
    stuck = site.state.measured.position[2]
    back = ((0.0, 0.0, 1.6 - 3 * LEASH), STILL[1])
    steer(site, far, back, 0.6)
    be(site, back, 0.3)
    assert stuck - site.state.measured.position[2] > LEASH


def test_where_the_orientation_gives_way_it_is_asked_for_all_the_same(site):
    before = site.state.reference
    far, back = ((-0.1, 0.0, 1.1), STILL[1]), ((-0.1, 0.0, 0.1), STILL[1])
    steer(site, STILL, back, 0.8)
    steer(site, back, far, 5.0)
    assert apart(before, site.state.measured)[1] > np.radians(20.0), "it gave way"
    steer(site, far, back, 5.0)
    assert apart(before, site.state.reference)[1] < np.radians(0.2)
    assert apart(before, site.state.measured)[1] < np.radians(15.0)
