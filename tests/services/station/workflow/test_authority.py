"""The authority: asked for once, never taken from anybody or back by itself; what is lost leaves the robot standing."""

from dataclasses import replace

import pytest

from protocol import messages, queries
from services.bus.bus import Failed
from services.station.workflow.action import Action
from services.station.workflow.authority import TOLD_S
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import (
    BY_HAND,
    COLLIDED,
    EXECUTE,
    HOLD,
    IDLE,
    REACHED,
    SCRIPTED,
    STOPPED,
    Site,
    authority,
    lose_authority,
)


def text(site):
    return teaching_state(site.state, replace(site.view, now_s=site.now_s), site.settings).told


@pytest.mark.parametrize(
    ("lost", "word"),
    [("robot", "robot"), ("scene", "robot"), ("authority", "robot"), ("model", "model")],
)
def test_it_waits_for_who_is_missing_and_says_so(lost, word):
    site = Site(SCRIPTED)
    site.sees(**{lost: None})
    assert site.stay() == []
    assert site.state.phase is Phase.WAITING
    assert f"Waiting for the {word}" in text(site)


def test_it_waits_for_the_first_demonstrations():
    site = Site(SCRIPTED)
    empty = messages.ModelState(kind="adaptive", version=0, demonstrations=0, updates=0, scene="")
    site.sees(model=empty)
    assert site.stay() == []
    assert "first demonstrations" in text(site)


def test_without_an_operator_the_authority_is_not_even_asked_for():
    site = Site(BY_HAND)
    site.sees(present=False)
    assert site.stay(60) == []
    assert "operator" in text(site)
    site.sees(present=True)
    site.run_to(Phase.DECIDING)
    assert site.names() == ["authority/acquire"]


def test_the_authority_is_asked_for_in_the_operators_name():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    (asked,) = site.requests(queries.ACQUIRE)
    assert (asked.holder, asked.operator, asked.take_over) == ("station", "ann", False)
    assert site.state.held_epoch == site.epoch


def test_a_lost_authority_is_asked_for_again_and_nothing_moves():
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    asked = len(site.asked)
    lose_authority(site)
    assert site.state.held_epoch == 0
    site.run_to(Phase.DECIDING)
    site.stay()
    assert site.names()[asked:] == ["authority/acquire"]
    assert site.state.held_epoch == site.epoch
    assert site.state.event == "The authority was lost, and is back."


def test_that_the_authority_is_back_is_no_news_after_a_while_nor_during_a_stop():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    for later in ({"seconds": round(TOLD_S)}, {"seconds": 1, "safety": STOPPED}):
        lose_authority(site)
        site.run_to(Phase.DECIDING)
        assert site.state.event == "The authority was lost, and is back."
        site.stay(**later)
        assert site.state.event == ""


@pytest.mark.parametrize(("holder", "later"), [("", 0), ("station", 1)], ids=["nobody holds it", "a later lease"])
def test_the_authority_is_lost_where_nobody_holds_it_or_under_another_epoch(holder, later):
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.step(authority=authority(holder, site.epoch + later))
    assert site.state.held_epoch == 0
    assert "authority was lost" in site.state.event


@pytest.mark.parametrize("phase", [Phase.RESETTING, Phase.LOOKING, Phase.PREDICTING, Phase.STARTING])
def test_what_was_asked_before_the_authority_was_lost_waits_for_another_press(phase):
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, phase)
    asked = len(site.asked)
    lose_authority(site)
    site.run_to(Phase.DECIDING)
    site.stay()
    assert site.names()[asked:] == ["authority/acquire"]


@pytest.mark.parametrize("phase", [Phase.RESETTING, Phase.LOOKING, Phase.PREDICTING, Phase.STARTING])
def test_what_was_asked_before_the_robot_fell_silent_waits_for_another_press(phase):
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, phase)
    site.sees(answer=None)
    site.step(robot=None, seen=None)
    assert site.state.pressed
    site.sees(answer=None)
    site.step(robot=None, seen=None)
    assert site.state.phase is Phase.DECIDING
    assert not site.state.pressed
    assert site.stay() == []
    assert "not heard" in site.state.event


def test_a_robot_that_is_silent_for_a_moment_is_waited_for():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.RESETTING)
    site.step(robot=None)
    site.run_to(Phase.EXECUTING)


def test_a_held_episode_is_offered_to_go_on_once_the_authority_is_back():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.step()
    asked = len(site.asked)
    site.robot(phase=HOLD, waiting=True)
    lose_authority(site)
    site.run_to(Phase.EXECUTING)
    site.stay()
    assert site.names()[asked:] == ["authority/acquire"]
    assert site.state.offered == {Action.GO_ON, Action.FINISH}
    assert "authority" in site.state.event
    site.step(Action.GO_ON)
    assert site.state.event == "", "what has happened is said until the next press"
    assert site.requests(queries.RESUME)[-1].epoch == site.epoch


