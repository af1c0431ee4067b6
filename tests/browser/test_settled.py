"""A run that was set beforehand, in a study's frame: what its operator cannot choose is not there."""

from dataclasses import replace

import pytest

pytest.importorskip("uvicorn")

from protocol.messages import MasterState, Method
from tests.ports import free_port

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

CHOSEN = (
    "[data-action=method]",
    "[data-action=pause]",
    ".pace-knob",
    ".confidence",
    ".entry",
    ".device-tab",
    ".who-form",
)
"""What changes how, how fast and by whom is taught, or takes back what was learnt."""

NEEDED = (".actions", ".timeline-bar", ".verdict", ".counters", ".key-cap", ".stop-button", ".health", ".tour-open")


@pytest.fixture
def settled():
    """A page as a study has it, and its feed."""
    from harness import served

    given = {"method": Method.REFINE, "basis": "model", "place": (0.86, 0.06, 0.553), "fixed": True}
    with served(port=free_port(), framed_by="http://127.0.0.1:9", **given) as (page, feed):
        yield page, feed


def test_what_is_not_the_operators_choice_is_not_there(settled, viewed, open_tab):
    tab = open_tab(settled[0].url)
    tab.wait("body[data-link=armed]")
    for one in (viewed, tab):
        one.page.click(".who > summary")
    assert [what for what in CHOSEN if not viewed.shows(what)] == []
    assert [what for what in CHOSEN if tab.shows(what)] == []
    assert [what for what in NEEDED if not tab.shows(what)] == []
    viewed.page.click(".who > summary")


@pytest.mark.parametrize("low", [{"width": 1280, "height": 650}, {"width": 1280, "height": 750}])
def test_how_many_attempts_are_left_is_seen_in_a_low_window_too(settled, open_tab, low):
    tab = open_tab(settled[0].url)
    tab.page.set_viewport_size(low)
    tab.wait("[data-counter=refinements]")
    tab.wait("[data-counter=updates]")


@pytest.mark.parametrize(("device", "pad"), [("pointer", ".pointer-pad"), ("stylus", ".device-other")])
def test_the_pad_of_the_one_device_is_there_from_the_beginning(settled, open_tab, device, pad):
    page, feed = settled
    feed.view = replace(feed.view, master=MasterState(device=device))
    tab = open_tab(page.url)
    tab.wait(pad)
    assert not tab.shows(".key-cap")


def test_who_comes_back_in_another_browser_has_the_seat_of_their_address(settled, open_tab):
    address = f"{settled[0].url}#seat={'5e' * 12}"
    open_tab(address).wait("body[data-link=armed]")
    open_tab(address).wait("body[data-link=armed]")
    stranger = open_tab(settled[0].url)
    stranger.wait("body[data-link=view-only]")


def test_what_somebody_has_seen_the_next_person_has_not(settled, open_tab):
    address = f"{settled[0].url}#person="
    tab = open_tab(address + "P01")
    tab.page.click(".tour-skip")
    tab.page.reload()
    tab.wait("body[data-link=armed]")
    assert not tab.shows(".tour")
    tab.page.goto("about:blank")  # the address of the next person differs by its end alone
    tab.page.goto(address + "P02")
    tab.wait(".tour:visible")
