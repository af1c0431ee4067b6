"""The pace as it is asked for over the bus: who may, what is admitted, and what keeps the robot all the same."""

import pytest

from protocol import queries, topics
from protocol.messages import ExecutionState, Mode, Part, Phase
from protocol.queries import Accepted, Pace, Refused
from tests.services.predictions import announce
from tests.services.robot.site import Site, straight

SLOW = straight(duration=4.0)


@pytest.fixture
def site():
    site = Site()
    site.executions = site.operator.subscribe(topics.EXECUTION)
    site.acquire()
    return site


def under_way(site, mode=Mode.AUTONOMOUS, motion=SLOW):
    site.execute(mode, motion)
    site.run(0.6, master=(0.0, 0.0, 0.0))
    assert site.state.phase is Phase.EXECUTE


def pace(site, rate, until=None, epoch=None):
    return site.ask(queries.PACE, Pace(site.epoch if epoch is None else epoch, rate, until))


def test_a_pause_is_one_until_somebody_goes_on(site):
    under_way(site)
    assert pace(site, 0.0) == Accepted()
    site.run(0.4)
    paused = site.state
    site.run(2.0)
    assert site.state.progress == paused.progress < 0.3
    assert (site.state.phase, site.state.hold_reason, site.state.waiting) == (Phase.EXECUTE, "", False)
    assert pace(site, 1.0) == Accepted()
    site.run(4.5)
    assert site.result.completed


def test_the_motion_goes_back_by_a_step_and_says_so(site):
    under_way(site)
    site.run(1.0)
    pace(site, -1.0, until=0.1)
    assert site.executions.latest().message.pace in (1.0, -1.0)
    site.run(2.0)
    assert site.state.progress == pytest.approx(0.1)
    assert site.executions.latest().message.pace == 0.0


def test_what_draws_the_rest_of_the_motion_is_told(site):
    prediction = announce(site.operator, SLOW)
    request = queries.Execute(site.epoch, Mode.REFINE, prediction, 4.0, part=Part(0.25, 0.5))
    site.ask(queries.EXECUTE, request)
    site.run(0.2, master=(0.0, 0.0, 0.0))
    told = site.executions.latest().message
    assert isinstance(told, ExecutionState)
    assert (told.part, told.duration, told.pace) == (Part(0.25, 0.5), 4.0, 1.0)
    assert told.look_ahead == pytest.approx(4.0 / 74)


def test_without_a_motion_or_with_another_authority_there_is_no_pace_to_change(site):
    assert isinstance(pace(site, 0.5), Refused)
    under_way(site)
    assert isinstance(pace(site, 0.5, epoch=site.epoch + 1), Refused)
    site.press()
    assert isinstance(pace(site, 0.5), Refused)


@pytest.mark.parametrize("rate", [2.0, -2.0])
def test_a_pace_at_which_the_motion_would_be_too_fast_is_refused_with_what_would_be_right(site, rate):
    under_way(site, motion=straight(duration=0.6, length=0.5))  # 0.83 m/s
    refused = pace(site, rate)
    assert isinstance(refused, Refused)
    assert "at most 120%" in refused.reason
    assert pace(site, 1.2) == Accepted()


def test_a_paused_motion_holds_without_its_operator_and_the_pace_lets_nothing_go_on(site):
    under_way(site)
    pace(site, 0.0)
    site.run(1.0, renew=False)
    assert (site.state.phase, site.state.waiting) == (Phase.HOLD, True)
    pace(site, 1.0)
    site.run(0.5)
    assert (site.state.phase, site.state.waiting) == (Phase.HOLD, True)
    site.ask(queries.RESUME, queries.Resume(site.epoch))
    site.run(5.0)
    assert site.result.completed


def test_a_hand_that_pushed_in_a_pause_asked_for_nothing_until_it_is_neutral(site):
    under_way(site, Mode.REFINE)
    pace(site, 0.0)
    site.run(0.3, master=(0.0, 0.0, 0.0))
    site.run(0.5, master=(0.0, 0.05, 0.0))
    pace(site, 1.0)
    site.run(0.5, master=(0.0, 0.05, 0.0))
    assert site.state.offset == (0.0, 0.0, 0.0)
    site.run(0.1, master=(0.0, 0.0, 0.0))
    site.run(0.5, master=(0.0, 0.05, 0.0))
    assert site.state.offset[1] == pytest.approx(0.05, rel=1e-3)


def test_a_hand_that_pushes_before_the_part_begins_asks_for_nothing_in_it_until_it_is_neutral(site):
    prediction = announce(site.operator, SLOW)
    request = queries.Execute(site.epoch, Mode.REFINE, prediction, 4.0, part=Part(0.5, 1.0))
    site.ask(queries.EXECUTE, request)
    site.run(3.0, master=(0.0, 0.05, 0.0))
    assert site.state.progress > 0.55
    assert site.state.offset == (0.0, 0.0, 0.0)
    site.run(0.05, master=(0.0, 0.0, 0.0))
    site.run(0.5, master=(0.0, 0.05, 0.0))
    assert site.state.offset[1] == pytest.approx(0.05, rel=1e-3)
