"""What a short silence of a page costs: nothing of what was held all the while."""

import pytest
from browser_tab import BrowserTab

from protocol.messages import OperatorInput
from services.station.page.input import Desk

DEAD_MAN_MS = 150
SHORT_MS = 500
NOTHING = OperatorInput()
LATE = OperatorInput(late=True)


@pytest.fixture
def browser():
    """A tab that has the seat, with nothing held."""
    tab = BrowserTab(Desk())
    tab.hold()
    return tab


@pytest.mark.parametrize("silence_ms", [DEAD_MAN_MS + 1, 250, SHORT_MS])
def test_after_a_short_silence_a_key_that_is_still_down_counts_on_from_the_second_sample(browser, silence_ms):
    """A page that stood still for a moment may say first what was held before."""
    browser.hold("KeyE")
    assert browser.input(silence_ms) == LATE
    browser.hold("KeyE", later_ms=silence_ms)
    assert browser.input() == LATE
    assert not browser.standing().let_go
    browser.hold("KeyE")
    assert browser.input().keys == ("KeyE",)


@pytest.mark.parametrize("first", [("KeyE",), ()])
def test_what_was_let_go_in_a_short_silence_never_counts_again(browser, first):
    browser.hold("KeyE")
    browser.hold(*first, later_ms=DEAD_MAN_MS + 1)
    assert browser.input().keys == ()
    browser.hold()
    assert browser.input() == OperatorInput(focused=True)


@pytest.mark.parametrize("lost", [{"focused": False}, {"visible": False}])
def test_a_silence_with_which_the_focus_was_lost_is_no_short_one(browser, lost):
    browser.hold("KeyE")
    browser.hold("KeyE", later_ms=DEAD_MAN_MS + 1, **lost)
    assert browser.input() == NOTHING
    for _ in range(3):
        browser.hold("KeyE")
    assert browser.input() == NOTHING
    assert browser.standing().let_go
