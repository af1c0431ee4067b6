"""While a motion runs its operator sets the pace, pauses, steps and scrubs; before it, the part to correct."""

import msgspec
import pytest

from protocol import queries
from protocol.messages import Cut, ExecutionState, Light, Mode, Part
from services.station.press import Press
from services.station.workflow.action import Action
from services.station.workflow.going import FASTEST, SLOWEST, STEP
from services.station.workflow.state import Phase
from services.station.workflow.words import teaching_state
from tests.services.station.workflow.site import BY_HAND, COLLIDED, EXECUTE, MISSED, REACHED, Site


def site_in(mode, **robot):
    """A site in the middle of a motion, as the robot tells of it."""
    site = Site(BY_HAND)
    site.press(Action.REFINE if mode is Mode.REFINE else Action.EXECUTE, Phase.EXECUTING)
    under_way(site, **robot)
    return site


def under_way(site, pace=1.0, progress=0.5, part=None):
    site.robot(phase=EXECUTE, progress=progress)
    part = part or Part()
    site.sees(
        execution=ExecutionState(episode=1, mode=site.state.mode, prediction=1, progress=progress, pace=pace, part=part)
    )


def say(site, action, argument=""):
    site.step(presses=(Press(action.value, argument),))


def asked(site):
    return [(request.rate, request.until) for request in site.requests(queries.PACE)]


@pytest.mark.parametrize(
    ("action", "argument", "expected"),
    [
        (Action.PAUSE, "", (0.0, None)),
        (Action.PLAY, "", (1.0, None)),
        (Action.STEP_BACK, "", (-1.0, pytest.approx(0.5 - STEP))),
        (Action.STEP_ON, "", (1.0, pytest.approx(0.5 + STEP))),
        (Action.SEEK, "0.2", (-1.0, 0.2)),
        (Action.SEEK, "0.9", (1.0, 0.9)),
        (Action.SEEK, "7", (1.0, 1.0)),
        (Action.SEEK, "nan", (0.0, None)),
        (Action.PACE, "0.5", (0.5, None)),
        (Action.PACE, "0.01", (SLOWEST, None)),
        (Action.PACE, "1e9", (FASTEST, None)),
    ],
)
def test_a_press_becomes_one_request(action, argument, expected):
    site = site_in(Mode.REFINE)
    say(site, action, argument)
    site.stay()
    assert asked(site) == [expected]


@pytest.mark.parametrize("mode", Mode)
def test_the_pace_that_is_set_while_the_robot_stands_is_the_next_motion_s(mode):
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    say(site, Action.PACE, "0.5")
    site.press(Action.REFINE if mode is Mode.REFINE else Action.EXECUTE, Phase.EXECUTING)
    site.stay()
    assert asked(site) == [(0.5, None)]


def test_in_a_pause_a_pace_is_set_and_asked_for_when_the_motion_goes_on():
    site = site_in(Mode.REFINE, pace=0.0)
    say(site, Action.PACE, "0.5")
    site.stay()
    assert asked(site) == []
    say(site, Action.PLAY)
    site.stay()
    assert asked(site) == [(0.5, None)]


def test_who_presses_again_before_the_robot_has_answered_asks_for_what_was_pressed_last():
    site = site_in(Mode.REFINE)
    site.fail(queries.PACE)
    say(site, Action.PAUSE)
    say(site, Action.PLAY)
    site.stay()
    assert asked(site)[-1] == (1.0, None)
    first, *_, last = site.requests(queries.PACE)
    assert first.request != last.request


def test_without_an_answer_the_same_request_is_asked_again():
    site = site_in(Mode.REFINE)
    site.fail(queries.PACE)
    say(site, Action.PAUSE)
    site.stay()
    first, second = site.requests(queries.PACE)
    assert first == second


def test_a_refusal_is_told_and_not_asked_again():
    site = site_in(Mode.REFINE)
    site.fail(queries.PACE, queries.Refused("too fast"))
    say(site, Action.PACE, "2")
    site.stay()
    assert len(asked(site)) == 1
    assert "too fast" in site.state.notice


def test_to_end_goes_before_to_pause():
    site = site_in(Mode.REFINE)
    site.step(Action.PAUSE, Action.FINISH)
    site.stay()
    assert site.names()[-1] == "cmd/finish"
    assert asked(site) == []


@pytest.mark.parametrize(("pace", "there"), [(1.0, Action.PAUSE), (0.0, Action.PLAY), (-1.0, Action.PLAY)])
def test_what_is_offered_fits_what_the_motion_does(pace, there):
    site = site_in(Mode.REFINE, pace=pace)
    site.step()
    assert {Action.PAUSE, Action.PLAY} & site.state.offered == {there}
    assert {Action.STEP_BACK, Action.STEP_ON, Action.SEEK, Action.PACE, Action.FINISH} <= site.state.offered


