"""The chooser of methods and the list of waypoints, in a real browser."""

from dataclasses import replace

import msgspec
import pytest

from protocol.messages import Method, Waypoint
from services.station.press import Press

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

WAYPOINTS = tuple(Waypoint((0.5 + 0.1 * i, 0.0, 0.6), (1.0, 0.0, 0.0, 0.0)) for i in range(3))
EDITS = ("store", "delete", "earlier", "later", "clear", "method")


@pytest.fixture
def storing(tab, station):
    """A tab in which waypoints are stored."""
    _, feed = station
    shown = msgspec.structs.replace(
        feed.view.teaching, method=Method.WAYPOINTS, waypoints=WAYPOINTS, actions=("finish", *EDITS)
    )
    drawing = msgspec.structs.replace(feed.view.drawing, waypoints=tuple(one.position for one in WAYPOINTS))
    feed.view = replace(feed.view, teaching=shown, drawing=drawing)
    tab.wait(".waypoint:nth-child(3)")
    return tab


def test_a_method_is_chosen_by_its_button(storing, clicked):
    assert storing.page.get_attribute("[data-argument=waypoints]", "aria-pressed") == "true"
    assert clicked("[data-argument=demonstrate]") == [Press("method", "demonstrate")]


def test_each_waypoint_is_told_with_its_number_and_place(storing):
    rows = storing.page.locator(".waypoint-place").all_inner_texts()
    assert rows == ["1: 50, 0, 60 cm", "2: 60, 0, 60 cm", "3: 70, 0, 60 cm"]
    assert storing.faults == []


@pytest.mark.parametrize("edit", ["store", "delete", "earlier", "later"])
@pytest.mark.usefixtures("storing")
def test_a_waypoint_is_changed_by_the_buttons_of_its_row(clicked, edit):
    assert clicked(f".waypoint:nth-child(2) [data-action={edit}]") == [Press(edit, "2")]


def test_the_first_goes_no_earlier_and_the_last_no_later(storing):
    ends = (".waypoint:first-child [data-action=earlier]", ".waypoint:last-child [data-action=later]")
    assert all(storing.page.is_disabled(end) for end in ends)


def test_all_are_taken_away_only_when_that_is_confirmed(storing, presses):
    storing.page.click("[data-action=clear]")
    storing.page.click(".confirm-yes")
    assert presses() == [Press("clear")]


def test_while_it_moves_there_is_no_list(tab):
    assert not tab.shows(".waypoints-panel")


def test_where_the_gripper_takes_part_a_waypoint_says_how_far_it_is_open(tab, station):
    feed = station[1]
    stored = tuple(
        Waypoint(one.position, one.orientation, opening)
        for one, opening in zip(WAYPOINTS, (0.08, 0.0, 0.0), strict=True)
    )
    feed.view = replace(feed.view, teaching=msgspec.structs.replace(feed.view.teaching, waypoints=stored))
    tab.wait(".waypoint:nth-child(3)", state="attached")
    rows = [row.strip() for row in tab.page.locator(".waypoint-place").all_text_contents()]
    assert rows == ["1: 50, 0, 60 cm, 80 mm", "2: 60, 0, 60 cm, 0 mm", "3: 70, 0, 60 cm, 0 mm"]
    assert tab.page.locator(".waypoint-place").first.get_attribute("title").endswith("open by 80 mm")
