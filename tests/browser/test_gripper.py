"""The gripper by key, button and slider, where it takes part in the task."""

from dataclasses import replace

import msgspec
import pytest

from services.station.press import Press

pytestmark = pytest.mark.browser

WIDE = 0.08


@pytest.fixture
def takes_part(tab, station):
    """A function that lets the station show a task in which it takes part, something held or not."""
    feed = station[1]

    def show(opening=None, *, reference=WIDE, measured=WIDE, grasped=False):
        robot = msgspec.structs.replace(feed.view.robot, opening=measured, opening_reference=reference, grasped=grasped)
        feed.view = replace(feed.view, robot=robot, wide_open=WIDE, opening=opening)
        tab.wait(".gripper:visible")

    return show


def test_where_it_takes_no_part_nothing_of_it_is_there(tab, presses):
    tab.wait(".gripper", state="hidden")
    tab.page.keyboard.press("KeyC")
    tab.page.keyboard.press("Space")
    assert presses() == [Press("finish")]


def test_its_key_and_its_button_say_the_same(tab, takes_part, presses):
    takes_part()
    tab.wait("[data-action=grip]:enabled")
    tab.page.keyboard.press("KeyC")
    assert presses() == [Press("grip")]
    tab.page.click("[data-action=grip]")
    assert presses() == [Press("grip")]


def test_its_slider_says_how_far(tab, takes_part, presses):
    takes_part()
    knob = tab.page.locator(".gripper-knob")
    tab.wait(".gripper-knob[aria-valuenow='100']")
    knob.focus()
    tab.page.keyboard.press("Home")
    assert presses() == [Press("opening", "0.00")]
    box = tab.page.locator(".gripper-track").bounding_box()
    at = knob.bounding_box()
    tab.page.mouse.move(at["x"] + at["width"] / 2, at["y"] + at["height"] / 2)
    tab.page.mouse.down()
    tab.page.mouse.move(box["x"] + 0.5 * box["width"], box["y"] + box["height"] / 2)
    tab.page.mouse.up()
    assert presses() == [Press("opening", "0.50")]


def test_what_was_asked_is_shown_beside_what_was_measured(tab, takes_part):
    takes_part(0.0, reference=0.0, measured=0.0385, grasped=True)
    tab.wait(".gripper-text:text-is('asked 0 mm, is 38 mm, holds')")
    tab.wait(".gripper-knob[aria-valuenow='0']")
    assert tab.page.locator("[data-action=grip]").inner_text() == "Open"
    track, measured = (tab.page.locator(f".gripper-{name}").bounding_box() for name in ("track", "measured"))
    assert measured["width"] / track["width"] == pytest.approx(0.0385 / WIDE, abs=0.02)


def test_it_keeps_its_place_whatever_is_said(tab, takes_part):
    takes_part()
    tab.wait(".gripper-text:text-is('with the motion: 80 mm')")
    before = tab.page.locator(".gripper").bounding_box()
    takes_part(0.0, reference=0.0, measured=0.0385, grasped=True)
    tab.wait(".gripper-text:text-is('asked 0 mm, is 38 mm, holds')")
    assert tab.page.locator(".gripper").bounding_box() == before
