"""The live view's frame on the operator's page: where it is, what its keys do, and that nothing starts it anew."""

from dataclasses import replace
from urllib.parse import urlsplit

import msgspec
import pytest
from frame import Frame

from protocol.messages import Recording
from services.process.clock import SystemClock
from tests.ports import free_port

pytestmark = pytest.mark.browser


@pytest.fixture
def serve_frame(tmp_path):
    """A function that serves a live view on an address of this machine."""
    served = []

    def serve(host):
        served.append(Frame(tmp_path, host, free_port()))
        return served[-1]

    yield serve
    for frame in served:
        frame.close()


@pytest.fixture
def frame(serve_frame):
    """A live view that is served to its own machine."""
    return serve_frame("127.0.0.1")


@pytest.fixture
def recording(frame):
    return Recording(path="a.rrd", viewer_url=frame.url, recording_id="first")


@pytest.fixture
def view(tab, station, recording):
    """The frame's content, loaded."""
    _, feed = station
    feed.view = replace(feed.view, recording=recording)
    return loaded(tab)


def loaded(tab):
    """The content of a tab's frame, once its script listens."""
    content = tab.page.wait_for_selector("iframe.viewer").content_frame()
    content.wait_for_selector("#view")
    content.wait_for_load_state("domcontentloaded")
    return content


def say_key(view, kind, **fields):
    view.evaluate(
        "([kind, fields]) => document.body.dispatchEvent(new KeyboardEvent(kind, {bubbles: true, ...fields}))",
        [kind, fields],
    )


def test_it_has_another_name_than_the_page_on_the_same_machine(view):
    assert urlsplit(view.url).hostname == "localhost"


def test_its_keys_steer_and_those_of_strangers_do_not(tab, view):
    tab.page.evaluate("window.postMessage({kind: 'key', code: 'KeyW', key: 'w', down: true}, '*')")
    say_key(view, "keydown", code="KeyD", key="d")
    tab.wait("[data-key=KeyD][data-held]")
    assert tab.page.locator("[data-key=KeyW][data-held]").count() == 0
    say_key(view, "keyup", code="KeyD", key="d")
    tab.wait(".station:not(:has([data-held]))")


@pytest.mark.parametrize(
    "event",
    [
        {"code": "Escape", "key": "Escape"},
        {"code": "Escape", "key": "Escape", "ctrlKey": True, "altKey": True, "shiftKey": True, "metaKey": True},
        {"code": "", "key": "Escape"},
        {"code": "", "key": "Unidentified", "keyCode": 27},
        {"code": "Escape", "key": "Escape", "repeat": True},
    ],
)
def test_escape_in_it_stops(view, pressed, event):
    say_key(view, "keydown", **event)
    assert pressed() == ["stop"]


def test_escape_stops_where_it_has_the_focus(view, pressed):
    view.focus("#view")
    view.page.keyboard.press("Control+Escape")
    assert pressed() == ["stop"]


def test_another_recording_loads_it_anew(tab, view, station, recording):
    _, feed = station
    feed.view = replace(feed.view, recording=msgspec.structs.replace(recording, recording_id="second"))
    tab.wait("iframe[data-recording=second]")
    assert tab.page.locator("iframe").count() == 1
    feed.view = replace(feed.view, recording=None)
    tab.wait(".scene-empty:visible")


def test_what_is_no_address_is_not_loaded(tab, station, recording):
    _, feed = station
    feed.view = replace(
        feed.view, recording=msgspec.structs.replace(recording, viewer_url="javascript:alert(1)"), notice="it came"
    )
    tab.wait(".notice:text-is('it came')")
    assert tab.page.locator("iframe").count() == 0


def test_a_lost_link_neither_loads_the_page_anew_nor_the_view(open_seated, station, recording, cable):
    _, feed = station
    tab = open_seated(cable.url)
    feed.view = replace(feed.view, recording=recording)
    loaded(tab)
    tab.page.evaluate("window.loadedOnce = true")
    for lost in (True, False):
        cable.cut()
        tab.wait("body[data-link=offline]")
        cable.mend(lost=lost)
        tab.wait("body[data-link=armed]")
    feed.view = replace(feed.view, notice="the link is back")
    tab.wait(".notice:text-is('the link is back')")
    assert tab.page.evaluate("window.loadedOnce")
    assert sum(url.endswith("/re_viewer.js") for url in tab.requests) == 1


@pytest.fixture
def open_station():
    """A station that listens on every address: its port and its feed."""
    from harness import Feed, working_view

    from services.process.config import StationSection
    from services.station.page.page import Page

    port = free_port()
    page = Page(StationSection(host="0.0.0.0", port=port), "robot1", SystemClock())
    page.start()
    feed = Feed(page, working_view())
    feed.start()
    yield port, feed
    feed.close()
    page.close()


@pytest.mark.parametrize("name", ["127.0.0.2", "tablet.localhost"])
def test_it_is_seen_from_another_machine_by_the_name_that_its_browser_uses(open_station, open_tab, serve_frame, name):
    port, feed = open_station
    recording = Recording(path="a.rrd", viewer_url=serve_frame("0.0.0.0").url, recording_id="first")
    feed.view = replace(feed.view, recording=recording)
    tab = open_tab(f"http://{name}:{port}/")
    content = loaded(tab)
    assert urlsplit(content.url).hostname == name
    assert tab.faults == []
    say_key(content, "keydown", code="KeyD", key="d")
    tab.wait("[data-key=KeyD][data-held]")


def test_it_is_seen_under_the_address_on_which_alone_it_is_served(open_station, open_tab, serve_frame):
    port, feed = open_station
    recording = Recording(path="a.rrd", viewer_url=serve_frame("127.0.0.2").url, recording_id="first")
    feed.view = replace(feed.view, recording=recording)
    tab = open_tab(f"http://tablet.localhost:{port}/")
    content = loaded(tab)
    assert urlsplit(content.url).hostname == "127.0.0.2"
    assert tab.faults == []


def test_where_only_its_own_computer_can_see_it_the_page_says_so(open_station, open_tab, recording):
    port, feed = open_station
    feed.view = replace(feed.view, recording=recording)
    tab = open_tab(f"http://tablet.localhost:{port}/")
    tab.wait(".scene-empty-text:visible:has-text('[viewer] host')")
    assert tab.page.locator("iframe").count() == 0
