"""What is offered stays for as long as a person needs to read it, whatever comes and goes meanwhile."""

from dataclasses import replace
from itertools import pairwise

import pytest

from protocol import messages, queries
from protocol.messages import Method, Pose
from services.station.workflow.action import Action
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, HOLD, UNANSWERED, Site

MOMENT_S = 0.06
UNHEARD = ("robot", "authority", "safety", "verdict", "execution", "scene", "model", "seen")
PLACES = tuple(Pose((0.5 + 0.1 * n, 0.0, 0.6), (1.0, 0.0, 0.0, 0.0)) for n in range(4))


def deciding(**seen):
    site = Site(BY_HAND)
    site.sees(**seen)
    site.run_to(Phase.DECIDING)
    site.step()
    return site


def not_seen():
    site = Site(BY_HAND)
    site.run_to(Phase.LOOKING, seen=None)
    site.stay(5, seen=None)
    assert site.state.unseen
    return site


EMPTY = messages.ModelState(kind="adaptive", version=0, demonstrations=0, updates=0, scene="")


def untaught():
    return deciding(model=EMPTY)


def under_way(action=Action.EXECUTE, **robot):
    site = Site(BY_HAND)
    site.press(action, Phase.EXECUTING)
    number, mode = site.view.robot.episode, site.state.mode
    site.sees(execution=messages.ExecutionState(episode=number, mode=mode, prediction=1, progress=0.3))
    site.robot(**robot)
    site.step()
    return site


PLACES_TO_BE = {
    "deciding": deciding,
    "not seen": not_seen,
    "untaught": untaught,
    "alone": under_way,
    "correcting": lambda: under_way(Action.REFINE),
    "asked": lambda: under_way(Action.REFINE, phase=HOLD, waiting=True),
}


@pytest.mark.parametrize("missing", UNHEARD)
@pytest.mark.parametrize("place", PLACES_TO_BE.values(), ids=PLACES_TO_BE)
def test_what_comes_and_goes_several_times_a_second_changes_what_is_offered_once_at_most(place, missing):
    site = place()
    offered = [site.state.offered]
    for moment in range(60):
        site.step(seconds=MOMENT_S, **({missing: None} if moment % 2 else {}))
        offered.append(site.state.offered)
    assert all(offered)
    assert sum(before != after for before, after in pairwise(offered)) <= 1


def storing(site):
    """Waypoints were stored; whatever is done with them is previewed."""
    approach = replace(site.state.approach, method=Method.WAYPOINTS, waypoints=PLACES)
    site.state = replace(site.state, approach=approach)
    site.step(seconds=MOMENT_S)
    return site


def test_an_empty_model_that_is_not_heard_when_the_operator_is_asked_first_is_empty_still():
    site = Site(BY_HAND)
    site.sees(model=EMPTY)
    site.run_to(Phase.ACQUIRING)
    site.run_to(Phase.DECIDING, model=None)
    site.step(model=None)
    assert "Nothing is learnt yet" in teaching_state(site.state, replace(site.view, model=None), site.settings).text
    assert not {Action.EXECUTE, Action.REFINE} & site.state.offered


def test_no_button_goes_away_while_another_motion_is_about_to_be_shown():
    site = storing(deciding())
    said = teaching_state(site.state, site.view, BY_HAND)
    site.fail(queries.PLAN, UNANSWERED)
    site.step(Action.LATER, argument="1", seconds=MOMENT_S)
    for _ in range(5):
        assert site.state.phase is Phase.PLANNING
        meanwhile = teaching_state(site.state, site.view, BY_HAND)
        for name in ("actions", "recommended", "light", "text"):
            assert getattr(meanwhile, name) == getattr(said, name)
        site.step(seconds=MOMENT_S)


def test_nor_when_it_is_shown_or_cannot_be():
    for outcome in (None, queries.Refused("no")):
        site = storing(deciding())
        offered = site.state.offered
        if outcome is not None:
            site.fail(queries.PLAN, outcome)
        site.step(Action.LATER, argument="1", seconds=MOMENT_S)
        for _ in range(5):
            assert site.state.offered == offered
            site.step(seconds=MOMENT_S)
        assert site.state.phase is Phase.DECIDING


@pytest.mark.parametrize(
    ("action", "argument", "phase"),
    [
        (Action.EXECUTE, "", Phase.RESETTING),
        (Action.LATER, "2", Phase.PLANNING),
        (Action.METHOD, "refine", Phase.DECIDING),
        (Action.PACE, "0.5", Phase.PLANNING),
    ],
)
def test_a_press_does_not_wait_for_what_is_about_to_be_shown(action, argument, phase):
    site = storing(deciding())
    site.fail(queries.PLAN, UNANSWERED)
    site.step(Action.LATER, argument="1", seconds=MOMENT_S)
    site.step(seconds=MOMENT_S)
    site.step(action, argument=argument, seconds=MOMENT_S)
    assert site.state.phase is phase
    assert action is not Action.PACE or site.state.pace == 0.5
