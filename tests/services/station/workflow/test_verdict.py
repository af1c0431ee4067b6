"""What is learnt of a refinement: all of a success that completed, and nothing else unless the operator says so.

Of what failed or was stopped: see `test_parts`.
"""

from dataclasses import replace

import msgspec
import pytest

from protocol import queries
from protocol.messages import Cut, Mode
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.verdict import ATTEMPTS_KEPT
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, COLLIDED, MISSED, REACHED, SCRIPTED, Site, lose_authority

FINISHED = {"completed": False, "reason": "finished by ann at 80%", "cut": Cut.FINISHED}
LEARN = "model/add_demonstration"


def refining():
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.EXECUTING)
    return site


def ended(site, outcome, **changes):
    site.end(outcome, **changes)
    site.run_to(Phase.DECIDING)
    site.step()
    return site


def test_a_refinement_that_completed_and_succeeded_is_learnt():
    site = ended(refining(), REACHED)
    assert site.names().count(LEARN) == 1
    assert site.state.updates == 1


@pytest.mark.parametrize("outcome", [MISSED, COLLIDED])
def test_a_refinement_that_failed_is_neither_learnt_nor_offered(outcome):
    site = ended(refining(), outcome)
    assert LEARN not in site.names()
    assert Action.TEACH not in site.state.offered


def test_a_success_that_the_operator_finished_early_is_learnt_only_upon_a_press():
    site = refining()
    site.step(Action.FINISH)
    ended(site, REACHED, **FINISHED)
    assert site.stay(60) == []
    assert LEARN not in site.names()
    assert Action.TEACH in site.state.offered
    site.step(Action.TEACH)
    site.run_to(Phase.DECIDING)
    assert site.names().count(LEARN) == 1
    assert site.state.updates == 1


def test_a_success_that_was_offered_and_not_taught_is_dropped_by_the_next_episode():
    site = refining()
    site.step(Action.FINISH)
    ended(site, REACHED, **FINISHED)
    site.step(Action.EXECUTE)
    assert site.state.taught is None
    site.run_to(Phase.EXECUTING)
    ended(site, MISSED)
    assert Action.TEACH not in site.state.offered
    assert LEARN not in site.names()


def test_a_success_that_was_offered_and_not_taught_is_dropped_by_an_undo():
    site = ended(refining(), REACHED)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.step(Action.FINISH)
    ended(site, REACHED, **FINISHED)
    site.step(Action.UNDO)
    site.run_to(Phase.DECIDING)
    site.step()
    assert Action.TEACH not in site.state.offered


def test_a_script_teaches_a_success_whose_result_came_while_the_authority_was_lost():
    site = Site(SCRIPTED, [COLLIDED])
    site.run_to(Phase.LOOKING)
    while site.state.mode is not Mode.REFINE or site.state.phase is not Phase.EXECUTING:
        site.step()
    lose_authority(site)
    site.end(REACHED)
    site.run_to(Phase.LEARNING)
    site.run_to(Phase.RESETTING)
    assert site.names().count(LEARN) == 1


@pytest.mark.parametrize("finishing", [False, True])
def test_a_success_that_another_station_cut_short_is_neither_learnt_nor_offered(finishing):
    site = refining()
    if finishing:
        site.step(Action.FINISH)
    reason = "bob took the authority over from ann"
    ended(site, REACHED, completed=False, cut=Cut.TAKEN_OVER, reason=reason)
    assert LEARN not in site.names()
    assert Action.TEACH not in site.state.offered
    assert reason in site.state.event


def test_what_another_station_finished_is_not_this_operators_word():
    site = ended(refining(), REACHED, **FINISHED)
    assert Action.TEACH not in site.state.offered


def test_an_autonomous_success_is_nothing_to_learn():
    site = Site(BY_HAND, [REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    site.step()
    assert Action.TEACH not in site.state.offered
    assert site.state.last == REACHED


def test_an_attempt_says_what_was_tried_and_what_came_of_it():
    site = ended(refining(), MISSED, duration=21.5)
    first, second = site.state.attempts
    assert (first.number, second.number) == (1, 2)
    assert (first.mode, second.mode) == (Mode.AUTONOMOUS, Mode.REFINE)
    assert (second.scene, second.variant, second.object_position) == ("dishwasher", "b2", (0.85, 0.05, 0.5))
    assert (second.model_version, second.operator_input, second.duration_s) == (2, True, 21.5)
    assert second.verdict == MISSED


def test_a_days_attempts_keep_state_and_message_small_and_their_numbers():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.end(MISSED)
    site.run_to(Phase.DECIDING)
    one = site.state.attempts[0]
    many = tuple(msgspec.structs.replace(one, number=number) for number in range(9_901, 10_001))
    site.state = replace(site.state, attempts=many)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.end(MISSED)
    site.run_to(Phase.DECIDING)
    assert len(site.state.attempts) == ATTEMPTS_KEPT
    assert site.state.attempts[-1].number == 10_001
    told = teaching_state(site.state, site.view, BY_HAND)
    assert len(msgspec.msgpack.encode(told)) < 65_536
    assert site.requests(queries.ADD_DEMONSTRATION) == []
