"""One real page for all browser tests, and a fresh tab for each."""

import contextlib
import sys
import time
from pathlib import Path

import pytest

from tests.ports import free_port

sys.path.insert(0, str(Path(__file__).parent))

WITHIN_S = 20.0
HEARD_WITHIN_S = 1.5
POLL_S = 0.02
SEAT = "the-seat-of-all-tests"
SIZE = {"width": 1600, "height": 900}
UNDRAWN = """
    const get = HTMLCanvasElement.prototype.getContext;
    HTMLCanvasElement.prototype.getContext = function (kind, ...rest) {
        return kind === "webgl2" ? null : get.call(this, kind, ...rest);
    };
"""
"""As in a browser that cannot draw in three dimensions."""


def pytest_addoption(parser):
    """Where to write the documentation's pictures."""
    parser.addoption("--pictures", help="folder to write the pictures of all states to")


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
    pytest.importorskip("uvicorn")
    from harness import served

    with served(port=free_port()) as (page, feed):
        yield page, feed


class Tab:
    """A browser tab with the page open, and what it complained about or asked for.

    Args:
        page: to open it in.
        url: of the page.
        seat: by which the station knows the tab again; its own where there is none.
        script: run in the page before any other; the tour was seen already, where it says nothing else.
    """

    def __init__(self, page, url, seat=None, script=""):
        self.faults = []
        self.requests = []
        self.page = page
        self.page.on("console", lambda message: self.faults.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        seated = f"sessionStorage.setItem('retouch-seat', '{seat}');" if seat else ""
        toured = "localStorage.setItem('retouch-tour', 'seen');"
        self.page.add_init_script(f"if (window === window.top) {{ {toured} {seated} {script} }}")
        self.page.goto(url)
        self.page.wait_for_selector("body:not([data-link=offline])")

    def wait(self, selector, state="visible"):
        """Wait for an element: what the page shows comes to each tab in its own time."""
        self.page.wait_for_selector(selector, state=state, timeout=WITHIN_S * 1e3)

    def press(self, action, seen):
        """Press a button until `seen()`; as a person does, again where the press came too late to be done."""
        from playwright.sync_api import TimeoutError as NotThere

        deadline = time.monotonic() + WITHIN_S
        while True:
            with contextlib.suppress(NotThere):  # it may be gone meanwhile: what it asks for is done
                self.page.click(f"[data-action={action}]:enabled", timeout=HEARD_WITHIN_S * 1e3)
            pressed = time.monotonic()
            while time.monotonic() < pressed + HEARD_WITHIN_S:
                if seen():
                    return
                self.page.wait_for_timeout(POLL_S * 1e3)
            assert time.monotonic() < deadline, f"{action} does not count"

    def close(self):
        """Close it, and leave nothing behind that the page would remember."""
        from playwright.sync_api import Error as Gone

        with contextlib.suppress(Gone):  # the page may never have come
            self.page.evaluate("localStorage.clear()")
        self.page.close()

    def shows(self, selector):
        """Whether an element is seen now."""
        return self.page.locator(selector).locator("visible=true").count() > 0


@pytest.fixture(scope="session")
def window(browser):
    """Where the first tab of every test opens: a profile of its own takes as long to make as the page to load."""
    context = browser.new_context(viewport=SIZE, color_scheme="dark")
    yield context
    context.close()


@pytest.fixture
def open_tab(request, browser, window, station):
    """A function that opens another tab, in a window of its own: of one window only one tab is seen at a time."""
    tabs = []
    drawn = "" if request.node.get_closest_marker("undrawn") is None else UNDRAWN

    def open_one(url=None, script="", **options):
        page = browser.new_page(viewport=SIZE) if tabs else window.new_page()
        tabs.append(Tab(page, url or station[0].url, script=drawn + script, **options))
        return tabs[-1]

    yield open_one
    for tab in tabs:
        tab.close()


@pytest.fixture
def calm_station(station, eventually):
    """A station where everything works, no tab is open and nothing waits."""
    from harness import confirmed_view, working_view

    page, feed = station
    eventually(lambda: page.figures()[0].value == 0)
    feed.view = confirmed_view()
    eventually(lambda: not page.take_presses())
    page.show(feed.view)
    feed.view = working_view()
    return station


@pytest.fixture
def open_seated(calm_station, open_tab, eventually):
    """A function that opens the tab that has the input: the same one in every test, since nobody inherits a seat."""

    def open_one(url=None, **options):
        opened = open_tab(url, seat=SEAT, **options)
        opened.wait("body[data-link=armed]")
        eventually(lambda: calm_station[0].take_input().focused)
        return opened

    return open_one


@pytest.fixture
def tab(open_seated):
    """A tab that has the input, of a station where everything works."""
    return open_seated()


@pytest.fixture
def hand(tab, station):
    """A hand on the keys of the tab that has the input."""
    from hand import Hand

    return Hand(tab, station[0], WITHIN_S)


@pytest.fixture
def presses(station, eventually):
    """A function that waits for presses to arrive, and says which did."""

    def wait():
        taken = []
        eventually(lambda: taken.extend(station[0].take_presses()) or taken)
        return taken

    return wait


@pytest.fixture
def pressed(presses):
    """A function that waits for presses to arrive, and says what was pressed."""
    return lambda: [press.action for press in presses()]


@pytest.fixture
def cable(station):
    """What lies between a browser and the station, to be cut."""
    from cable import Cable

    between = Cable(int(station[0].url.rpartition(":")[2]))
    yield between
    between.close()
