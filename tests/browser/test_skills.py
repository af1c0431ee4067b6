"""The robot's skills on the page: which is in use, which can be chosen, and a new one by its name."""

from dataclasses import replace

import msgspec
import pytest

from protocol.messages import Method
from services.station.press import Press

OPENER = ".skills-open"


@pytest.fixture
def skilled(station, tab):
    """A page on which a skill can be chosen."""
    _, feed = station
    offered = ("execute", "skill", "new_skill")
    told = msgspec.structs.replace(feed.view.teaching, phase="deciding", actions=offered)
    feed.view = replace(feed.view, teaching=told)
    tab.wait(f"{OPENER}:has-text('dishwasher')")
    tab.page.click(OPENER)
    tab.wait(".skills-row:enabled")
    return tab


def row(name):
    return f".skills-row[data-argument='{name}']"


def test_each_says_what_it_is_for_and_those_that_do_not_fit_cannot_be_pressed(skilled):
    page = skilled.page
    assert page.locator(".skills-row-name").all_inner_texts() == [
        "cups-of-anna",
        "dishwasher",
        "dishwasher-panda",
        "torn",
    ]
    assert page.locator(row("dishwasher")).get_attribute("aria-pressed") == "true"
    enabled = [
        page.locator(row(name)).is_enabled() for name in ("cups-of-anna", "dishwasher", "dishwasher-panda", "torn")
    ]
    assert enabled == [True, False, False, False]
    assert "Does not fit here" in page.locator(row("dishwasher-panda")).inner_text()
    assert "damaged" in page.locator(row("torn")).inner_text()
    assert not page.locator(".entries").is_visible()


def test_one_is_chosen_by_a_press_and_the_list_closes_once_it_is_in_use(skilled, presses, station):
    skilled.page.click(row("cups-of-anna"))
    assert presses() == [Press("skill", "cups-of-anna")]
    _, feed = station
    before = feed.view
    feed.view = replace(before, model=msgspec.structs.replace(before.model, skill="cups-of-anna"))
    skilled.wait(".skills", state="hidden")
    skilled.wait(f"{OPENER}:has-text('cups-of-anna')")
    assert skilled.page.locator(".entries").is_visible()
    feed.view = before


def test_a_new_one_is_made_by_its_name_and_none_by_what_is_no_name(skilled, presses, station):
    page = skilled.page
    page.fill(".skills-named", "no name")
    page.click(".skills-make")
    page.wait_for_timeout(300)
    assert station[0].take_presses() == []
    page.fill(".skills-named", "plates.2")
    page.keyboard.press("Enter")
    assert presses() == [Press("new_skill", "plates.2")]


def test_where_it_is_not_offered_nothing_can_be_pressed(skilled, station):
    _, feed = station
    feed.view = replace(feed.view, teaching=msgspec.structs.replace(feed.view.teaching, actions=("finish",)))
    skilled.wait(".skills-make:disabled")
    assert skilled.page.locator(".skills-row:enabled").count() == 0


def test_all_of_it_is_reached_by_keys(skilled):
    page = skilled.page
    page.focus(OPENER)
    page.keyboard.press("Enter")
    skilled.wait(".skills", state="hidden")
    page.keyboard.press("Enter")
    skilled.wait(".skills")
    page.keyboard.press("Tab")
    seen = page.evaluate("document.activeElement.className")
    assert seen in ("skills-row", "entries")


@pytest.mark.parametrize("method", [Method.REFINE, Method.WAYPOINTS])
@pytest.mark.parametrize("size", [(1280, 720), (1600, 900)])
def test_nothing_of_it_is_cut_off(skilled, station, size, method):
    """An empty skill is taught by waypoints, which take room: from there another one is chosen, too."""
    _, feed = station
    feed.view = replace(feed.view, teaching=msgspec.structs.replace(feed.view.teaching, method=method))
    skilled.page.set_viewport_size({"width": size[0], "height": size[1]})
    skilled.page.wait_for_timeout(300)
    skilled.page.click(OPENER)
    skilled.page.click(OPENER)
    for part in (".skills-new", ".skills-list", OPENER):
        if part == OPENER:
            skilled.page.click(OPENER)
            skilled.wait(".skills", state="hidden")
        panel = skilled.page.locator(".history").bounding_box()
        box = skilled.page.locator(part).bounding_box()
        assert box["x"] >= panel["x"]
        assert box["x"] + box["width"] <= panel["x"] + panel["width"]
        assert box["y"] + box["height"] <= panel["y"] + panel["height"]
