"""The operator's page in a real browser."""

import math
import signal
import socket
import subprocess
import sys
import time
from dataclasses import replace
from pathlib import Path
from urllib.parse import urlsplit

import msgspec
import pytest

from protocol import messages
from protocol.messages import Light
from services.process.clock import SystemClock
from services.process.config import StationSection
from services.process.exceptions import PortInUse
from services.station.page.view import Picture
from services.station.press import Press
from tests.ports import free_port

pytestmark = pytest.mark.browser

HARNESS = Path(__file__).parent / "harness.py"


@pytest.fixture
def filmed(station):
    """A feed whose pictures move."""
    _, feed = station
    feed.moving_pictures = True
    yield feed
    feed.moving_pictures = False


def test_loads_without_a_fault_and_asks_nobody_else(tab, filmed):
    tab.page.wait_for_selector(".camera[data-state=live]")
    asked = {urlsplit(url).hostname for url in tab.requests if not url.startswith(("data:", "blob:"))}
    assert asked == {"127.0.0.1"}
    assert tab.faults == []


SIZES = [(3840, 2160), (1920, 1080), (1600, 900), (1366, 768), (1280, 720)]
ZOOMED = (960, 540)
"""1920 x 1080 at 200 %: to a page there is no difference."""
ONE_COLUMN = [(390, 844), (900, 1200), ZOOMED, (683, 384)]


def resized(tab, size):
    """The window in another size."""
    tab.page.set_viewport_size({"width": size[0], "height": size[1]})
    tab.page.wait_for_function("([width, height]) => innerWidth === width && innerHeight === height", arg=list(size))


def overflowing(tab, size):
    """What is cut or sticks out of its region in a window of this size."""
    resized(tab, size)
    return tab.page.evaluate(
        """() => {
            const parts = ".panel, .who, summary, .header, .stop, .stop *, .action, .light-words, .verdict *, .pad *";
            const regions = ".stop, .verdict, .guide, .side, .pad, .header, .scene, .main, body";
            const seen = [...document.querySelectorAll(parts)].filter((e) => e.checkVisibility()
                && e.namespaceURI.endsWith("xhtml") && !e.matches(".unseen"));
            const cut = seen.filter((e) => e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1);
            const out = seen.filter((e) => {
                const [own, region] = [e, e.parentElement.closest(regions)].map((of) => of.getBoundingClientRect());
                return own.left < region.left - 1 || own.right > region.right + 1
                    || own.top < region.top - 1 || own.bottom > region.bottom + 1;
            });
            return [...cut, ...out].filter((e) => getComputedStyle(e).display !== "inline").map((e) => e.className);
        }"""
    )


@pytest.mark.undrawn
@pytest.mark.parametrize("size", SIZES)
def test_everything_fits_without_scrolling(viewed, size):
    assert overflowing(viewed, size) == []


@pytest.mark.undrawn
@pytest.mark.parametrize("size", ONE_COLUMN)
def test_a_small_window_scrolls_down_and_never_sideways_and_keeps_the_stop_in_reach(viewed, size):
    resized(viewed, size)
    width, height, content = viewed.page.evaluate(
        "[document.body.scrollWidth, document.body.scrollHeight, Math.max(...[...document.querySelectorAll('.main *')]"
        ".filter((e) => e.checkVisibility()).map((e) => e.getBoundingClientRect().right))]"
    )
    assert width <= size[0]
    assert content <= size[0]
    assert height > size[1]
    for place in (0, height):
        viewed.page.evaluate("(to) => document.body.scrollTo(0, to)", place)
        box = viewed.page.locator(".stop-button").bounding_box()
        assert box["y"] >= 0
        assert box["y"] + box["height"] <= size[1]


@pytest.mark.undrawn
@pytest.mark.parametrize("size", [(1600, 900), *ONE_COLUMN])
def test_the_view_comes_first_and_what_to_do_is_seen_with_it(viewed, size):
    resized(viewed, size)
    scene, guide = (viewed.page.locator(region).bounding_box() for region in (".scene", ".guide"))
    assert scene["y"] <= guide["y"] + 1
    if size[0] >= 1000:
        assert 0.6 < scene["width"] / size[0] < 0.7


@pytest.mark.undrawn
@pytest.mark.parametrize(
    ("stop", "shown"),
    [
        ({"released_by": "annamaria", "standing": True}, ".stop-released:has-text('annamaria')"),
        (
            {"emergency_stop": True, "by": "annamaria", "reason": "pressed at station-9b7a", "standing": True},
            ".stopped",
        ),
        ({"emergency_stop": True, "by": "annamaria", "reason": "pressed at station-9b7a"}, ".unconfirmed"),
    ],
    ids=["released", "stopped", "unconfirmed"],
)
@pytest.mark.parametrize("size", SIZES)
def test_a_stop_and_what_was_touched_are_said_in_full(viewed, station, size, stop, shown):
    _, feed = station
    safety = messages.SafetyState(**{"emergency_stop": False, "at": "2026-11-25T22:00:05Z", **stop})
    touched = {"collision": True, "collision_position": (0.55, -0.12, 0.56), "collision_force": 112.4}
    verdict = msgspec.structs.replace(feed.view.verdict, object_displacement=(0.412, 0.0, 0.0), **touched)
    feed.view = replace(feed.view, safety=safety, verdict=verdict)
    viewed.wait(f"{shown}:visible")
    viewed.wait("[data-value=collision-evidence]:has-text('112.4 N')")
    assert overflowing(viewed, size) == []


