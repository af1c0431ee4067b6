"""What the page says about measurements."""

import math

import pytest
from views import robot

from protocol.messages import Light, Phase, TeachingState, Verdict
from services.process.clock import ManualClock
from services.station.page.readout import criteria, is_stale, outcome, span
from services.station.page.view import Board, PageView, Shown


@pytest.mark.parametrize(
    ("seconds", "words"),
    [(0.0, "0 ms"), (0.0123, "12 ms"), (1.25, "1.2 s"), (180.0, "3 min"), (-1.0, "none"), (math.inf, "none")],
)
def test_a_span_is_said_in_a_few_characters(seconds, words):
    assert span(seconds) == words


def test_a_view_ages_while_it_hangs():
    clock = ManualClock()
    board = Board(clock)
    board.put(PageView(robot=robot(Phase.IDLE), robot_age_s=0.1))
    assert not is_stale(board.newest())
    clock.advance(0.25)
    assert board.newest().robot_age_s == pytest.approx(0.35)
    assert is_stale(board.newest())


def test_data_that_never_came_is_stale():
    assert is_stale(Shown(PageView(), 0.0))


@pytest.mark.parametrize(
    ("phase", "verdict", "expected"),
    [
        (Phase.EXECUTE, Verdict(reached=False, kicked_over=False, collision=False), (None, "Under way")),
        (Phase.IDLE, Verdict(reached=False, kicked_over=False, collision=False), (False, "Failure")),
        (Phase.EXECUTE, Verdict(reached=False, kicked_over=False, collision=True), (False, "Failure")),
        (Phase.IDLE, Verdict(reached=True, kicked_over=True, collision=False), (False, "Failure")),
        (Phase.IDLE, Verdict(reached=True, kicked_over=False, collision=False), (True, "Success")),
        (Phase.IDLE, None, (None, "No verdict yet")),
    ],
)
def test_the_outcome_is_all_three_criteria_and_not_reached_is_open_while_it_moves(phase, verdict, expected):
    assert outcome(Shown(PageView(robot=robot(phase), verdict=verdict), 0.0)) == expected


def test_before_the_first_episode_nothing_has_failed():
    verdict = Verdict(reached=False, kicked_over=False, collision=False)
    before = Shown(PageView(robot=robot(Phase.IDLE, episode=0), verdict=verdict), 0.0)
    assert outcome(before) == (None, "No verdict yet")
    assert criteria(before)[0][0] is None


def test_a_collision_says_where_and_how_hard():
    verdict = Verdict(
        reached=False, kicked_over=False, collision=True, collision_position=(0.5, 0.1, 0.25), collision_force=4.2
    )
    assert criteria(Shown(PageView(verdict=verdict), 0.0))[2] == (False, "4.2 N at x 500, y 100, z 250 mm")


def test_a_hold_that_comes_and_goes_is_shown_for_a_moment_longer():
    clock = ManualClock()
    board = Board(clock)

    def shown(light, phase="executing"):
        board.put(PageView(teaching=TeachingState(phase=phase, text=light.value, light=light)))
        return board.newest().view.teaching.light

    assert shown(Light.GREEN) is Light.GREEN
    assert shown(Light.HOLD) is Light.HOLD
    clock.advance(0.59)
    assert shown(Light.GREEN) is Light.HOLD
    assert board.newest().view.teaching.text == "hold"
    clock.advance(0.01)
    assert shown(Light.GREEN) is Light.GREEN
    assert shown(Light.HOLD) is Light.HOLD
    assert shown(Light.RED) is Light.RED
    assert shown(Light.GREEN, phase="deciding") is Light.GREEN


def test_what_was_limited_is_shown_for_a_moment_longer():
    clock = ManualClock()
    board = Board(clock)
    board.put(PageView(robot=robot(Phase.EXECUTE, clamped=("displacement",))))
    board.put(PageView(robot=robot(Phase.EXECUTE)))
    assert board.newest().clamped == ("displacement",)
    clock.advance(1.0)
    assert board.newest().clamped == ()
