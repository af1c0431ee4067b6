"""The operator's page in a real browser."""

import http.server
import math
import signal
import socket
import subprocess
import sys
import threading
import time
from dataclasses import replace
from pathlib import Path
from urllib.parse import urlsplit

import msgspec
import pytest

from protocol.messages import Light, Recording, SafetyState
from services.process.clock import SystemClock
from services.process.config import StationSection
from services.process.exceptions import PortInUse

pytestmark = pytest.mark.browser

HARNESS = Path(__file__).parent / "harness.py"

VIEWER = b"""<!doctype html><script>
document.addEventListener("keydown", (event) => parent.postMessage({kind: "key", code: event.code, down: true}, "*"));
document.addEventListener("keyup", (event) => parent.postMessage({kind: "key", code: event.code, down: false}, "*"));
</script>live view"""


@pytest.fixture
def viewer():
    """Something on another port that posts its keys as the viewer's page does."""

    class Handler(http.server.BaseHTTPRequestHandler):
        def do_GET(self):
            self.send_response(200)
            self.send_header("Content-Type", "text/html")
            self.end_headers()
            self.wfile.write(VIEWER)

        def log_message(self, *arguments):
            pass

    with http.server.ThreadingHTTPServer(("127.0.0.1", 0), Handler) as server:
        threading.Thread(target=server.serve_forever, daemon=True).start()
        yield f"http://127.0.0.1:{server.server_address[1]}/"
        server.shutdown()


def test_loads_without_a_fault_and_asks_nobody_else(tab):
    tab.page.wait_for_selector(".camera[data-state=live]")
    asked = {urlsplit(url).hostname for url in tab.requests if not url.startswith(("data:", "blob:"))}
    assert asked == {"127.0.0.1"}
    assert tab.faults == []


@pytest.mark.parametrize("size", [(1600, 900), (1280, 720)])
def test_everything_fits_without_scrolling(tab, size):
    tab.page.set_viewport_size({"width": size[0], "height": size[1]})
    overflowing = tab.page.evaluate(
        """() => [...document.querySelectorAll(".panel, .chip, .header, .stop, .action, .light-words")]
        .filter((e) => e.scrollWidth > e.clientWidth + 1 || e.scrollHeight > e.clientHeight + 1)
        .map((e) => e.className)"""
    )
    assert overflowing == []
    box = tab.page.locator(".stop").bounding_box()
    assert box["x"] + box["width"] <= size[0]
    assert box["y"] + box["height"] <= size[1]


def test_a_held_key_arrives_lights_up_and_goes(tab, station, eventually):
    page, _ = station
    tab.page.keyboard.down("KeyE")
    eventually(lambda: page.take_input().keys == ("KeyE",))
    assert tab.page.locator("[data-key=KeyE][data-held]").count() == 1
    tab.page.keyboard.down("KeyQ")
    eventually(lambda: set(page.take_input().keys) == {"KeyE", "KeyQ"})
    tab.page.keyboard.up("KeyE")
    tab.page.keyboard.up("KeyQ")
    eventually(lambda: page.take_input().keys == ())
    assert tab.page.locator("[data-held]").count() == 0


def test_the_keys_that_turn_lie_beside_those_that_push(tab, station, eventually):
    page, _ = station
    places = {code: tab.page.locator(f"[data-key=Key{code}]").bounding_box() for code in "QWERTYASDFGH"}
    for row in ("QWERTY", "ASDFGH"):
        assert [places[code]["x"] for code in row] == sorted(places[code]["x"] for code in row)
        assert len({places[code]["y"] for code in row}) == 1
    for code in "RFTGYH":
        tab.page.keyboard.down(f"Key{code}")
        eventually(lambda code=code: page.take_input().keys == (f"Key{code}",))
        assert tab.page.locator(f"[data-key=Key{code}][data-held]").count() == 1
        tab.page.keyboard.up(f"Key{code}")
        eventually(lambda: page.take_input().keys == ())