@pytest.mark.parametrize(
    ("light", "word"), [(Light.RED, "Watch"), (Light.AMBER, "Wait"), (Light.HOLD, "Paused"), (Light.GREEN, "Your turn")]
)
def test_the_traffic_light_follows_the_view(viewed, station, light, word):
    _, feed = station
    feed.view = replace(feed.view, teaching=msgspec.structs.replace(feed.view.teaching, light=light, text="so it is"))
    viewed.page.wait_for_selector(".light-text:text-is('so it is')")
    viewed.page.wait_for_selector(f".light[data-light={light.value}] .light-word:text-is('{word}')")


def test_the_counters_follow_the_view(viewed, station):
    _, feed = station
    feed.view = replace(feed.view, teaching=msgspec.structs.replace(feed.view.teaching, refinements=4, updates=2))
    viewed.page.wait_for_selector("[data-counter=refinements] .counter-value:text-is('4 of 10')")
    viewed.page.wait_for_selector("[data-counter=updates] .counter-value:text-is('2 of 8')")


def test_an_allowed_button_arrives_and_another_cannot_be_pressed(tab, clicked):
    assert tab.page.locator("[data-action=execute]").is_disabled()
    tab.page.evaluate("document.querySelector('[data-action=execute]').click()")
    assert clicked("[data-action=teach]") == [Press("teach")]


def test_where_little_is_known_it_is_said_and_what_is_recommended_stands_out(tab, station):
    _, feed = station
    asking = {
        "phase": "deciding",
        "text": "I don't know this place (12 % known, way 2 of 2, 55 %): show me the motion.",
        "actions": ("end", "execute", "next", "refine", "teach"),
        "recommended": "refine",
    }
    hardly_known = msgspec.structs.replace(feed.view.prediction, known=0.12)
    feed.view = replace(
        feed.view, teaching=msgspec.structs.replace(feed.view.teaching, **asking), prediction=hardly_known
    )
    tab.page.wait_for_selector('.light-text:has-text("I don\'t know this place")')
    tab.page.click(".health > summary")
    tab.page.wait_for_selector("[data-value=figure-prediction][data-tone=warn]:text-is('12 % known, way 2 of 2, 80 %')")
    tab.wait(".first .action[data-action=refine][data-first=yes]:enabled:has-text('Show me')")
    tab.wait(".others .action[data-action=execute][data-first=no]:enabled")


def test_stale_data_is_shown(viewed, station):
    _, feed = station
    viewed.page.wait_for_selector(".health[data-tone=good]")
    feed.view = replace(feed.view, robot_age_s=1.4, cameras={"head": Picture(b"", 1.4)})
    viewed.page.wait_for_selector(".health[data-tone=bad]")
    viewed.page.wait_for_selector(".scene-stale:visible")
    feed.view = replace(feed.view, robot=None, robot_age_s=math.inf)
    viewed.page.wait_for_selector(".scene-stale:text-is('Robot data has not come yet')")


def test_a_camera_that_falls_silent_is_shown_as_stale(tab, filmed):
    tab.page.wait_for_selector("[data-camera=wrist][data-state=live]")
    filmed.moving_pictures = False
    tab.page.wait_for_selector("[data-camera=wrist][data-state=stale]")


def test_a_port_in_use_is_one_line_that_names_port_and_setting():
    from harness import described

    from services.station.page.page import Page

    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        page = Page(StationSection(port=port), "robot1", SystemClock(), described())
        with pytest.raises(PortInUse, match=rf"127\.0\.0\.1:{port}.*\[station\] port") as caught:
            page.start()
    assert "\n" not in str(caught.value)
    page.close()


def test_sigterm_ends_it_within_two_seconds_and_it_writes_nothing(browser, tmp_path):
    port = free_port()
    process = subprocess.Popen([sys.executable, HARNESS, str(port)], cwd=tmp_path, stdout=subprocess.PIPE)
    try:
        assert process.stdout.readline() == b"ready\n"
        looking_on = browser.new_page()
        looking_on.goto(f"http://127.0.0.1:{port}/")
        looking_on.wait_for_selector("body[data-link=armed]")
        started = time.monotonic()
        process.send_signal(signal.SIGTERM)
        assert process.wait(5.0) == 0
        assert time.monotonic() - started < 2.0
        looking_on.wait_for_selector("body[data-link=offline] .banner-offline:visible")
        looking_on.close()
    finally:
        process.kill()
        process.stdout.close()
    assert list(tmp_path.iterdir()) == []
