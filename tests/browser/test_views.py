"""The 3-D view's point cloud, keys that follow the view, and another language, in a real browser."""

import math
from dataclasses import replace

import msgspec
import pytest
from harness import served

from protocol.messages import Origin
from services.station.words.table import speech
from tests.ports import free_port

pytestmark = pytest.mark.browser

SIZES = ({"width": 1366, "height": 768}, {"width": 1024, "height": 768})
NEAR = 0.02
CLOUDS = """
    window.clouds = 0;
    const Native = window.WebSocket;
    window.WebSocket = class extends Native {
        constructor(...args) {
            super(...args);
            this.addEventListener("message", ({ data }) => {
                if (typeof data !== "string" && new DataView(data).getUint8(0) === 1) window.clouds += 1;
            });
        }
    };
"""


def turned(page, yaw):
    """A function that says whether the axes are turned by this much for whoever is at the keys."""

    def is_so():
        held = page.take_input()
        return held.focused and abs(held.yaw - yaw) < NEAR

    return is_so


def test_the_cloud_comes_to_who_asks_for_it_which_a_computer_without_a_graphics_card_does_not(open_seated, eventually):
    tab = open_seated(script=CLOUDS)
    tab.wait(".scene[data-view=live]")
    assert tab.page.get_attribute(".cloud", "aria-pressed") == "false"
    assert tab.page.evaluate("clouds") == 0
    tab.page.click(".cloud")
    eventually(lambda: tab.page.evaluate("clouds") == 1)


def test_keys_follow_the_view_that_is_large_where_that_is_asked_for(open_seated, station, eventually):
    page, feed = station
    tab = open_seated()
    tab.wait(".scene[data-view=live]")
    eventually(turned(page, 0.0))
    tab.page.click(".follow")
    first = math.atan2(0.06 + 0.95, 0.62 - 0.05)  # from where one looks at first
    eventually(turned(page, first))
    tab.page.focus(".view")
    tab.page.keyboard.press("ArrowRight")
    eventually(turned(page, first + math.pi / 24))
    tab.page.click("[data-swap=wrist]")
    eventually(turned(page, feed.view.cameras["wrist"].yaw))
    tab.page.click(".follow")
    eventually(turned(page, 0.0))


def test_a_motion_that_was_shown_is_called_so_and_drawn_unlike_one_that_is_predicted(tab, station):
    _, feed = station
    tab.wait(".legend-predicted:text-is('prediction')")
    drawing = feed.view.drawing
    curve = msgspec.structs.replace(drawing.prediction, origin=Origin.REFINEMENT)
    feed.view = replace(feed.view, drawing=msgspec.structs.replace(drawing, prediction=curve))
    tab.wait(".scene[data-origin=refinement] .legend-predicted:has-text('what you corrected')")
    colours = [
        tab.page.evaluate(f"getComputedStyle(document.querySelector('.legend-{name}'), '::before').backgroundColor")
        for name in ("predicted", "way")
    ]
    assert colours[0] == colours[1]


@pytest.fixture
def german():
    speech.speak("de")
    yield
    speech.speak("en")


@pytest.mark.usefixtures("german")
def test_the_page_has_room_for_a_language_of_long_words(open_tab):
    with served(port=free_port()) as (page, _):
        tab = open_tab(page.url)
        tab.wait(".action-label:has-text('Fertig')")
        assert tab.page.get_attribute("html", "lang") == "de"
        for size in SIZES:
            tab.page.set_viewport_size(size)
            root = "document.documentElement"
            over = tab.page.evaluate(f"[{root}.scrollWidth > innerWidth, {root}.scrollHeight > innerHeight]")
            assert over == [False, False], size
        tab.page.set_viewport_size({"width": 1600, "height": 900})
