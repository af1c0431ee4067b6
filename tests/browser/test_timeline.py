"""The motion as a bar: led, paced and marked by pointer and by keys."""

from dataclasses import replace

import msgspec
import pytest

from protocol.messages import ExecutionState, Mode, Part
from services.station.press import Press

pytestmark = pytest.mark.browser

STANDING = ("execute", "refine", "pace", "part")
RUNNING = ("finish", "pause", "step_back", "step_on", "seek", "pace")
PAUSED = ("finish", "play", "step_back", "step_on", "seek", "pace")


@pytest.fixture
def shows(tab, station):
    """A function that lets the station show a motion in some state."""

    def show(actions, *, pace=1.0, progress=0.4, **teaching):
        feed = station[1]
        view = feed.view
        execution = None
        if actions is not STANDING:
            execution = ExecutionState(episode=1, mode=Mode.REFINE, prediction=1, progress=progress, pace=pace)
        feed.view = replace(
            view,
            teaching=msgspec.structs.replace(view.teaching, actions=actions, **teaching),
            robot=msgspec.structs.replace(view.robot, progress=progress),
            execution=execution,
        )
        tab.wait(f"[data-value=action-{actions[-1]}]:not([disabled])", state="attached")
        tab.wait(f".timeline-head[aria-valuenow='{round(100 * progress)}']", state="attached")

    return show


def middle(tab, selector):
    box = tab.page.locator(selector).bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def place(tab, share, track=".timeline-track"):
    box = tab.page.locator(track).bounding_box()
    return box["x"] + share * box["width"], box["y"] + box["height"] / 2


@pytest.mark.parametrize(
    ("key", "action"), [("KeyP", "pause"), ("KeyP", "play"), ("Comma", "step_back"), ("Period", "step_on")]
)
def test_keys_pause_go_on_and_step(tab, shows, presses, key, action):
    shows(PAUSED if action == "play" else RUNNING, pace=0.0 if action == "play" else 1.0)
    tab.wait(f".timeline [data-action={action}]:visible:enabled")
    tab.page.keyboard.press(key)
    assert presses() == [Press(action)]


def test_buttons_do_the_same_and_leave_the_keys_to_the_operator(tab, shows, presses, hand):
    shows(RUNNING)
    tab.page.click(".timeline [data-action=step_back]")
    assert presses() == [Press("step_back")]
    hand.hold("KeyW")
    hand.let_go()


def test_the_pace_is_set_by_keys_while_the_letters_still_steer(tab, shows, presses, hand):
    shows(RUNNING)
    knob = tab.page.locator(".pace-knob")
    knob.focus()
    tab.page.keyboard.press("ArrowLeft")
    assert presses() == [Press("pace", "0.95")]
    tab.page.keyboard.press("Home")
    assert presses() == [Press("pace", "0.25")]
    assert knob.get_attribute("aria-valuetext") == "25 %"
    hand.hold("KeyE")
    hand.let_go()


def test_the_pace_is_dragged(tab, shows, presses):
    shows(RUNNING)
    tab.page.mouse.move(*middle(tab, ".pace-knob"))
    tab.page.mouse.down()
    tab.page.mouse.move(*place(tab, 1.2, ".pace-track"), steps=3)
    tab.page.mouse.up()
    assert presses() == [Press("pace", "2.00")]


def test_a_part_is_marked_by_dragging_its_end_and_by_keys(tab, shows, presses):
    shows(STANDING)
    tab.page.mouse.move(*middle(tab, ".timeline-last"))
    tab.page.mouse.down()
    tab.page.mouse.move(*place(tab, 0.6), steps=4)
    tab.page.mouse.up()
    (pressed,) = presses()
    assert pressed.action == "part"
    first, last = map(float, pressed.argument.split())
    assert (first, last) == (0.0, pytest.approx(0.6, abs=0.02))
    tab.wait(".timeline-track[data-part]", state="attached")
    tab.page.locator(".timeline-first").focus()
    tab.page.keyboard.press("PageUp")
    (pressed,) = presses()
    assert float(pressed.argument.split()[0]) == pytest.approx(0.05)


def test_a_part_is_never_empty(tab, shows, presses):
    shows(STANDING, part=Part(0.3, 0.6))
    tab.wait(".timeline-first[aria-valuenow='30']", state="attached")
    tab.page.locator(".timeline-last").focus()
    tab.page.keyboard.press("Home")
    (pressed,) = presses()
    first, last = map(float, pressed.argument.split())
    assert 0.0 <= first < last


def test_marks_stand_while_the_robot_moves(tab, shows, presses):
    shows(RUNNING, part=Part(0.3, 0.6))
    tab.wait(".timeline-first[aria-disabled=true]", state="attached")
    tab.page.mouse.move(*middle(tab, ".timeline-last"))
    tab.page.mouse.down()
    tab.page.mouse.move(*place(tab, 0.9), steps=3)
    tab.page.mouse.up()
    tab.page.keyboard.press("KeyP")
    assert presses() == [Press("pause")]


def test_a_click_on_the_bar_leads_the_robot_there(tab, shows, presses):
    shows(PAUSED, pace=0.0)
    tab.page.mouse.click(*place(tab, 0.75))
    (pressed,) = presses()
    assert (pressed.action, float(pressed.argument)) == ("seek", pytest.approx(0.75, abs=0.02))


def test_where_it_was_spoilt_and_would_be_is_marked_in_different_shapes(tab, shows, station, eventually):
    shows(RUNNING, progress=0.0)
    feed = station[1]
    feed.view = replace(feed.view, spoilt=(0.55,))
    tab.wait(".tick-spoilt", state="attached")
    tab.wait(".tick-foreseen", state="attached")
    feed.view = replace(feed.view, spoilt=())
    tab.wait(".tick-spoilt", state="detached")