def test_an_episode_that_was_never_told_to_run_is_not_waited_for():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.STARTING)
    site.fail(queries.EXECUTE)
    site.step()
    lose_authority(site)
    site.run_to(Phase.DECIDING)
    assert site.stay() == []


def test_an_episode_whose_start_was_not_acknowledged_goes_on_upon_a_press():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.STARTING)
    site.fail(queries.EXECUTE)
    site.step()
    site.robot(phase=HOLD, waiting=True, episode=4)
    lose_authority(site)
    site.run_to(Phase.EXECUTING)
    assert site.state.episode.number == 4


def test_an_episode_whose_number_is_not_known_yet_is_known_by_its_running():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.STARTING)
    site.fail(queries.EXECUTE)
    site.step()
    site.robot(phase=HOLD, waiting=True, episode=4)
    lose_authority(site)
    site.run_to(Phase.ACQUIRING)
    site.step()
    site.step(robot=None)
    site.stay(2)
    assert site.state.phase is Phase.EXECUTING


def test_a_robot_that_was_restarted_stands_until_the_operator_presses():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    asked = len(site.asked)
    site.robot(publisher=2, phase=IDLE, episode=0)
    lose_authority(site)
    site.run_to(Phase.LOOKING)
    site.run_to(Phase.DECIDING)
    site.stay()
    assert site.names()[asked:] == ["authority/acquire"]


def test_after_a_robot_s_restart_nothing_is_said_of_the_attempt_before():
    site = Site(BY_HAND, [REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    assert site.state.last == REACHED
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.robot(publisher=2, phase=IDLE, episode=0)
    lose_authority(site)
    site.run_to(Phase.LOOKING)
    site.run_to(Phase.DECIDING)
    assert site.state.last is None
    assert "restarted" in site.state.event


def test_a_loss_that_passes_wipes_no_news():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.state = replace(site.state, event="It has learnt.")
    for _ in range(2):
        lose_authority(site)
        site.step()
        assert site.state.event == "The authority was lost. It has learnt."
        site.run_to(Phase.DECIDING)
        assert site.state.event == "The authority was lost, and is back. It has learnt."
    site.step(seconds=TOLD_S + 1.0)
    assert site.state.event == "It has learnt."


def test_a_first_question_that_is_refused_is_asked_again_in_a_moment():
    site = Site(BY_HAND)
    site.fail(queries.ACQUIRE, queries.Refused("not yet"))
    site.run_to(Phase.DECIDING)
    first, second = site.requests(queries.ACQUIRE)
    assert first.request != second.request


def test_while_the_robot_does_not_answer_taking_over_can_be_asked_for():
    site = Site(BY_HAND)
    site.fail(queries.ACQUIRE, Failed("nobody answers"))
    site.run_to(Phase.ACQUIRING)
    site.step()
    assert site.state.offered == {Action.TAKE_OVER}
    site.step(Action.TAKE_OVER)
    assert site.requests(queries.ACQUIRE)[-1].take_over


def test_what_the_robot_said_before_it_granted_the_authority_does_not_count():
    site = Site(BY_HAND)
    before = site.view.authority
    site.run_to(Phase.LOOKING)
    site.step(authority=before)
    assert site.state.held_epoch == site.epoch


def test_a_lower_epoch_than_the_granted_one_is_said_and_the_authority_asked_for_anew():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.step()
    site.epoch = 2
    site.sees(authority=authority("", 2))
    site.step()
    assert "forgotten the authority" in site.state.event
    site.run_to(Phase.DECIDING)
    assert site.state.held_epoch == 3


def test_once_the_robot_has_confirmed_the_grant_a_lower_epoch_counts_at_once():
    site = Site(BY_HAND)
    site.run_to(Phase.LOOKING)
    site.step(seconds=0.1)
    site.step(seconds=0.1, authority=authority("", 2))
    assert site.state.held_epoch == 0


def test_a_lower_epoch_that_stays_after_the_grant_counts_too():
    site = Site(BY_HAND)
    before = site.view.authority
    site.run_to(Phase.LOOKING)
    for _ in range(2):
        site.step(authority=before)
    assert site.state.held_epoch == site.epoch
    site.step(authority=before)
    assert site.state.held_epoch == 0


def test_a_robot_that_is_not_heard_has_not_lost_anything():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.robot(phase=EXECUTE)
    site.stay(authority=None, robot=None)
    assert site.state.phase is Phase.EXECUTING
    assert site.state.held_epoch == site.epoch
