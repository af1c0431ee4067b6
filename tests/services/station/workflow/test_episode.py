"""One episode: looked at after the reset, watched until its result, ended or let go on only upon a press."""

import msgspec
import pytest

from protocol import messages, queries
from services.bus.bus import Failed
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from tests.services.station.workflow.site import (
    BY_HAND,
    COLLIDED,
    EXECUTE,
    HOLD,
    IDLE,
    MISSED,
    RAMP,
    REACHED,
    SCRIPTED,
    UNANSWERED,
    Site,
)


def executing(action=Action.EXECUTE):
    site = Site(BY_HAND)
    site.press(action, Phase.EXECUTING)
    return site


def test_after_the_reset_it_looks_until_the_object_is_seen():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.LOOKING)
    site.stay(5, seen=None)
    assert site.state.phase is Phase.LOOKING
    site.run_to(Phase.EXECUTING)


def test_nothing_that_is_seen_counts_while_the_arm_is_on_its_way_to_the_start():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.LOOKING)
    site.robot(phase=messages.Phase.HOMING)
    site.stay(60)
    assert site.state.phase is Phase.LOOKING, "however long it takes, and the object in view"
    site.robot(phase=IDLE)
    site.run_to(Phase.EXECUTING)


def test_a_scene_without_variants_is_reset_as_it_stands():
    site = Site(BY_HAND)
    site.sees(scene=msgspec.structs.replace(site.view.scene, variants=()))
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert [request.variant for request in site.requests(queries.RESET)] == [None]


def test_an_idle_robot_proves_nothing_the_result_may_be_late():
    site = executing()
    site.robot(phase=IDLE)
    site.stay(600)
    assert site.state.phase is Phase.EXECUTING
    site.end(REACHED)
    site.step()
    assert site.state.phase is Phase.DECIDING
    assert site.state.last == REACHED


def test_a_state_of_before_the_start_proves_nothing_either():
    site = executing()
    site.step(robot=msgspec.structs.replace(site.view.robot, episode=0, phase=IDLE))
    assert site.state.phase is Phase.EXECUTING


@pytest.mark.parametrize(
    ("changes", "word"), [({"publisher": 2, "episode": 0}, "restarted"), ({"episode": 2}, "another episode")]
)
def test_an_episode_is_lost_by_another_robot_process_or_a_newer_episode(changes, word):
    site = executing()
    site.robot(**changes)
    site.step()
    assert site.state.phase is Phase.DECIDING
    assert word in site.state.event
    assert site.stay() == []


def test_the_result_of_another_request_is_not_this_episodes():
    site = executing()
    site.sees(result=site.result(REACHED, request=site.state.episode.request + 1))
    site.stay()
    assert site.state.phase is Phase.EXECUTING
    assert site.state.attempts == ()


def test_a_result_that_overtakes_the_acknowledgement_of_the_start_counts():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.STARTING)
    site.instead[queries.EXECUTE.name] = UNANSWERED
    site.step()
    site.end(MISSED)
    site.step()
    assert site.state.phase is Phase.DECIDING
    assert not site.state.pressed
    assert site.state.last == MISSED


def test_the_same_result_counts_once():
    site = executing()
    site.end(MISSED)
    site.stay(30)
    assert len(site.state.attempts) == 1


def test_a_person_may_let_the_robot_hold_for_as_long_as_they_like():
    site = executing()
    site.robot(phase=HOLD, waiting=True)
    site.now_s += 3600.0
    assert site.stay() == []
    assert site.state.phase is Phase.EXECUTING


def test_a_held_motion_offers_to_go_on_and_does_so_upon_a_press():
    site = executing()
    site.step(Action.GO_ON)
    site.step(Action.GO_ON, robot=None)
    assert site.state.offered == {Action.FINISH}
    site.robot(phase=HOLD, waiting=True)
    assert site.stay() == []
    assert site.state.offered == {Action.FINISH, Action.GO_ON}
    site.step(Action.GO_ON)
    (resume,) = site.requests(queries.RESUME)
    assert resume.epoch == site.epoch
    site.robot(phase=EXECUTE, waiting=False)
    assert site.stay() == []


