"""What the model is told: after its answer, whatever it is, the operator is asked and nothing moves."""

from dataclasses import replace

import pytest

from protocol import queries
from services.bus.arrays import motion_to_wire
from services.station.workflow.state import Action, Phase
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


@pytest.mark.parametrize("outcome", [None, queries.Refused("there is none")], ids=["undone", "refused"])
def test_after_an_undo_the_robot_stands_and_the_operator_is_asked(outcome):
    site = taught()
    site.run_to(Phase.DECIDING)
    if outcome is not None:
        site.fail(queries.UNDO, outcome)
    site.step(Action.UNDO)
    asked = len(site.asked)
    while site.state.phase is Phase.UNDOING:
        site.step()
    assert site.state.phase is Phase.DECIDING
    site.stay()
    assert site.names()[asked:] == ["model/undo"]
    assert site.state.owed is None
    assert ("was taken back" if outcome is None else "there is none") in site.state.event


def test_after_an_undo_what_was_reached_before_says_nothing():
    site = taught()
    site.run_to(Phase.DECIDING)
    site.verdicts = [REACHED]
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    assert site.state.last == REACHED
    site.step(Action.UNDO)
    site.run_to(Phase.DECIDING)
    assert site.state.last is None


def test_an_undo_takes_one_update_back():
    site = taught()
    site.verdicts = [REACHED]
    site.press(Action.REFINE, Phase.LEARNING)
    site.press(Action.UNDO, Phase.DECIDING)
    assert site.state.updates == 1


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