def test_a_held_key_goes_with_the_focus(tab, station, eventually):
    page, _ = station
    tab.page.keyboard.down("KeyE")
    eventually(lambda: page.take_input().keys == ("KeyE",))
    tab.page.evaluate("window.dispatchEvent(new Event('blur'))")
    eventually(lambda: page.take_input().keys == ())


def test_a_held_key_goes_with_the_tab(tab, station, eventually):
    page, _ = station
    tab.page.keyboard.down("KeyE")
    eventually(lambda: page.take_input().keys == ("KeyE",))
    tab.page.close()
    eventually(lambda: page.take_input().keys == () and not page.take_input().focused)


def test_a_held_key_goes_when_the_browser_hangs_and_needs_to_be_let_go(tab, station, eventually):
    page, _ = station
    tab.page.keyboard.down("KeyE")
    eventually(lambda: page.take_input().keys == ("KeyE",))
    tab.page.evaluate("setTimeout(() => { const end = performance.now() + 600; while (performance.now() < end); }, 0)")
    eventually(lambda: not page.take_input().focused)
    eventually(lambda: page.take_input().focused)
    assert page.take_input().keys == ()
    tab.page.wait_for_selector("body[data-let-go]")
    tab.page.keyboard.up("KeyE")
    tab.page.keyboard.down("KeyE")
    eventually(lambda: page.take_input().keys == ("KeyE",))


def test_keys_of_the_live_view_count_and_those_of_strangers_do_not(tab, station, viewer, eventually):
    page, feed = station
    feed.view = replace(feed.view, recording=Recording(path="a.rrd", viewer_url=viewer, recording_id="first"))
    frame = tab.page.wait_for_selector("iframe.viewer").content_frame()
    frame.wait_for_url(lambda url: urlsplit(url).hostname == "localhost")
    tab.page.evaluate("window.postMessage({kind: 'key', code: 'KeyW', down: true}, '*')")
    frame.wait_for_load_state()
    frame.evaluate("document.dispatchEvent(new KeyboardEvent('keydown', {code: 'KeyD'}))")
    eventually(lambda: page.take_input().keys == ("KeyD",))
    frame.evaluate("document.dispatchEvent(new KeyboardEvent('keyup', {code: 'KeyD'}))")
    eventually(lambda: page.take_input().keys == ())


def test_another_recording_loads_the_live_view_anew(tab, station, viewer):
    _, feed = station
    recording = Recording(path="a.rrd", viewer_url=viewer, recording_id="first")
    feed.view = replace(feed.view, recording=recording)
    tab.page.wait_for_selector("iframe[data-recording=first]")
    feed.view = replace(feed.view, recording=msgspec.structs.replace(recording, recording_id="second"))
    tab.page.wait_for_selector("iframe[data-recording=second]")
    assert tab.page.locator("iframe").count() == 1
    feed.view = replace(feed.view, recording=None)
    tab.page.wait_for_selector(".scene-empty:visible")


@pytest.mark.parametrize(("light", "word"), [(Light.RED, "Watch"), (Light.AMBER, "Wait"), (Light.GREEN, "Act")])
def test_the_traffic_light_follows_the_view(tab, station, light, word):
    _, feed = station
    feed.view = replace(feed.view, teaching=msgspec.structs.replace(feed.view.teaching, light=light, text="so it is"))
    tab.page.wait_for_selector(".light-text:text-is('so it is')")
    tab.page.wait_for_selector(f".light[data-light={light.value}] .light-word:text-is('{word}')")


def test_the_counters_follow_the_view(tab, station):
    _, feed = station
    feed.view = replace(feed.view, teaching=msgspec.structs.replace(feed.view.teaching, refinements=4, updates=2))
    tab.page.wait_for_selector("[data-counter=refinements] .counter-value:text-is('4 / 10')")
    tab.page.wait_for_selector("[data-counter=updates] .counter-value:text-is('2 / 8')")