def test_a_short_hold_asks_nothing():
    site = executing()
    site.robot(phase=HOLD, waiting=False)
    site.step(Action.GO_ON)
    assert site.stay() == []
    assert site.state.offered == {Action.FINISH}


def test_a_script_lets_a_held_motion_go_on_by_itself():
    site = Site(SCRIPTED)
    site.run_to(Phase.EXECUTING)
    site.robot(phase=HOLD, waiting=True)
    assert set(site.stay(4)) == {"cmd/resume"}


def test_going_on_that_is_refused_is_told_and_offered_again():
    site = executing()
    site.robot(phase=HOLD, waiting=True)
    site.fail(queries.RESUME, queries.Refused("nobody is present"))
    site.step(Action.GO_ON)
    site.step(robot=msgspec.structs.replace(site.view.robot, phase=IDLE, waiting=False))
    assert site.stay() == []
    assert "nobody is present" in site.state.notice
    assert Action.GO_ON in site.state.offered


def test_finish_is_asked_until_it_is_answered_and_then_no_more():
    site = executing()
    site.fail(queries.FINISH, Failed("nobody answers"))
    site.step(Action.FINISH)
    site.stay(6)
    first, second = site.requests(queries.FINISH)
    assert first == second
    assert site.stay() == []


def test_finish_goes_before_going_on():
    site = executing()
    site.robot(phase=HOLD, waiting=True)
    site.instead[queries.RESUME.name] = UNANSWERED
    site.step(Action.GO_ON)
    site.step(Action.FINISH)
    assert site.names()[-1] == "cmd/finish"
    site.step(Action.GO_ON)
    assert site.names().count("cmd/resume") == 1


def test_finish_of_an_episode_that_has_ended_without_a_result_asks_the_operator():
    site = executing()
    site.robot(phase=IDLE)
    site.fail(queries.FINISH, queries.Refused("no episode is running"))
    site.step(Action.FINISH)
    site.step()
    assert site.state.phase is Phase.DECIDING
    site.end(COLLIDED)
    site.step()
    assert site.state.last == COLLIDED


def test_finish_that_is_refused_while_the_robot_moves_is_told():
    site = executing()
    site.fail(queries.FINISH, queries.Refused("not of this epoch"))
    site.step(Action.FINISH)
    site.step()
    assert site.state.phase is Phase.EXECUTING
    assert "not of this epoch" in site.state.notice


def test_to_finish_is_another_request_in_every_episode():
    site = executing()
    site.step(Action.FINISH)
    site.end(MISSED)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.step(Action.FINISH)
    first, second = site.requests(queries.FINISH)
    assert first.request != second.request


def test_keys_that_are_held_from_when_the_robot_executes_count():
    site = executing(Action.REFINE)
    site.step(steering=True)
    assert not site.state.let_go


def test_keys_that_are_held_through_a_hold_that_ends_by_itself_count_on():
    site = executing(Action.REFINE)
    site.step(steering=True)
    for phase in (HOLD, EXECUTE):
        site.robot(phase=phase, mode=messages.Mode.REFINE)
        site.step(steering=True)
        assert not site.state.let_go
    site.sees(robot=None)
    site.step(steering=True)
    assert not site.state.let_go


@pytest.mark.parametrize("before", [{"phase": RAMP}, {"phase": HOLD, "waiting": True}])
def test_keys_that_are_held_before_the_robot_executes_have_to_be_let_go(before):
    site = executing(Action.REFINE)
    site.robot(**before, mode=messages.Mode.REFINE)
    site.step(steering=True)
    site.robot(phase=EXECUTE, waiting=False)
    site.step(steering=True)
    assert site.state.let_go
    site.step(steering=False)
    assert not site.state.let_go
    site.step(steering=True)
    assert not site.state.let_go
