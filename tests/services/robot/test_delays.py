"""The robot tells how long the hand's samples took, how much of it was the way, and how far the arm is behind."""

import pytest

from protocol.messages import Mode
from services.bus.stages import from_figures
from tests.services.robot.site import Site


@pytest.fixture
def site():
    one = Site()
    one.acquire()
    return one


def test_the_stages_of_a_hand_on_this_machine(site):
    site.execute(Mode.REFINE)
    site.run(1.0, master=(0.0, 0.0, 0.0))
    told = site.state
    assert 0.0 <= told.applied_way <= told.applied_latency
    assert told.ahead == 0.0, "one clock"
    assert told.following_lag > 0.0, "a command takes its period at least"


def test_the_heartbeat_tells_the_same(site):
    site.execute(Mode.REFINE)
    site.run(1.0, master=(0.0, 0.0, 0.0))
    told = from_figures(site.service.figures())
    assert told.motion == pytest.approx(site.state.following_lag)
    assert None not in (told.way, told.apply)
    assert (told.capture, told.picture) == (None, None), "what other processes know"


def test_what_nobody_leads_and_what_stands_has_no_delays(site):
    site.run(0.2)
    told = site.state
    assert (told.applied_way, told.following_lag, told.ahead) == (-1.0, -1.0, None)
    assert from_figures(site.service.figures()).known == ()


def test_an_arm_that_holds_is_not_behind(site):
    site.execute(Mode.REFINE)
    site.run(1.0, master=(0.0, 0.0, 0.0))
    site.run(0.5)
    assert site.state.hold_reason
    assert site.state.following_lag == -1.0
