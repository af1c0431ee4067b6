"""Nothing moves unasked: what the operator is asked, and what a press leads to."""

import pytest

from protocol import queries
from protocol.messages import Mode
from services.station.workflow.action import Action
from services.station.workflow.going import SETTING
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import (
    BY_HAND,
    COLLIDED,
    HOLD,
    MISSED,
    REACHED,
    SCRIPTED,
    UNANSWERED,
    Site,
)

HISTORY = {Action.TAKE_BACK, Action.USE_AGAIN, Action.SKILL, Action.NEW_SKILL}
MOVING = {"cmd/reset", "cmd/execute", "cmd/resume"}


def told(site):
    return teaching_state(site.state, site.view, site.settings)


def test_after_connecting_it_asks_for_the_authority_looks_and_stands():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    assert site.stay(60) == []
    assert site.state.phase is Phase.DECIDING
    assert site.names() == ["authority/acquire"]
    assert site.state.looked == (0.85, 0.05, 0.5)
    assert (
        site.state.offered
        == {Action.EXECUTE, Action.REFINE, Action.NEXT, Action.END, Action.METHOD} | SETTING | HISTORY
    )


def test_a_press_before_it_asks_moves_nothing():
    site = Site(BY_HAND)
    while site.state.phase is not Phase.DECIDING:
        site.step(Action.EXECUTE, Action.REFINE, Action.NEXT, Action.GO_ON)
    assert site.stay() == []
    assert not MOVING & set(site.names())


def test_a_target_that_is_not_seen_is_said_and_the_operator_asked_all_the_same():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING, seen=None)
    site.step(seen=None)
    assert "not seen" in told(site).text
    assert "Ready" not in told(site).text
    assert not MOVING & set(site.names())


def unseen():
    """The arm hides the target."""
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING, seen=None)
    site.step(seen=None)
    return site


def test_no_motion_is_offered_to_a_target_that_is_not_seen_but_a_look_at_it():
    site = unseen()
    assert not {Action.EXECUTE, Action.REFINE, Action.LEAD} & site.state.offered
    assert told(site).recommended == "look"
    assert not MOVING & {query for press in (Action.EXECUTE, Action.REFINE) for query in pressed(site, press)}


def pressed(site, action):
    site.step(action, seen=None)
    return site.stay(seen=None)


def test_a_look_puts_the_arm_back_and_leads_to_no_motion():
    site = unseen()
    site.fail(queries.RESET, queries.Refused("an episode is running"))
    site.step(Action.LOOK, seen=None)
    site.run_to(Phase.DECIDING)
    site.stay()
    assert MOVING & set(site.names()) == {"cmd/reset"}
    assert site.names().count("cmd/reset") == 2
    assert Action.EXECUTE in site.state.offered
    assert Action.LOOK not in site.state.offered


def test_a_look_that_finds_nothing_is_said_again_after_some_patience():
    site = unseen()
    site.step(Action.LOOK, seen=None)
    site.run_to(Phase.LOOKING, seen=None)
    since_s = site.now_s
    site.run_to(Phase.DECIDING, seen=None)
    assert site.now_s - since_s == pytest.approx(15.0, abs=1.1)
    site.step(seen=None)
    assert told(site).recommended == "look"


def test_a_target_that_comes_into_view_is_not_said_to_be_hidden():
    site = unseen()
    site.step()
    assert Action.EXECUTE in site.state.offered
    assert told(site).text.startswith("Ready")


def test_a_press_whose_robot_fell_silent_before_the_look_moves_nothing_later():
    site = unseen()
    site.fail(queries.RESET, UNANSWERED)
    site.step(Action.LOOK, seen=None)
    site.stay(3, robot=None, seen=None)
    assert site.state.phase is Phase.DECIDING
    assert site.stay() == []


def test_the_press_that_asks_for_an_episode_begins_with_the_reset():
    site = Site(BY_HAND)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert site.names() == ["authority/acquire", "cmd/reset", "model/predict", "cmd/execute"]
    assert site.state.mode is Mode.AUTONOMOUS


