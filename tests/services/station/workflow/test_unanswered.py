"""A motion that has to be answered: its buttons stay until somebody answers, through an outage of a moment, too."""

import pytest

from protocol.messages import Light
from protocol.messages import Phase as RobotPhase
from services.robot.hold import ANOTHER_AUTHORITY
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.unanswered import ANSWERS, STAYS_S
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, Site, authority


@pytest.fixture
def site():
    """A motion that waits to be asked, and whose operator has just lost the authority."""
    held = Site(BY_HAND)
    held.press(Action.EXECUTE, Phase.EXECUTING)
    reason = f"{ANOTHER_AUTHORITY} (nobody holds the authority)"
    held.robot(phase=RobotPhase.HOLD, waiting=True, hold_reason=reason)
    held.step()
    assert held.state.offered >= ANSWERS
    return held


def lose(site):
    site.epoch += 50
    site.sees(authority=authority("", site.epoch), present=False)
    site.step(seconds=0.02)
    assert site.state.phase is Phase.WAITING


def told(site):
    return teaching_state(site.state, site.view, site.settings)


def test_the_buttons_and_the_sentence_stay_while_the_authority_comes_back(site):
    before = told(site)
    lose(site)
    forms = []
    for _ in range(9):
        site.step(seconds=0.02)
        forms.append(told(site))
        site.sees(present=len(forms) > 3)
    assert site.state.phase is Phase.EXECUTING
    assert {(form.light, form.text) for form in forms} == {(Light.HOLD, before.text)}
    assert all({Action(name) for name in form.actions} >= ANSWERS for form in forms)


@pytest.mark.parametrize(("answer", "query"), [(Action.GO_ON, "cmd/resume"), (Action.FINISH, "cmd/finish")])
def test_what_is_pressed_meanwhile_is_done_once_it_is_back(site, answer, query):
    lose(site)
    site.step(answer, seconds=0.02)
    site.sees(present=True)
    site.run_to(Phase.EXECUTING, seconds=0.02)
    site.step(seconds=0.02)
    assert site.names()[-1] == query


def test_what_was_pressed_long_ago_is_not(site):
    lose(site)
    site.step(Action.GO_ON, seconds=0.02)
    site.step(seconds=STAYS_S)
    assert not site.state.offered & ANSWERS
    site.sees(present=True)
    site.run_to(Phase.EXECUTING)
    assert site.stay() == []
    assert site.state.offered >= ANSWERS


def test_a_robot_that_is_not_heard_for_a_moment_takes_no_button_away(site):
    offered = site.state.offered
    site.step(robot=None)
    assert site.state.offered == offered
    site.step(Action.GO_ON, robot=None)
    assert site.names()[-1] == "cmd/resume"


def test_a_motion_that_waits_for_nobody_has_no_buttons_without_the_authority():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.step()
    lose(site)
    assert not site.state.offered
