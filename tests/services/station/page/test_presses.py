"""The laws of presses: each is done once, a stop always, and nothing else that comes late."""

import pytest
from browser_tab import BrowserTab

from services.station.page.input import Desk
from services.station.page.presses import Presses
from services.station.press import Press

LATE_PRESS_MS = 1_000
PRESSES_KEPT = 64


@pytest.fixture
def browser():
    """A tab that has the seat, with nothing held."""
    tab = BrowserTab(Desk())
    tab.hold()
    return tab


def test_buttons_arrive_once_and_in_order(browser):
    for action in ("execute", "undo"):
        browser.press(action)
    assert browser.desk.take_presses() == [Press("execute"), Press("undo")]
    assert browser.desk.take_presses() == []


def test_two_presses_of_one_button_about_two_things_are_two():
    tab = BrowserTab(Desk())
    tab.hold()
    tab.press("remove", argument="3")
    tab.press("remove", argument="2")
    assert tab.desk.take_presses() == [Press("remove", "3"), Press("remove", "2")]


def test_a_press_that_is_said_twice_is_done_once_and_acknowledged(browser):
    browser.press("execute", number=7)
    browser.press("execute", number=7)
    assert browser.desk.take_presses() == [Press("execute")]
    assert browser.standing().accepted == (7,)


def test_a_press_is_known_again_on_another_connection(browser):
    browser.press("execute", number=7)
    browser.leave()
    again = BrowserTab(browser.desk, tab=2, now_ms=browser.now_ms, token="seat-0001", load=browser.load)
    again.hold()
    again.press("execute", number=7)
    assert browser.desk.take_presses() == [Press("execute")]
    assert again.standing().accepted == (7,)


def test_a_tab_that_has_gone_is_forgotten(browser):
    browser.press("execute")
    browser.leave()
    assert browser.standing().accepted == ()
    browser.press("undo")
    assert browser.desk.take_presses() == [Press("execute")]


def test_the_presses_of_a_page_that_was_loaded_anew_are_new_ones(browser):
    browser.press("execute", number=1)
    browser.leave()
    again = BrowserTab(browser.desk, tab=2, now_ms=browser.now_ms, token="seat-0001")
    again.hold()
    again.press("execute", number=1)
    assert browser.desk.take_presses() == [Press("execute"), Press("execute")]


def test_a_press_that_comes_late_is_refused_and_said_to_be(browser):
    browser.keep_on(2.0)
    browser.press("execute", age_ms=LATE_PRESS_MS)
    browser.press("refine", age_ms=LATE_PRESS_MS + 1)
    assert browser.desk.take_presses() == [Press("execute")]
    assert (browser.standing().accepted, browser.standing().refused) == ((1,), (2,))
    assert browser.desk.late == 1


def test_a_stop_is_never_late_and_comes_before_everything_else(browser):
    browser.keep_on(2.0)
    browser.press("execute")
    browser.press("stop", age_ms=2_500)
    assert browser.desk.take_presses() == [Press("stop"), Press("execute")]
    assert browser.standing().accepted == (1, 2)


def test_a_stop_counts_even_before_the_tab_said_who_it_is():
    desk = Desk()
    desk.receive(9, b'{"kind":"pressed","sequence":1,"stamp_ms":9,"number":1,"action":"stop"}', 0)
    assert desk.take_presses() == [Press("stop")]


def test_a_stop_gets_through_where_too_many_buttons_wait(browser):
    for _ in range(PRESSES_KEPT + 1):
        browser.press("execute")
    browser.press("stop")
    assert browser.standing().refused == (PRESSES_KEPT + 1,)
    assert browser.desk.take_presses() == [Press("stop")] + [Press("execute")] * PRESSES_KEPT


def test_a_stop_is_unconfirmed_in_every_tab_until_the_robot_confirms_it(browser):
    other = BrowserTab(browser.desk, tab=2, now_ms=browser.now_ms)
    assert not browser.standing().stop_pressed
    other.press("stop")
    assert browser.standing().stop_pressed
    assert other.standing().stop_pressed
    browser.desk.confirm_stop()
    assert not browser.standing().stop_pressed


def test_of_a_page_the_newest_64_presses_are_known_again():
    presses = Presses()
    for number in range(65):
        presses.settle("page", number, accepted=True)
    assert presses.settled("page") == {True: tuple(range(1, 65)), False: ()}
    assert presses.is_new("page", 0)
    assert not presses.is_new("page", 1)


def test_of_the_pages_that_were_loaded_the_32_that_pressed_last_are_known():
    presses = Presses()
    for page in range(32):
        presses.settle(f"page {page}", 1, accepted=False)
    presses.settle("page 0", 2, accepted=True)
    presses.settle("page 32", 1, accepted=True)
    assert [page for page in range(33) if presses.is_new(f"page {page}", 1)] == [1]


def test_a_press_that_is_faster_on_its_way_than_all_before_it_is_not_late():
    """A page that has just opened says its first state late; what is pressed after it comes as soon as ever."""
    browser = BrowserTab(Desk())
    browser.hold(stamp_ms=browser.now_ms + 20 - 400)
    browser.press("execute")
    assert browser.desk.take_presses() == [Press("execute")]
    assert browser.standing().refused == ()
