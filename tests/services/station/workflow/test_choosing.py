"""Another skill is chosen or made by a press: what was known of the one before is forgotten, and nothing moves."""

import pytest

from protocol import queries
from services.station.workflow.action import Action
from services.station.workflow.approach import Approach
from services.station.workflow.state import Phase
from tests.services.station.workflow.site import BY_HAND, COLLIDED, REACHED, Site, lose_authority


@pytest.fixture
def site():
    """A correction was learnt here, and another one can be taught."""
    site = Site(BY_HAND, [COLLIDED, REACHED, COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    return site


def _chosen(site, action, name):
    """The request that a press led to."""
    site.step(action, argument=name)
    site.run_to(Phase.DECIDING)
    assert site.stay() == []
    return site.asked[-1]


@pytest.mark.parametrize("action", [Action.SKILL, Action.NEW_SKILL])
def test_a_press_has_the_model_use_or_make_the_skill_by_its_name_in_the_operators(site, action):
    asked = _chosen(site, action, "cups")
    assert asked.query is queries.CHOOSE_SKILL
    request = asked.request
    assert (request.name, request.new, request.operator) == ("cups", action is Action.NEW_SKILL, "ann")
    assert request.request
    assert site.state.event.startswith("Skill cups is in use")


def test_nothing_that_was_predicted_shown_or_counted_before_is_of_the_new_one(site):
    looked = site.state.looked
    _chosen(site, Action.SKILL, "cups")
    state = site.state
    assert (state.prediction, state.taught, state.last, state.learnt, state.refinements) == (None, None, None, (), 0)
    assert (state.approach, state.closure.closed) == (Approach(state.approach.method), False)
    assert state.looked == looked


def test_a_new_skill_is_shown_its_first_motion(site):
    _chosen(site, Action.NEW_SKILL, "cups")
    site.step()
    assert site.state.empty
    assert Action.EXECUTE not in site.state.offered
    assert Action.LEAD in site.state.offered


def test_what_the_model_refuses_is_said_and_all_stays(site):
    before = site.state
    site.fail(queries.CHOOSE_SKILL, queries.Refused("it is for another robot"))
    _chosen(site, Action.SKILL, "cups")
    assert "it is for another robot" in site.state.event
    kept = ("prediction", "taught", "last", "learnt", "refinements", "approach")
    assert all(getattr(site.state, name) == getattr(before, name) for name in kept)


def test_it_is_asked_for_again_with_the_same_number_after_the_authority_was_lost(site):
    site.step(Action.NEW_SKILL, argument="cups")
    site.fail(queries.CHOOSE_SKILL)
    site.step()
    lose_authority(site)
    site.run_to(Phase.CHOOSING)
    site.run_to(Phase.DECIDING)
    first, second = site.requests(queries.CHOOSE_SKILL)
    assert first == second


@pytest.mark.parametrize("name", ["", "x" * 65])
def test_a_press_that_names_none_asks_for_none(site, name):
    before = len(site.asked)
    site.step(Action.SKILL, argument=name)
    assert site.stay() == []
    assert len(site.asked) == before


def test_while_a_motion_is_under_way_none_is_chosen(site):
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert not {Action.SKILL, Action.NEW_SKILL} & site.state.offered


def test_what_was_shown_is_learnt_by_the_skill_that_predicted_it(site):
    (given,) = site.requests(queries.ADD_DEMONSTRATION)
    assert given.skill == site.state.prediction.skill
