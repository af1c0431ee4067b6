"""The tour through the page: five steps, by hand or by key, once, and in nobody's way."""

import pytest

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

FIRST_TIME = "localStorage.removeItem('retouch-tour');"
NAMES = ["What happens", "What to do now", "How to steer", "How to stop", "Whether to trust it"]


@pytest.fixture
def newcomer(open_seated):
    """A tab of somebody who has never seen the page."""
    return open_seated(script=FIRST_TIME)


def title(tab):
    return tab.page.inner_text(".tour-title")


def test_whoever_comes_for_the_first_time_is_led_through_and_that_is_remembered(newcomer):
    seen = []
    for _ in NAMES:
        seen.append(title(newcomer))
        newcomer.page.click(".tour-next")
    assert seen == NAMES
    newcomer.wait(".tour", "hidden")
    assert newcomer.page.evaluate("localStorage.getItem('retouch-tour')") == "seen"


def test_it_can_be_skipped_and_asked_for_again(newcomer):
    newcomer.page.click(".tour-skip")
    newcomer.wait(".tour", "hidden")
    newcomer.page.click(".tour-open")
    newcomer.wait(".tour:visible")
    assert title(newcomer) == NAMES[0]


def test_it_is_led_by_key_and_gives_the_focus_back(tab):
    tab.page.focus(".tour-open")
    tab.page.keyboard.press("Enter")
    tab.wait(".tour:visible")
    for _ in NAMES:
        tab.page.focus(".tour-next")
        tab.page.keyboard.press("Enter")
    tab.wait(".tour", "hidden")
    assert tab.page.evaluate("document.activeElement.className").endswith("tour-open")


def test_it_opens_by_itself_without_taking_the_keys(newcomer, station, eventually):
    page, _ = station
    newcomer.wait(".tour:visible")
    newcomer.page.keyboard.down("e")
    eventually(lambda: page.take_input().keys == ("KeyE",))
    newcomer.page.keyboard.up("e")


@pytest.mark.parametrize("size", [(1600, 900), (1280, 720), (390, 844)])
def test_no_step_covers_the_stop(newcomer, size):
    newcomer.page.set_viewport_size({"width": size[0], "height": size[1]})
    stop = newcomer.page.locator(".stop-button").bounding_box()
    for _ in NAMES:
        own = newcomer.page.locator(".tour").bounding_box()
        beside = own["x"] >= stop["x"] + stop["width"] or own["x"] + own["width"] <= stop["x"]
        assert beside or own["y"] + own["height"] <= stop["y"]
        assert own["x"] >= 0
        assert own["x"] + own["width"] <= size[0]
        newcomer.page.click(".tour-next")


def test_somebody_who_was_here_is_not_led_through(tab):
    tab.wait(".tour", "hidden")
