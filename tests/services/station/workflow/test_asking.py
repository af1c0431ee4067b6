"""Asked twice, done once: what a request's number says, and that an answer counts once, where it belongs."""

from dataclasses import replace

import pytest

from protocol import queries
from services.bus.bus import Failed
from services.station.workflow.action import Action
from services.station.workflow.asking import RETRY_S
from services.station.workflow.state import Phase
from services.station.workflow.view import Answer
from tests.services.station.workflow.site import BY_HAND, COLLIDED, REACHED, UNANSWERED, Site, lose_authority

ON_THE_WAY = [queries.ACQUIRE, queries.RESET, queries.EXECUTE, queries.ADD_DEMONSTRATION]


def taught(query, outcome):
    """A run in which one question goes wrong once."""
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.fail(query, outcome)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    return site


@pytest.mark.parametrize("query", ON_THE_WAY)
def test_what_was_not_answered_is_asked_again_with_the_same_number(query):
    first, second, *_ = taught(query, Failed("nobody answers")).requests(query)
    assert first.request == second.request != 0


@pytest.mark.parametrize("query", [queries.ACQUIRE, queries.RESET, queries.EXECUTE])
def test_what_was_refused_is_asked_again_with_another_number(query):
    first, second, *_ = taught(query, queries.Refused("not now")).requests(query)
    assert 0 != first.request != second.request != 0


def test_every_intent_has_a_number_of_its_own():
    site = taught(queries.FINISH, None)
    numbers = [ask.request.request for ask in site.asked if isinstance(ask.request, queries.Change)]
    assert len(set(numbers)) == len(numbers)
    assert 0 not in numbers


def test_a_failure_is_shown_and_the_question_repeated_only_after_a_moment():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.PREDICTING)
    site.fail(queries.PREDICT)
    site.step()
    site.step()
    assert "nobody answers" in site.state.notice
    asked = len(site.asked)
    failed_s = site.now_s
    site.step(now_s=failed_s + 0.9 * RETRY_S)
    assert len(site.asked) == asked
    site.step(now_s=failed_s + 1.1 * RETRY_S)
    assert len(site.asked) == asked + 1
    site.run_to(Phase.EXECUTING)


def test_an_answer_to_another_question_is_not_taken():
    site = Site(BY_HAND)
    site.instead[queries.ACQUIRE.name] = UNANSWERED
    site.run_to(Phase.ACQUIRING)
    site.step()
    site.step(answer=Answer(site.state.question + 100, queries.AuthorityGranted(99, 1.0)))
    assert site.state.phase is Phase.ACQUIRING
    site.stay(answer=None)
    assert site.state.phase is Phase.ACQUIRING
    site.sees(answer=Answer(site.state.question, queries.AuthorityGranted(99, 1.0)))
    site.run_to(Phase.LOOKING)
    assert site.state.epoch == 99


def test_an_answer_that_stays_in_view_counts_once():
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    site.stay(20)
    assert site.state.updates == 1


def test_an_answer_of_a_state_that_was_left_is_nobodys():
    """The authority is lost while the reset is under way; its answer must not count as that of the next question."""
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.RESETTING)
    site.instead[queries.RESET.name] = UNANSWERED
    site.step()
    late = Answer(site.state.question, queries.Accepted())
    lose_authority(site)
    site.sees(answer=late)
    site.run_to(Phase.DECIDING)
    assert site.state.held_epoch == site.epoch


@pytest.mark.parametrize(
    ("query", "phase"), [(queries.ADD_DEMONSTRATION, Phase.LEARNING), (queries.UNDO, Phase.TURNING)]
)
def test_what_the_model_was_asked_is_asked_again_with_the_same_number_after_the_authority_was_lost(query, phase):
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    if phase is Phase.TURNING:
        site.press(Action.UNDO, phase)
    site.instead[query.name] = UNANSWERED
    site.step()
    lose_authority(site)
    site.run_to(phase)
    site.run_to(Phase.DECIDING)
    first, second = site.requests(query)
    assert first == second
    assert site.state.updates == (1 if phase is Phase.LEARNING else 0)
    site.stay()
    assert len(site.requests(query)) == 2


def test_a_lesson_that_is_refused_is_told_and_can_be_taught_again_as_another_request():
    site = taught(queries.ADD_DEMONSTRATION, queries.Refused("the disk is full"))
    assert "the disk is full" in site.state.event
    site.step()
    assert Action.TEACH in site.state.offered
    assert site.state.updates == 0
    site.step(Action.TEACH)
    site.run_to(Phase.DECIDING)
    first, second = site.requests(queries.ADD_DEMONSTRATION)
    assert first.request != second.request
    assert site.state.updates == 1


def test_a_script_ends_by_a_lesson_that_is_refused():
    site = Site(replace(BY_HAND, scripted=True), [COLLIDED, REACHED])
    site.fail(queries.ADD_DEMONSTRATION, queries.Refused("the disk is full"))
    site.run_to(Phase.FINISHED)
    assert "the disk is full" in site.state.reason
