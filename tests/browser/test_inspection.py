"""The way from the operator's page to the viewer's, which is a tab of its own."""

from dataclasses import replace
from urllib.parse import urlsplit

import pytest

from protocol.messages import Recording
from tests.ports import free_port

pytestmark = pytest.mark.browser

LINK = "a.inspect"


def recording(url):
    return Recording(path="a.rrd", viewer_url=url, recording_id="first")


def address(tab):
    """Where the link leads, once it is there."""
    tab.wait(f"{LINK}[href]")
    return urlsplit(tab.page.get_attribute(LINK, "href"))


@pytest.fixture
def open_station():
    """A station that listens on every address: its port and its feed."""
    from harness import served

    port = free_port()
    with served(host="0.0.0.0", port=port) as (_, feed):
        yield port, feed


def test_without_a_viewer_there_is_no_way_to_it(tab, station):
    _, feed = station
    assert not tab.shows(LINK)
    feed.view = replace(feed.view, recording=recording("http://127.0.0.1:9090/"))
    address(tab)
    feed.view = replace(feed.view, recording=None)
    tab.wait(LINK, "hidden")


def test_it_opens_a_tab_of_its_own_under_another_name_and_leaves_the_page_as_it_is(tab, station):
    _, feed = station
    feed.view = replace(feed.view, recording=recording(f"http://127.0.0.1:{free_port()}/"))
    assert address(tab).hostname == "localhost"
    tab.page.evaluate("window.loadedOnce = true")
    with tab.page.expect_popup() as opened:
        tab.page.click(LINK)
    opened.value.close()
    assert tab.page.evaluate("window.loadedOnce && window.length === 0")


def test_what_is_no_address_is_no_link(tab, station):
    _, feed = station
    feed.view = replace(feed.view, recording=recording("javascript:alert(1)"), notice="it came")
    tab.wait(".notice:text-is('it came')")
    assert not tab.shows(LINK)


@pytest.mark.parametrize(
    ("viewer", "name", "leads_to"),
    [
        ("0.0.0.0", "127.0.0.2", "127.0.0.2"),
        ("0.0.0.0", "tablet.localhost", "tablet.localhost"),
        ("127.0.0.2", "tablet.localhost", "127.0.0.2"),
    ],
)
def test_it_leads_where_this_browser_finds_the_viewer(open_station, open_tab, viewer, name, leads_to):
    port, feed = open_station
    feed.view = replace(feed.view, recording=recording(f"http://{viewer}:9090/"))
    assert address(open_tab(f"http://{name}:{port}/")).hostname == leads_to


def test_where_only_its_own_computer_can_see_it_the_page_says_so(open_station, open_tab):
    port, feed = open_station
    feed.view = replace(feed.view, recording=recording("http://127.0.0.1:9090/"))
    tab = open_tab(f"http://tablet.localhost:{port}/")
    tab.wait(f"{LINK}[title*='[viewer] host']")
    assert tab.page.get_attribute(LINK, "href") is None
