"""Entries of the model's history are taken back and used again: the operator is asked then, and nothing moves."""

import pytest

from protocol import queries
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.site import BY_HAND, COLLIDED, REACHED, Site, lose_authority


@pytest.fixture
def site():
    """Two corrections were learnt here, which are the entries 3 and 4."""
    site = Site(BY_HAND, [COLLIDED, REACHED, REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    assert site.state.learnt == (3, 4)
    return site


def _turned(site, action, argument=""):
    """The request that a press led to."""
    site.step(action, argument=argument)
    site.run_to(Phase.DECIDING)
    assert site.stay() == []
    return site.asked[-1]


@pytest.mark.parametrize(("action", "argument", "entry"), [(Action.UNDO, "", 4), (Action.TAKE_BACK, "3", 3)])
def test_the_newest_or_any_entry_is_taken_back(site, action, argument, entry):
    asked = _turned(site, action, argument)
    assert asked.query is queries.UNDO
    assert (asked.request.entry, asked.request.operator) == (int(argument or 0), "ann")
    assert site.state.event == f"Correction {entry} was taken back."
    assert site.state.learnt == tuple(one for one in (3, 4) if one != entry)


def test_what_was_taken_back_is_used_again(site):
    _turned(site, Action.TAKE_BACK, "3")
    asked = _turned(site, Action.USE_AGAIN, "3")
    assert (asked.query, asked.request.entry, asked.request.operator) == (queries.REDO, 3, "ann")
    assert site.state.event == "Correction 3 is used again."


def test_an_entry_of_another_place_counts_for_no_update_of_this_one(site):
    site.learnt.insert(0, 1)
    _turned(site, Action.TAKE_BACK, "1")
    assert site.state.learnt == (3, 4)


def test_the_history_outlives_the_place_where_it_was_taught(site):
    site.press(Action.NEXT, Phase.EXECUTING)
    site.end(REACHED)
    site.run_to(Phase.DECIDING)
    site.step()
    assert {Action.UNDO, Action.TAKE_BACK, Action.USE_AGAIN} <= site.state.offered
    assert _turned(site, Action.TAKE_BACK, "4").request.entry == 4


@pytest.mark.parametrize("argument", ["", "-3", "three", "\N{SUPERSCRIPT THREE}"])
def test_a_press_that_names_no_entry_changes_nothing(site, argument):
    before = len(site.asked)
    site.step(Action.TAKE_BACK, argument=argument)
    assert site.stay() == []
    assert len(site.asked) == before


@pytest.mark.parametrize("action", [Action.UNDO, Action.TAKE_BACK])
def test_what_the_model_refuses_is_said_and_the_operator_asked(site, action):
    site.fail(queries.UNDO, queries.Refused("there is none"))
    asked = len(site.asked)
    _turned(site, action, "3")
    assert site.names()[asked:] == ["model/undo"]
    assert "there is none" in site.state.event
    assert (site.state.learnt, site.state.owed) == ((3, 4), None)


def test_what_was_reached_before_says_nothing_afterwards(site):
    site.verdicts = [REACHED]
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    assert site.state.last == REACHED
    _turned(site, Action.UNDO)
    assert site.state.last is None


def test_an_entry_is_asked_for_again_with_the_same_number_after_the_authority_was_lost(site):
    site.step(Action.TAKE_BACK, argument="3")
    site.fail(queries.UNDO)
    site.step()
    lose_authority(site)
    site.run_to(Phase.TURNING)
    site.run_to(Phase.DECIDING)
    first, second = site.requests(queries.UNDO)
    assert first == second
    assert first.entry == 3


def test_nothing_is_offered_of_a_history_that_is_empty():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.sees(model=None)
    site.step()
    assert not {Action.UNDO, Action.TAKE_BACK, Action.USE_AGAIN} & site.state.offered