@pytest.mark.parametrize(
    ("robot", "light", "words"),
    [
        ({"pace": 0.0}, Light.HOLD, "Play goes on"),
        ({"pace": -1.0}, Light.AMBER, "goes back"),
        ({"progress": 0.1, "part": Part(0.3, 0.6)}, Light.AMBER, "from 30 % to 60 %"),
        ({"progress": 0.4, "part": Part(0.3, 0.6)}, Light.GREEN, "Steer around it"),
    ],
)
def test_light_and_words_say_whether_a_correction_counts(robot, light, words):
    site = site_in(Mode.REFINE, **robot)
    site.step()
    told = teaching_state(site.state, site.view, site.settings)
    assert told.light is light
    assert words in told.text


def corrected(part="0.3 0.6", outcome=REACHED, **changes):
    """A site whose refinement was to be corrected in a part, and ended."""
    site = Site(BY_HAND, [COLLIDED])
    site.press(Action.EXECUTE, Phase.EXECUTING)
    site.run_to(Phase.DECIDING)
    say(site, Action.PART, part)
    site.press(Action.REFINE, Phase.EXECUTING)
    if changes.pop("finishing", False):
        site.step(Action.FINISH)
    site.end(outcome, **changes)
    site.step()
    return site


def test_the_part_that_is_marked_is_executed_and_learnt():
    site = corrected()
    site.run_to(Phase.DECIDING)
    assert site.requests(queries.EXECUTE)[-1].part == Part(0.3, 0.6)
    (learnt,) = site.requests(queries.ADD_DEMONSTRATION)
    assert learnt.part == Part(0.3, 0.6)
    assert "from 30 % to 60 % of the motion" in site.state.event
    assert site.state.part == Part(), "the next prediction is another motion"


def test_the_robot_goes_to_where_the_part_begins_as_fast_as_alone_and_pauses_there():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    say(site, Action.PART, "0.3 0.6")
    site.press(Action.REFINE, Phase.EXECUTING)
    site.stay()
    assert asked(site) == [(BY_HAND.refine_s / BY_HAND.autonomous_s, 0.3)]


def test_the_robot_alone_executes_the_whole_motion_whatever_is_marked():
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    say(site, Action.PART, "0.3 0.6")
    site.press(Action.EXECUTE, Phase.EXECUTING)
    assert site.requests(queries.EXECUTE)[-1].part == Part()


@pytest.mark.parametrize(
    ("changes", "part"),
    [
        ({"outcome": COLLIDED, "clear_until": 0.5}, (0.3, pytest.approx(0.45))),
        ({"outcome": COLLIDED, "clear_until": 0.9}, (0.3, 0.6)),
        (
            {"outcome": REACHED, "progress": 0.5, "completed": False, "cut": Cut.FINISHED, "finishing": True},
            (0.3, 0.5),
        ),
    ],
    ids=["spoilt in it", "spoilt after it", "finished in it"],
)
def test_of_a_part_that_was_spoilt_or_cut_short_what_came_before_is_learnt_upon_a_press(changes, part):
    site = corrected(**changes)
    site.run_to(Phase.DECIDING)
    assert site.requests(queries.ADD_DEMONSTRATION) == []
    site.press(Action.TEACH, Phase.DECIDING)
    site.stay()
    (learnt,) = site.requests(queries.ADD_DEMONSTRATION)
    assert (learnt.part.first, learnt.part.last) == part


def test_a_part_that_was_spoilt_before_it_began_teaches_nothing():
    site = corrected(outcome=COLLIDED, clear_until=0.2)
    site.run_to(Phase.DECIDING)
    site.step()
    assert Action.TEACH not in site.state.offered


@pytest.mark.parametrize("text", ["", "nonsense", "0.6 0.3", "0.5 0.5", "nan inf"])
def test_marks_that_hold_no_part_are_none(text):
    site = Site(BY_HAND)
    site.run_to(Phase.DECIDING)
    say(site, Action.PART, "0.3 0.6")
    say(site, Action.PART, text)
    assert site.state.part == Part()


def test_a_motion_that_missed_in_a_part_is_not_learnt():
    site = corrected(outcome=MISSED)
    site.run_to(Phase.DECIDING)
    assert site.state.taught is None
    assert msgspec.structs.asdict(site.state.part) == {"first": 0.3, "last": 0.6}, (
        "the mark is for the next attempt too"
    )
