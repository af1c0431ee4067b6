"""One real page for all browser tests, and a fresh tab for each."""

import socket
import sys
import time
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).parent))

WITHIN_S = 5.0


def _free_port():
    with socket.create_server(("127.0.0.1", 0)) as probe:
        return probe.getsockname()[1]


@pytest.fixture(scope="session")
def free_port():
    """A function that finds a port where nobody listens."""
    return _free_port


@pytest.fixture(scope="session")
def eventually():
    """A function that waits until a condition holds, and fails where it does not within a few seconds."""

    def wait(condition, within_s=WITHIN_S):
        deadline = time.monotonic() + within_s
        while not condition():
            assert time.monotonic() < deadline, "did not happen in time"
            time.sleep(0.005)

    return wait


@pytest.fixture(scope="session")
def station():
    """A page that is served, and its feed."""
    pytest.importorskip("nicegui")
    from harness import Feed, working_view

    from services.process.clock import SystemClock
    from services.process.config import StationSection
    from services.station.page.page import Page

    page = Page(StationSection(port=_free_port()), "robot1", SystemClock())
    page.start()
    feed = Feed(page, working_view())
    feed.start()
    yield page, feed
    feed.close()
    page.close()


class Tab:
    """A browser tab with the page open, and what it complained about or asked for."""

    def __init__(self, browser, url):
        self.faults = []
        self.requests = []
        self.page = browser.new_page(viewport={"width": 1600, "height": 900})
        self.page.on("console", lambda message: self.faults.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        self.page.goto(url)
        self.page.wait_for_selector("body[data-link]")

    @property
    def link(self):
        return self.page.evaluate("document.body.dataset.link")


@pytest.fixture
def open_tab(browser, station):
    """A function that opens another tab."""
    tabs = []

    def open_one():
        tabs.append(Tab(browser, station[0].url))
        return tabs[-1]

    yield open_one
    for tab in tabs:
        tab.page.close()


@pytest.fixture
def tab(station, open_tab, eventually):
    """A tab that has the input, of a station where everything works."""
    from harness import working_view

    page, feed = station
    feed.view = working_view()
    eventually(lambda: page.figures()[0].value == 0)
    opened = open_tab()
    eventually(lambda: page.take_input().focused)
    page.take_actions()
    return opened
