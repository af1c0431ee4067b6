"""Where the model knows little a person is asked first: to show the motion, or to let the robot try."""

import pytest

from protocol.messages import Mode, Way
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, COLLIDED, MISSED, REACHED, SCRIPTED, Site, lose_authority

EXECUTE = "cmd/execute"


def unknowing(settings=BY_HAND, verdicts=(), **certainty):
    site = Site(settings, verdicts)
    site.certainty = certainty or {"known": 0.2}
    return site


def asked():
    site = unknowing()
    site.press(Action.EXECUTE, Phase.DECIDING)
    site.step()
    return site


def test_what_little_is_known_of_is_not_executed_but_the_operator_asked():
    site = unknowing()
    site.run_to(Phase.DECIDING)
    site.step(Action.EXECUTE)
    site.run_to(Phase.DECIDING)
    assert site.stay(60) == []
    assert EXECUTE not in site.names()
    told = teaching_state(site.state, site.view, BY_HAND)
    assert told.text.startswith("I don't know this place (20 % known): show me")
    assert told.recommended == "refine"
    assert {"execute", "refine"} <= set(told.actions)


def test_an_explicit_press_executes_it_all_the_same_and_is_not_asked_again():
    site = asked()
    for _ in range(2):
        site.step(Action.EXECUTE)
        site.run_to(Phase.EXECUTING)
        assert site.state.mode is Mode.AUTONOMOUS
        site.end(MISSED)
        site.run_to(Phase.DECIDING)
    assert site.names().count(EXECUTE) == 2


def test_to_show_it_nobody_is_asked_twice():
    site = asked()
    site.press(Action.REFINE, Phase.EXECUTING)
    assert site.state.mode is Mode.REFINE


@pytest.mark.parametrize("known", [0.5, 1.0])
def test_what_is_known_is_executed_upon_the_first_press(known):
    site = unknowing(known=known)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert not site.state.warned


def test_of_two_ways_that_are_as_likely_both_are_told():
    site = unknowing(known=0.0, way=Way(1, 2, 0.5))
    site.press(Action.EXECUTE, Phase.DECIDING)
    assert "way 2 of 2, 50 %" in teaching_state(site.state, site.view, BY_HAND).text


def test_a_failure_before_does_not_hide_that_little_is_known():
    site = unknowing()
    site.press(Action.REFINE, Phase.EXECUTING)
    site.end(COLLIDED)
    site.press(Action.EXECUTE, Phase.DECIDING)
    site.run_to(Phase.DECIDING)
    assert "I don't know this place" in teaching_state(site.state, site.view, BY_HAND).text


def test_at_the_next_place_it_is_said_again():
    site = asked()
    site.step(Action.NEXT)
    site.run_to(Phase.DECIDING)
    assert (site.state.warned, EXECUTE in site.names()) == (True, False)


def test_after_another_model_or_authority_it_is_said_again():
    site = asked()
    site.press(Action.REFINE, Phase.EXECUTING)
    site.end(REACHED)
    site.run_to(Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    assert not site.state.warned
    site.press(Action.EXECUTE, Phase.DECIDING)
    assert site.state.warned
    site.step(Action.UNDO)
    site.run_to(Phase.DECIDING)
    assert not site.state.warned
    site.press(Action.EXECUTE, Phase.DECIDING)
    lose_authority(site)
    site.run_to(Phase.DECIDING)
    assert not site.state.warned


def test_a_script_is_there_to_see_it_tried():
    site = unknowing(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    assert [attempt.mode for attempt in site.state.attempts] == [Mode.AUTONOMOUS, Mode.REFINE, Mode.AUTONOMOUS]