def test_an_allowed_button_arrives_and_another_cannot_be_pressed(tab, station, eventually):
    page, _ = station
    assert tab.page.locator("[data-action=execute]").is_disabled()
    tab.page.locator("[data-action=execute]").click(force=True)
    tab.page.click("[data-action=undo]")
    taken = []
    eventually(lambda: taken.extend(page.take_actions()) or taken)
    assert taken == ["undo"]


def test_the_space_bar_finishes(tab, station, eventually):
    page, _ = station
    tab.page.keyboard.press("Space")
    eventually(lambda: page.take_actions() == ["finish"])


def test_the_emergency_stop_arrives_by_button_and_by_key(tab, station, eventually):
    page, _ = station
    tab.page.click("[data-action=stop]")
    eventually(lambda: page.take_actions() == ["stop"])
    tab.page.keyboard.press("Escape")
    eventually(lambda: page.take_actions() == ["stop"])


def test_a_latched_stop_is_shown_and_can_be_released(tab, station, eventually):
    page, feed = station
    stopped = SafetyState(emergency_stop=True, by="anna", reason="pressed on the page")
    feed.view = replace(feed.view, safety=stopped)
    tab.page.wait_for_selector(".stopped:visible")
    assert tab.page.inner_text(".stopped-reason") == "anna: pressed on the page"
    tab.page.click("[data-action=release_stop]")
    eventually(lambda: page.take_actions() == ["release_stop"])


def test_stale_data_is_shown(tab, station):
    _, feed = station
    tab.page.wait_for_selector("[data-chip=age][data-tone=good]")
    feed.view = replace(feed.view, robot_age_s=1.4, head=replace(feed.view.head, jpeg=b"", age_s=1.4))
    tab.page.wait_for_selector("[data-chip=age][data-tone=bad]")
    tab.page.wait_for_selector(".scene-stale:visible")
    feed.view = replace(feed.view, robot=None, robot_age_s=math.inf)
    tab.page.wait_for_selector(".scene-stale:text-is('Robot data has not come yet')")


def test_a_camera_that_falls_silent_is_shown_as_stale(tab):
    tab.page.wait_for_selector("[data-camera=wrist][data-state=live]")
    tab.page.wait_for_selector("[data-camera=wrist][data-state=stale]", timeout=5_000)


def test_a_second_tab_looks_on_until_it_takes_the_input(tab, open_tab, station, eventually):
    page, _ = station
    second = open_tab()
    assert second.link == "view-only"
    assert tab.link == "armed"
    second.page.click("[data-take-input]")
    eventually(lambda: second.link == "armed")
    eventually(lambda: tab.link == "view-only")
    second.page.keyboard.down("KeyA")
    eventually(lambda: page.take_input().keys == ("KeyA",))


def test_a_stranger_s_page_cannot_open_the_link(browser, station):
    page, _ = station
    stranger = browser.new_page()
    opened = stranger.evaluate(
        """(url) => new Promise((done) => {
            const socket = new WebSocket(url);
            socket.onopen = () => done(true);
            socket.onerror = () => done(false);
        })""",
        page.url.replace("http", "ws") + "/link",
    )
    stranger.close()
    assert not opened


def test_a_port_in_use_is_one_line_that_names_port_and_setting():
    from services.station.page.page import Page

    with socket.create_server(("127.0.0.1", 0)) as other:
        port = other.getsockname()[1]
        page = Page(StationSection(port=port), "robot1", SystemClock())
        with pytest.raises(PortInUse, match=rf"127\.0\.0\.1:{port}.*\[station\] port") as caught:
            page.start()
    assert "\n" not in str(caught.value)
    page.close()


def test_sigterm_ends_it_within_two_seconds_and_it_writes_nothing(browser, free_port, tmp_path):
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
