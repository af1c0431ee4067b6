"""Under the emergency stop: nothing but its release, by whomever; and then the operator is asked."""

import pytest

from protocol import queries
from protocol.messages import Cut, SafetyState
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.site import (
    BY_HAND,
    COLLIDED,
    MISSED,
    REACHED,
    RELEASED,
    SCRIPTED,
    STOPPED,
    UNANSWERED,
    Site,
)


def stop(site):
    """A latched stop ends the robot's episode at once, and its result is told."""
    site.sees(safety=STOPPED)
    if site.view.robot.phase.running and site.state.episode is not None:
        site.end(MISSED, completed=False, reason="emergency stop by bob")
    site.step()
    site.step()


def executing():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    return site


def test_the_emergency_stop_offers_nothing_but_its_release():
    site = executing()
    stop(site)
    assert site.state.offered == {Action.RELEASE_STOP}
    assert site.state.phase is Phase.STOPPED
    site.step(Action.EXECUTE, Action.FINISH, Action.GO_ON, Action.END)
    assert site.state.phase is Phase.STOPPED


def test_a_stop_that_was_pressed_here_counts_before_it_is_confirmed():
    site = executing()
    site.sees(stopping=True)
    site.step()
    site.step(Action.RELEASE_STOP)
    assert site.state.phase is Phase.STOPPED
    assert site.state.offered == frozenset()


def test_after_its_release_nothing_moves_until_the_operator_says_so():
    site = executing()
    asked = len(site.asked)
    stop(site)
    site.step(Action.RELEASE_STOP)
    site.run_to(Phase.DECIDING)
    site.stay()
    assert site.names()[asked:] == ["safety/release_stop", "authority/acquire"]
    assert site.requests(queries.RELEASE_STOP)[0].by == "ann"
    assert "by eve." in site.state.event


@pytest.mark.parametrize("phase", [Phase.RESETTING, Phase.LOOKING, Phase.STARTING, Phase.EXECUTING, Phase.DECIDING])
def test_after_a_release_from_elsewhere_nothing_moves_either(phase):
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, phase) if phase is not Phase.DECIDING else site.run_to(phase)
    stop(site)
    asked = len(site.asked)
    site.sees(safety=RELEASED)
    site.run_to(Phase.DECIDING)
    site.stay()
    assert site.names()[asked:] == ["authority/acquire"]
    assert "by eve." in site.state.event


def test_releasing_ends_when_somebody_else_has_released():
    site = executing()
    stop(site)
    site.instead[queries.RELEASE_STOP.name] = UNANSWERED
    site.step(Action.RELEASE_STOP)
    site.step()
    site.sees(safety=RELEASED)
    site.step()
    assert site.state.phase is Phase.WAITING


def test_a_release_that_was_not_answered_waits_for_another_press():
    """Repeated for long it could release another stop than the one that it was pressed for."""
    site = executing()
    stop(site)
    site.fail(queries.RELEASE_STOP)
    site.step(Action.RELEASE_STOP)
    site.run_to(Phase.STOPPED)
    assert "nobody answers" in site.state.notice
    assert site.stay() == []


def test_a_release_that_is_refused_is_told():
    site = executing()
    stop(site)
    site.fail(queries.RELEASE_STOP, queries.Refused("the arm still moves"))
    site.step(Action.RELEASE_STOP)
    site.run_to(Phase.STOPPED)
    assert "the arm still moves" in site.state.notice


def test_a_stop_that_was_released_and_pressed_again_can_be_released_again():
    site = executing()
    stop(site)
    site.fail(queries.RELEASE_STOP, queries.Accepted())
    site.step(Action.RELEASE_STOP)
    site.stay(3)
    site.step()
    assert site.state.phase is Phase.STOPPED
    assert site.state.offered == {Action.RELEASE_STOP}


def test_an_accepted_release_shows_within_two_seconds_or_the_robot_was_stopped_again():
    site = executing()
    stop(site)
    site.fail(queries.RELEASE_STOP, queries.Accepted())
    site.step(Action.RELEASE_STOP)
    site.stay(2)
    assert site.state.phase is Phase.RELEASING
    site.step()
    assert site.state.phase is Phase.STOPPED


