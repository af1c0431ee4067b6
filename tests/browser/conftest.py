"""One real page for all browser tests, and a fresh tab for each."""

import contextlib
import sys
import time
from pathlib import Path

import pytest

from tests.browser import scripts
from tests.ports import free_port

sys.path.insert(0, str(Path(__file__).parent))

WITHIN_S = 20.0
OPENED_WITHIN_S = 90.0
HEARD_WITHIN_S = 1.5
POLL_S = 0.02
SIZE = {"width": 1600, "height": 900}


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
        seated: it has the seat of all tests, by which the station knows it again.
        script: run in the page before any other; the tour was seen already, where it says nothing else.
    """

    def __init__(self, page, url, *, seated=False, script=""):
        self.faults = []
        self.requests = []
        self.page = page
        self.page.on("console", lambda message: self.faults.append(message.text) if message.type == "error" else None)
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("request", lambda request: self.requests.append(request.url))
        seated = scripts.SEATED if seated else ""
        self.page.add_init_script(
            f"if (window === window.top) {{ {scripts.TOURED} {scripts.WATCHED} {seated} {script} }}"
        )
        self.page.goto(url, timeout=OPENED_WITHIN_S * 1e3)
        self.page.wait_for_selector("body:not([data-link=offline])", timeout=OPENED_WITHIN_S * 1e3)

    def wait(self, selector, state="visible"):
        """Wait for an element: what the page shows comes to each tab in its own time."""
        self.page.wait_for_selector(selector, state=state, timeout=WITHIN_S * 1e3)

    def press(self, action, seen):
        """Press an action's button until `seen()`."""
        self.click(f"[data-action={action}]:enabled", seen)

    def click(self, selector, seen):
        """Click until `seen()`; as a person does, again where the press came too late to be done."""
        from playwright.sync_api import TimeoutError as NotThere

        deadline = time.monotonic() + WITHIN_S
        while True:
            with contextlib.suppress(NotThere):  # it may be gone meanwhile: what it asks for is done
                self.page.click(selector, timeout=HEARD_WITHIN_S * 1e3)
            pressed = time.monotonic()
            while time.monotonic() < pressed + HEARD_WITHIN_S:
                if seen():
                    return
                self.page.wait_for_timeout(POLL_S * 1e3)
            assert time.monotonic() < deadline, f"{selector} does not count: {self.page.evaluate(scripts.TOLD)}"

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
    drawn = "" if request.node.get_closest_marker("undrawn") is None else scripts.UNDRAWN

    def open_one(url=None, script="", **options):
        page = browser.new_page(viewport=SIZE) if tabs else window.new_page()
        tabs.append(Tab(page, url or station[0].url, script=drawn + script, **options))
        return tabs[-1]

    yield open_one
    for tab in tabs:
        tab.close()


@pytest.fixture(scope="session")
def axe():
    """A function that says what axe-core finds in a page as it is."""
    found = pytest.importorskip("axe_playwright_python")
    source = (Path(found.__file__).parent / "axe.min.js").read_text(encoding="utf-8")

    def find(page):
        if not page.evaluate("'axe' in window"):
            page.evaluate(source)
        return page.evaluate(scripts.VIOLATIONS)

    return find


@pytest.fixture(scope="session")
def looked_at(window):
    """The tab that tests share which only look, by whether it draws; none while another test has the station."""
    del window  # it is closed after the tabs in it
    tabs = {}
    yield tabs
    for tab in tabs.values():
        tab.close()


@pytest.fixture
def calm_station(station, looked_at, eventually):
    """A station where everything works, no tab is open and nothing waits."""
    from harness import confirmed_view, working_view

    page, feed = station
    while looked_at:
        looked_at.popitem()[1].close()
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
        opened = open_tab(url, seated=True, **options)
        opened.wait("body[data-link=armed]")
        eventually(lambda: calm_station[0].take_input().focused)
        return opened

    return open_one


@pytest.fixture
def viewed(request, station, looked_at):
    """A tab that a test only looks at: opened once for all of these, since opening takes longer than looking.

    They may change what the station says, the window's size and what the browser prefers; they press nothing.
    """
    from harness import working_view

    drawn = request.node.get_closest_marker("undrawn") is None
    if drawn not in looked_at:
        request.getfixturevalue("calm_station")
        page, script = request.getfixturevalue("window").new_page(), "" if drawn else scripts.UNDRAWN
        looked_at[drawn] = Tab(page, station[0].url, seated=True, script=script)
        looked_at[drawn].wait("body[data-link=armed]")
    station[1].view = working_view()
    looked_at[drawn].page.set_viewport_size(SIZE)
    looked_at[drawn].page.emulate_media(color_scheme="dark")
    return looked_at[drawn]


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
def presses(request, station, eventually):
    """A function that waits for presses to arrive, and says which did."""

    page, _ = station

    def wait():
        taken = []
        try:
            eventually(lambda: taken.extend(page.take_presses()) or taken)
        except AssertionError as error:
            raise AssertionError(f"no press came; {whereabouts(request, page)}") from error
        return taken

    return wait


def whereabouts(request, page):
    """What became of a press that did not come: never made, made elsewhere, on its way, or refused."""
    tab = next((request.getfixturevalue(name) for name in ("tab", "viewed") if name in request.fixturenames), None)
    figures = {figure.name: figure.value for figure in page.figures()}
    return f"the station counted {figures}, the tab tells {tab.page.evaluate(scripts.TOLD) if tab else 'nothing'}"


@pytest.fixture
def pressed(presses):
    """A function that waits for presses to arrive, and says what was pressed."""
    return lambda: [press.action for press in presses()]


@pytest.fixture
def clicked(tab, station):
    """A function that clicks in the tab until a press arrives, and says which did."""

    def click(selector):
        taken = []
        tab.click(selector, lambda: taken.extend(station[0].take_presses()) or taken)
        return taken

    return click


@pytest.fixture
def cable(station):
    """What lies between a browser and the station, to be cut."""
    from cable import Cable

    between = Cable(int(station[0].url.rpartition(":")[2]))
    yield between
    between.close()


@pytest.fixture
def study(tmp_path):
    """A study that is served, with a stand-in for the robot; participant 1 is enrolled."""
    from tests.study_harness import served

    with served(tmp_path / "raw", free_port()) as one:
        one.desk.conductor.enrol(1, "en")
        yield one


@pytest.fixture
def visit(browser):
    """A function that opens an address in a browser of one's own, and what it complained of beside."""
    contexts = []

    def come(address, **options):
        contexts.append(browser.new_context(**{"viewport": {"width": 1280, "height": 720}, "locale": "en"} | options))
        contexts[-1].set_default_timeout(WITHIN_S * 1e3)
        tab = contexts[-1].new_page()
        tab.faults = []
        tab.on("pageerror", lambda error: tab.faults.append(str(error)))
        tab.goto(address)
        return tab

    yield come
    for context in contexts:
        context.close()
