"""What a press by hand is meant for, while the page changes under the pointer."""

from dataclasses import replace

import msgspec
import pytest
from harness import confirmed_view
from states import IN_HAND, states

from protocol.messages import Method, Waypoint

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

SEEN_AFTER_MS = 250
WAYPOINT = Waypoint((0.5, 0.0, 0.6), (1.0, 0.0, 0.0, 0.0))
LOOKED_AT = """
    window.seen = [];
    new MutationObserver((changes) => {
        for (const { target } of changes) {
            const { left, top, width, height } = target.getBoundingClientRect();
            const under = document.elementFromPoint(left + width / 2, top + height / 2);
            window.seen.push([target.dataset.action, target.contains(under), performance.now()]);
        }
    }).observe(document, { subtree: true, attributes: true, attributeFilter: ["data-come"] });
"""
"""Each change of what may be pressed not yet: which button, whether it may be pressed where it lies, and when [ms]."""

PLACED = """() => Object.fromEntries([...document.querySelectorAll(".action:enabled")].map((button) => {
    const { left, top } = button.getBoundingClientRect();
    return [`${button.dataset.action} ${button.parentElement.className}`, [Math.round(left), Math.round(top)]];
}))"""
"""Where each button lies, the one to press first and the small ones."""


@pytest.fixture
def say(station):
    """A function that changes what the workflow says, until a tab shows it."""
    _, feed = station

    def change(tab, text, **teaching):
        view = feed.view
        feed.view = replace(view, teaching=msgspec.structs.replace(view.teaching, text=text, **teaching))
        tab.wait(f".light-text:text-is('{text}')")

    return change


def middle(tab, action):
    """Where a button lies [px]."""
    tab.wait(f"[data-action={action}]:enabled")
    tab.page.wait_for_function(f"() => !document.querySelector('[data-action={action}]').matches('[data-come]')")
    box = tab.page.locator(f"[data-action={action}]").bounding_box()
    return box["x"] + box["width"] / 2, box["y"] + box["height"] / 2


def point(tab, action):
    """Lay the pointer on a button and press it down."""
    tab.page.mouse.move(*middle(tab, action))
    tab.page.mouse.down()


def under_the_pointer(tab, at):
    """The button that lies there."""
    return tab.page.evaluate(
        "([x, y]) => document.elementsFromPoint(x, y).map((e) => e.closest('.action')?.dataset.action).find(Boolean)",
        at,
    )


ELSEWHERE = {
    "among the others": {"recommended": "execute"},
    "farther down": {"event": "More is told than there is room for. " * 20},
}


@pytest.mark.parametrize("change", ELSEWHERE.values(), ids=ELSEWHERE)
def test_a_button_that_is_moved_while_it_is_pressed_is_pressed_once(tab, say, pressed, change):
    say(tab, "Which?", phase="deciding", actions=IN_HAND, recommended="refine")
    at = middle(tab, "execute")
    point(tab, "execute")
    say(tab, "That one.", **change)
    assert under_the_pointer(tab, at) != "execute"
    tab.page.mouse.up()
    assert pressed() == ["execute"]
    point(tab, "execute")
    tab.page.mouse.up()
    assert pressed() == ["execute"]


def test_a_button_that_may_not_be_pressed_any_more_is_not_and_nor_is_what_came_in_its_place(tab, say, pressed):
    say(tab, "Watch.", phase="executing", actions=("finish",))
    point(tab, "finish")
    say(tab, "Which?", phase="deciding", actions=("execute", "teach"), recommended="execute")
    tab.page.mouse.up()
    point(tab, "teach")
    tab.page.mouse.up()
    assert pressed() == ["teach"]


def test_who_leads_the_pointer_away_presses_nothing(tab, say, pressed):
    say(tab, "Which?", phase="deciding", actions=IN_HAND, recommended="refine")
    point(tab, "execute")
    tab.page.mouse.move(*middle(tab, "refine"))
    tab.page.mouse.up()
    point(tab, "refine")
    tab.page.mouse.up()
    assert pressed() == ["refine"]


def test_what_has_just_come_to_where_something_else_lay_is_pressed_once_it_can_have_been_seen(open_seated, station):
    tab = open_seated(script=LOOKED_AT)
    _, feed = station
    view = feed.view
    middle(tab, "finish")
    deciding = msgspec.structs.replace(
        view.teaching, phase="deciding", text="Which?", actions=("execute", "teach"), recommended="execute"
    )
    feed.view = replace(view, teaching=deciding)
    tab.page.wait_for_function("() => window.seen.filter(([action]) => action === 'execute').length === 2")
    (_, hit, came), (_, hit_later, seen) = (one for one in tab.page.evaluate("window.seen") if one[0] == "execute")
    assert (hit, hit_later) == (False, True)
    assert seen - came >= SEEN_AFTER_MS - 1.0


def test_whoever_hammers_on_the_stop_does_not_release_it(open_seated, station):
    tab = open_seated(script=LOOKED_AT)
    _, feed = station
    feed.view = confirmed_view()
    tab.page.wait_for_function("() => window.seen.some(([action, hit]) => action === 'release_stop' && hit === false)")


@pytest.mark.parametrize("size", [(1600, 900), (1280, 720)])
def test_the_buttons_stay_where_they_are_when_the_words_change(viewed, say, station, size):
    _, feed = station
    viewed.page.set_viewport_size({"width": size[0], "height": size[1]})
    places = set()
    for text, notice in (
        ("Short.", ""),
        ("Short.", "The robot does not take that now."),
        ("Finished: the robot has learnt from the correction. Press Next object to begin again.", ""),
    ):
        feed.view = replace(feed.view, notice=notice)
        say(viewed, text)
        viewed.wait(f".notice:text-is('{notice}')", state="attached")
        places.add(middle(viewed, "finish"))
    assert len(places) == 1


@pytest.mark.parametrize("size", [(1600, 900), (1366, 768), (1280, 720)])
def test_every_small_button_has_its_place_in_every_state_and_lies_on_no_other(viewed, station, size):
    _, feed = station
    viewed.page.set_viewport_size({"width": size[0], "height": size[1]})
    places = {}
    for name, view in states().items():
        if view.teaching is None:
            continue
        feed.view = view
        viewed.wait(f".light-text:text-is('{view.teaching.text}')")
        boxes = viewed.page.evaluate(PLACED)
        for action, box in boxes.items():
            assert places.setdefault(action, box) == pytest.approx(box, abs=1.0), name
        assert len({tuple(box) for box in boxes.values()}) == len(boxes), name


def test_the_buttons_stay_where_they_are_when_a_waypoint_is_stored(viewed, say):
    places = set()
    for count in (0, 1, 6):
        say(viewed, f"{count} stored.", method=Method.WAYPOINTS, waypoints=(WAYPOINT,) * count)
        places.add(middle(viewed, "finish"))
    assert len(places) == 1