def test_a_release_that_is_under_way_is_waited_for_and_not_repeated():
    site = executing()
    stop(site)
    site.instead[queries.RELEASE_STOP.name] = UNANSWERED
    site.step(Action.RELEASE_STOP)
    assert site.stay(10) == ["safety/release_stop"]
    assert site.state.phase is Phase.RELEASING


@pytest.mark.parametrize(
    ("released", "text"),
    [({"released_by": "eve"}, "by eve."), ({"at": "10:05"}, "by somebody."), ({}, "by somebody.")],
)
def test_of_a_release_what_is_known_is_told(released, text):
    site = executing()
    stop(site)
    site.step(safety=SafetyState(emergency_stop=False, standing=True, **released))
    assert site.state.event == f"The emergency stop was released {text}"


def test_after_a_release_the_authority_of_before_is_not_held_any_more():
    site = executing()
    stop(site)
    site.step(safety=RELEASED)
    assert site.state.phase is Phase.WAITING
    assert site.state.held_epoch == 0


def test_a_stop_that_is_pressed_while_it_is_released_stands():
    site = executing()
    stop(site)
    site.instead[queries.RELEASE_STOP.name] = UNANSWERED
    site.step(Action.RELEASE_STOP)
    site.sees(stopping=True)
    site.step()
    assert site.state.phase is Phase.STOPPED


@pytest.mark.parametrize("phase", [Phase.ACQUIRING, Phase.WAITING])
def test_a_stop_while_it_asks_for_the_authority_hangs_nothing(phase):
    """The answer comes while the stop is latched, and is nobody's then."""
    site = Site(BY_HAND)
    site.run_to(phase)
    site.step()
    stop(site)
    site.sees(safety=RELEASED)
    site.run_to(Phase.DECIDING)


def test_a_script_never_releases_a_stop_and_ends_with_the_reason():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    stop(site)
    assert site.state.phase is Phase.FINISHED
    assert "bob" in site.state.reason
    assert "'retouch stop --release'" in site.state.reason
    assert "safety/release_stop" not in site.names()


def test_what_a_stop_cut_short_is_not_learnt_though_it_had_reached():
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.sees(safety=STOPPED)
    site.end(REACHED, completed=False, reason="emergency stop by bob")
    site.stay()
    assert site.state.attempts[-1].verdict == REACHED
    site.sees(safety=RELEASED)
    site.run_to(Phase.DECIDING)
    site.step()
    assert Action.TEACH not in site.state.offered
    assert "model/add_demonstration" not in site.names()


def test_a_result_that_completed_just_before_the_stop_is_not_learnt_either():
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.end(REACHED)
    site.step(safety=STOPPED)
    assert (site.state.taught, site.state.owed) == (None, None)


def test_a_finished_refinement_that_could_still_be_taught_is_dropped_by_a_stop():
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.step(Action.FINISH)
    site.end(REACHED, completed=False, reason="finished by ann at 80%", cut=Cut.FINISHED)
    site.run_to(Phase.DECIDING)
    stop(site)
    assert site.state.taught is None


def test_a_result_that_is_heard_under_the_stop_counts_as_an_attempt():
    site = executing()
    site.step(safety=STOPPED)
    site.sees(safety=STOPPED)
    site.end(MISSED, completed=False, reason="emergency stop by bob")
    site.step()
    assert [attempt.verdict for attempt in site.state.attempts] == [MISSED]
    site.stay()
    assert len(site.state.attempts) == 1


def test_what_the_model_was_told_before_the_stop_is_asked_for_again_with_the_same_number():
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.instead[queries.ADD_DEMONSTRATION.name] = UNANSWERED
    site.step()
    stop(site)
    site.sees(safety=RELEASED)
    site.run_to(Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    first, second = site.requests(queries.ADD_DEMONSTRATION)
    assert first == second
    assert site.state.updates == 1


def test_a_stop_after_the_end_of_a_run_can_be_released_where_it_was_pressed():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.step(Action.END)
    stop(site)
    assert (site.state.phase, site.state.offered) == (Phase.STOPPED, {Action.RELEASE_STOP})
    site.step(Action.RELEASE_STOP)
    site.run_to(Phase.DECIDING)
    assert "safety/release_stop" in site.names()