def test_a_person_decides_after_each_episode():
    site = Site(BY_HAND, [COLLIDED, MISSED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    assert site.stay() == []
    site.press(Action.REFINE, Phase.EXECUTING)
    assert site.state.mode is Mode.REFINE


def test_after_a_lesson_the_model_is_tried_only_upon_a_press():
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    assert site.stay() == []
    assert "learnt" in site.state.event


def test_what_is_not_offered_is_not_done():
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    site.step(Action.UNDO, Action.TEACH, Action.TAKE_OVER, Action.GO_ON, Action.FINISH, Action.RELEASE_STOP)
    assert site.state.phase is Phase.DECIDING


def test_undo_takes_the_update_back_and_asks():
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    site.step()
    assert site.state.updates == 1
    assert Action.UNDO in site.state.offered
    site.step(Action.UNDO)
    site.run_to(Phase.DECIDING)
    assert site.stay() == []
    assert site.names()[-1] == "model/undo"
    assert site.state.updates == 0
    assert Action.UNDO not in site.state.offered


def test_an_undo_that_is_refused_is_said_and_the_operator_asked():
    site = Site(BY_HAND, [COLLIDED, REACHED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.run_to(Phase.DECIDING)
    site.fail(queries.UNDO, queries.Refused("there is nothing"))
    site.step(Action.UNDO)
    site.run_to(Phase.DECIDING)
    assert "there is nothing" in site.state.event
    assert site.state.updates == 1


def test_the_next_object_is_drawn_anew_and_its_counts_begin_anew():
    site = Site(BY_HAND, [COLLIDED, REACHED, MISSED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    assert site.state.refinements == 1
    site.step(Action.NEXT)
    assert (site.state.placed, site.state.refinements, site.state.last) == (None, 0, None)
    assert site.state.updates == 0
    site.run_to(Phase.EXECUTING)
    assert site.state.mode is Mode.AUTONOMOUS


def test_the_operator_ends_the_run():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.step(Action.END)
    assert (site.state.phase, site.state.reason) == (Phase.FINISHED, "ended before the loop had closed")
    assert site.stay(3, robot=None) == []
    assert site.state.phase is Phase.FINISHED


def test_a_person_who_ended_a_run_begins_another_one_with_a_press_and_stands_until_the_next():
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    site.step(Action.END)
    site.step()
    assert site.state.offered == {Action.NEXT}
    asked = len(site.asked)
    site.step(Action.NEXT)
    site.run_to(Phase.DECIDING)
    assert (site.state.placed, site.state.last, site.state.reason) == (None, None, "")
    assert not MOVING & set(site.names()[asked:])


def test_a_run_that_is_begun_after_another_counts_anew_and_holds_no_authority_of_before():
    site = Site(BY_HAND, [COLLIDED, REACHED, MISSED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.press(Action.REFINE, Phase.LEARNING)
    site.press(Action.REFINE, Phase.EXECUTING)
    site.press(Action.END, Phase.FINISHED)
    assert (site.state.refinements, site.state.updates) == (1, 1)
    site.step(Action.NEXT)
    assert (site.state.phase, site.state.refinements, site.state.updates) == (Phase.WAITING, 0, 0)
    assert site.state.held_epoch == 0


def test_a_script_that_has_ended_its_run_begins_no_other():
    site = Site(SCRIPTED, [COLLIDED, REACHED, REACHED])
    site.run_to(Phase.FINISHED)
    site.step(Action.NEXT)
    assert (site.state.phase, site.state.offered) == (Phase.FINISHED, frozenset())


@pytest.mark.parametrize("query", [queries.RESET, queries.PREDICT, queries.EXECUTE])
def test_a_refusal_that_does_not_pass_is_told_and_the_operator_asked(query):
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.step(Action.EXECUTE)
    for _ in range(100):
        if site.state.phase is Phase.DECIDING:
            break
        site.fail(query, queries.Refused("it is too far"))
        site.step()
    assert site.state.phase is Phase.DECIDING
    assert "it is too far" in site.state.event
    assert site.names().count(query.name) == 5
    assert not site.state.pressed
    site.instead.clear()
    assert site.stay() == []


@pytest.mark.parametrize("query", [queries.RESET, queries.PREDICT, queries.EXECUTE])
def test_a_script_ends_by_a_refusal_that_does_not_pass(query):
    site = Site(SCRIPTED)
    for _ in range(100):
        if site.state.phase is Phase.FINISHED:
            break
        site.fail(query, queries.Refused("it is too far"))
        site.step()
    assert "it is too far" in site.state.reason


@pytest.mark.parametrize("query", [queries.RESET, queries.PREDICT, queries.EXECUTE])
def test_a_refusal_that_passes_is_only_a_delay(query):
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.fail(query, queries.Refused("not yet"))
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert site.names().count(query.name) == 2
    assert site.names().count("model/predict") == (1 if query is queries.RESET else 2)
    assert site.names().count("authority/acquire") == 1


def test_refusals_count_from_each_press_anew():
    site = Site(BY_HAND)
    for _ in range(3):
        site.run_to(Phase.DECIDING)
        site.step(Action.EXECUTE)
        for _ in range(3):
            site.fail(queries.RESET, queries.Refused("not yet"))
            while queries.RESET.name in site.instead:
                site.step()
        site.run_to(Phase.EXECUTING)
        site.end(COLLIDED)


def test_an_episode_that_still_runs_is_ended_before_the_reset():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    site.robot(phase=HOLD)
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert site.names()[1:3] == ["cmd/finish", "cmd/reset"]
