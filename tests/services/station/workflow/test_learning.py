"""What the model is told: after its answer, whatever it is, the operator is asked and nothing moves."""

from dataclasses import replace

import pytest

from protocol import queries
from services.bus.arrays import motion_to_wire
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, COLLIDED, REACHED, Site


def taught():
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    return site


@pytest.mark.parametrize("outcome", [None, queries.Refused("the disk is full")], ids=["learnt", "refused"])
def test_after_a_lesson_the_robot_stands_and_the_operator_is_asked(outcome):
    site = taught()
    if outcome is not None:
        site.fail(queries.ADD_DEMONSTRATION, outcome)
    asked = len(site.asked)
    while site.state.phase is Phase.LEARNING:
        site.step()
    assert site.state.phase is Phase.DECIDING
    site.stay()
    assert site.names()[asked:] == ["model/add_demonstration"]
    assert site.state.owed is None


def test_where_there_is_nothing_to_teach_the_operator_is_asked():
    site = taught()
    site.state = replace(site.state, taught=None)
    site.step()
    assert site.state.phase is Phase.DECIDING
    assert "model/add_demonstration" not in site.names()


def test_an_orientation_that_the_arm_could_not_hold_is_learnt_as_it_was_asked_for():
    refined = motion_to_wire([[0.5, 0.0, 0.5], [0.9, 0.0, 0.6]], [[1.0, 0.0, 0.0, 0.0]] * 2, 7.0)
    turned = [[1.0, 0.0, 0.0, 0.0], [0.96, 0.0, 0.0, 0.28]]
    commanded = motion_to_wire([[0.5, 0.0, 0.5], [0.8, 0.0, 0.6]], turned, 7.0)
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.end(REACHED, refined=refined, commanded=commanded)
    site.run_to(Phase.LEARNING)
    site.step()
    (request,) = site.requests(queries.ADD_DEMONSTRATION)
    assert (request.motion.positions, request.motion.orientations) == (commanded.positions, refined.orientations)


def test_what_is_taught_is_believed_as_far_as_the_operator_said_from_then_on():
    """Whenever it is said, while the motion runs too, and at the next object as well."""
    site = Site(replace(BY_HAND, alpha=0.9), [COLLIDED, REACHED])
    site.run_to(Phase.DECIDING)
    assert _told(site).confidence == 0.9
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.step(Action.CONFIDENCE, argument="0.35")
    site.run_to(Phase.DECIDING)
    site.verdicts = [COLLIDED, REACHED]
    site.press(Action.NEXT, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    assert [request.alpha for request in site.requests(queries.ADD_DEMONSTRATION)] == [0.35, 0.35]
    assert _told(site).confidence == 0.35


@pytest.mark.parametrize(("said", "meant"), [("-1", 0.0), ("7", 1.0), ("nan", 0.9), ("", 0.9), ("sure", 0.9)])
def test_a_confidence_that_is_no_share_is_the_nearest_one_or_none(said, meant):
    site = Site(replace(BY_HAND, alpha=0.9))
    site.run_to(Phase.DECIDING)
    site.step(Action.CONFIDENCE, argument=said)
    assert _told(site).confidence == meant


def _told(site):
    return teaching_state(site.state, site.view, site.settings)
