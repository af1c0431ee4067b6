"""Who commands: one tab, and nobody without a press but the first."""

from dataclasses import FrozenInstanceError, fields

import pytest
from browser_tab import MS, BrowserTab

from protocol.messages import OperatorInput
from services.station.page.input import Desk
from services.station.page.seat import Seat
from services.station.page.seating import seating
from services.station.press import Press

ASKED_MS = 10_000
RESERVED_MS = 30_000


@pytest.fixture
def first():
    """A tab that has the seat."""
    tab = BrowserTab(Desk())
    tab.keep_on(2.0)
    return tab


def test_where_nobody_has_the_input_any_more_whoever_comes_is_told_to_ask_for_it(first):
    second = BrowserTab(first.desk, tab=2, now_ms=first.now_ms)
    assert seating(second.standing())["view-only-text"] == "The input is not here: you can only stop."
    first.leave()
    assert seating(second.standing())["view-only-text"] == "Nobody has the input: ask for it."
    assert not first.standing().armed


@pytest.fixture
def second(first):
    """A tab that looks on."""
    tab = BrowserTab(first.desk, tab=2, now_ms=first.now_ms)
    tab.hold()
    first.now_ms = tab.now_ms
    first.hold()
    return tab


def silence(tab, other, milliseconds):
    """Time passes in which both tabs are there and nobody answers."""
    for _ in range(milliseconds // 20):
        other.hold()
        tab.hold()


def test_one_tab_commands_and_the_others_look_on(first, second):
    second.hold("KeyQ")
    first.hold("KeyE", later_ms=40)
    assert first.input().keys == ("KeyE",)
    assert first.standing().armed
    assert not second.standing().armed


def test_a_tab_that_looks_on_may_stop_the_robot_and_nothing_else(first, second):
    for action in ("execute", "stop", "give_input"):
        second.press(action)
    assert first.desk.take_presses() == [Press("stop")]
    assert second.standing().refused == (1, 3)
    assert first.desk.dropped == 2
    assert first.standing().armed


def disturbances(second):
    """What a tab that looks on may do without a word of who sits."""
    third = BrowserTab(second.desk, tab=3, now_ms=second.now_ms)
    yield
    second.press("take_input")
    yield
    third.press("take_input")
    yield
    third.leave()
    yield
    second.leave()
    yield


def test_who_sits_goes_on_undisturbed_while_others_come_ask_and_go(first, second):
    first.hold("KeyE")
    for _ in disturbances(second):
        assert first.input() == OperatorInput(present=True, focused=True, keys=("KeyE",))


def test_asking_for_the_seat_that_one_has_changes_nothing(first):
    first.hold("KeyE")
    first.press("take_input")
    assert first.input() == OperatorInput(present=True, focused=True, keys=("KeyE",))


def test_who_sits_is_asked_before_another_takes_the_input(first, second):
    second.press("take_input")
    assert second.standing().accepted == (1,)
    assert first.standing().armed
    assert first.standing().asked_s == pytest.approx(ASKED_MS / 1e3, abs=0.05)
    assert second.standing().asking_s == pytest.approx(ASKED_MS / 1e3, abs=0.05)
    assert second.standing().asked_s == first.standing().asking_s == 0.0
    assert first.desk.take_presses() == []


def test_whoever_keeps_the_input_is_asked_no_more_and_the_other_is_told(first, second):
    second.press("take_input")
    first.press("keep_input")
    assert first.standing().accepted == (1,)
    silence(second, first, ASKED_MS + 100)
    assert first.standing().armed
    assert first.standing().asked_s == second.standing().asking_s == 0.0
    assert second.standing().kept
    second.press("take_input")
    assert second.standing().asking_s > 0.0
    assert not second.standing().kept


def test_given_input_moves_at_once_and_counts_once_nothing_is_held(first, second):
    first.hold("KeyE")
    second.press("take_input")
    first.press("give_input")
    assert first.input() == OperatorInput()
    assert second.standing().armed
    second.hold("KeyQ")
    assert second.input().keys == ()
    second.hold()
    second.hold("KeyQ")
    assert second.input().keys == ("KeyQ",)


def test_nobody_is_present_for_a_second_after_the_input_has_moved(first, second):
    assert first.input().present
    second.press("take_input")
    first.press("give_input")
    second.keep_on(0.9)
    assert not second.input().present
    second.keep_on(0.2)
    assert second.input().present


def test_silence_gives_the_input(first, second):
    second.press("take_input")
    silence(second, first, ASKED_MS - 40)
    assert first.standing().armed
    silence(second, first, 60)
    assert second.standing().armed
    assert not first.standing().armed
    assert not second.input().present


def test_whoever_asked_and_left_gets_nothing(first, second):
    second.press("take_input")
    second.leave()
    first.keep_on(ASKED_MS / 1e3 + 0.1)
    assert first.standing().armed
    assert first.standing().asked_s == 0.0


def test_one_question_at_a_time(first, second):
    third = BrowserTab(first.desk, tab=3, now_ms=second.now_ms)
    second.press("take_input")
    third.press("take_input")
    assert second.standing().asking_s > 0.0
    assert third.standing().asking_s == 0.0


def test_nobody_inherits_the_seat_of_a_tab_that_has_gone(first, second):
    first.leave()
    third = BrowserTab(first.desk, tab=3, now_ms=first.now_ms + 60_000)
    third.keep_on(2.0)
    second.now_ms = third.now_ms
    second.hold()
    assert not second.standing().armed
    assert not third.standing().armed
    assert third.input() == OperatorInput()


def test_an_observer_that_reloads_before_the_operator_does_not_get_the_seat(first, second):
    first.leave()
    second.leave()
    observer = BrowserTab(first.desk, tab=3, now_ms=first.now_ms + 100, token="seat-0002")
    operator = BrowserTab(first.desk, tab=4, now_ms=first.now_ms + 200, token="seat-0001")
    assert operator.standing().armed
    assert not observer.standing().armed


def test_a_tab_finds_its_seat_again_however_long_it_slept(first):
    first.leave()
    again = BrowserTab(first.desk, tab=3, now_ms=first.now_ms + 10 * RESERVED_MS, token="seat-0001")
    assert again.standing().armed


def test_a_tab_finds_its_seat_again_before_its_old_connection_is_known_to_be_dead(first):
    again = BrowserTab(first.desk, tab=3, now_ms=first.now_ms, token="seat-0001")
    first.leave()
    assert again.standing().armed


def test_the_seat_of_a_tab_that_has_just_gone_has_to_be_asked_for(first, second):
    first.leave()
    second.now_ms += RESERVED_MS
    second.hold()
    second.press("take_input")
    assert not second.standing().armed
    second.keep_on(ASKED_MS / 1e3)
    assert second.standing().armed


def test_a_seat_that_is_kept_for_whoever_left_it_is_had_once_it_is_kept_no_longer(first, second):
    first.leave()
    second.now_ms += RESERVED_MS - 2_000
    second.hold()
    second.press("take_input")
    assert second.standing().asking_s == pytest.approx(2.0)
    second.keep_on(2.1)
    assert second.standing().armed


def test_the_seat_of_a_tab_that_has_gone_for_good_is_taken_by_a_press(first, second):
    first.leave()
    second.now_ms += RESERVED_MS + 1
    second.hold()
    second.press("take_input")
    assert second.standing().armed
    second.keep_on(0.2)
    assert not second.input().present


def test_the_tab_that_sits_has_nobody_to_ask(first):
    first.press("take_input")
    assert first.standing().asking_s == first.standing().asked_s == 0.0


def test_a_tab_that_did_not_say_who_it_is_gets_no_seat(first):
    first.desk.receive(
        9, b'{"kind":"pressed","sequence":1,"stamp_ms":9,"number":1,"action":"take_input"}', first.now_ms * MS
    )
    assert first.standing().asked_s == 0.0


def test_an_answer_without_a_question_changes_nothing(first):
    first.press("give_input")
    first.press("keep_input")
    first.hold()
    assert first.standing().armed
    assert not first.standing().kept


def test_how_a_tab_stands_and_who_asks_are_said_for_good(first):
    seat = Seat()
    seat.enter(1, "seat-0001")
    seat.ask(2, "seat-0002", 0)
    for value in (first.standing(), seat.question):
        for field in fields(value):
            with pytest.raises(FrozenInstanceError):
                setattr(value, field.name, None)
