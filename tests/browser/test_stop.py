"""The emergency stop on the page: by any means, through any outage, and shown as what it is."""

from dataclasses import replace
from datetime import UTC, datetime

import pytest
from harness import confirmed_view, working_view

from protocol.messages import SafetyState
from services.station.press import Press

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

MODIFIERS = ("", "Control+", "Alt+", "Shift+", "Meta+", "Control+Shift+Alt+")


def stop_by(tab, where="document.body", **fields):
    tab.page.evaluate(
        f"(fields) => {where}.dispatchEvent(new KeyboardEvent('keydown', {{bubbles: true, ...fields}}))", fields
    )


@pytest.fixture
def again(tab, station, pressed):
    """A function that waits for the stop that was pressed, and until another one can be."""

    def settle():
        assert pressed() == ["stop"]
        station[1].view = confirmed_view()
        tab.wait("body:not([data-stop-waits]) .stopped")
        station[1].view = working_view()
        tab.wait(".stop[data-stop=ready]")

    return settle


def test_escape_stops_whatever_else_is_held(tab, again):
    for modifiers in MODIFIERS:
        tab.page.keyboard.press(f"{modifiers}Escape")
        again()


def test_escape_is_known_by_any_sign(tab, again):
    for event in (
        {"code": "Escape", "key": "Escape"},
        {"code": "Escape", "key": "CapsLock"},
        {"code": "CapsLock", "key": "Escape"},
        {"code": "", "key": "Escape"},
        {"code": "Unidentified", "key": "Esc"},
        {"code": "", "key": "Unidentified", "keyCode": 27},
        {"code": "Escape", "key": "Process", "isComposing": True},
        {"code": "Escape", "key": "Escape", "repeat": True},
    ):
        stop_by(tab, **event)
        again()


def test_escape_stops_from_wherever_the_focus_is(tab, again):
    for html in ("<input>", "<textarea></textarea>", "<div contenteditable>a</div>", "<dialog><input></dialog>"):
        tab.page.evaluate(
            """(html) => {
                document.body.insertAdjacentHTML('beforeend', html);
                const added = document.body.lastElementChild;
                added.addEventListener('keydown', (event) => event.stopImmediatePropagation());
                added.showModal?.();
                (added.querySelector('input') ?? added).focus();
            }""",
            html,
        )
        tab.page.keyboard.press("Escape")
        again()


def test_a_button_that_has_the_focus_does_not_take_the_stop(tab, pressed):
    tab.page.focus("[data-action=teach]")
    tab.page.keyboard.press("Escape")
    assert pressed() == ["stop"]


def test_the_stop_button_counts_when_it_is_touched_and_by_key(tab, pressed):
    tab.page.hover("[data-action=stop]")
    tab.page.mouse.down()
    assert pressed() == ["stop"]
    tab.page.mouse.up()


def test_the_stop_button_can_be_pressed_by_enter(tab, pressed):
    tab.page.focus(".stop-button")
    tab.page.keyboard.press("Enter")
    assert pressed() == ["stop"]


def test_a_stop_is_unconfirmed_until_the_robot_says_latched_and_standing(tab, calm_station, pressed):
    _, feed = calm_station
    tab.page.keyboard.press("Escape")
    tab.wait(".unconfirmed:visible:has-text('Stop not confirmed')")
    assert pressed() == ["stop"]
    feed.view = replace(feed.view, safety=SafetyState(emergency_stop=True, by="anna"))
    tab.wait(".unconfirmed:visible:has-text('still moves')")
    feed.view = replace(feed.view, safety=SafetyState(emergency_stop=True, by="anna", standing=True))
    tab.wait(".stopped:visible")
    tab.wait(".unconfirmed", "hidden")


TODAY, LONG_AGO = datetime.now(UTC).isoformat(timespec="seconds"), "2020-11-25T10:00:05Z"


@pytest.mark.parametrize("moment", [TODAY, LONG_AGO], ids=["today", "another day"])
def test_who_stopped_when_and_who_released_when_are_shown(tab, calm_station, clicked, moment):
    _, feed = calm_station
    stopped = SafetyState(emergency_stop=True, by="anna", reason="pressed on the page", at=moment, standing=True)
    feed.view = replace(feed.view, safety=stopped)
    tab.wait(".stopped:visible")
    assert tab.page.inner_text(".stopped-reason") == "anna: pressed on the page"
    at = tab.page.evaluate(f"new Date('{moment}').toTimeString().slice(0, 8)")
    shown = tab.page.get_attribute(".stopped-reason", "data-time")
    assert shown.endswith(at)
    assert ("2020" in shown) is (moment is LONG_AGO), "the day, where it is another one"
    assert clicked("[data-action=release_stop]") == [Press("release_stop")]
    feed.view = replace(feed.view, safety=SafetyState(emergency_stop=False, released_by="bert", at=moment))
    tab.wait(".stop-released:visible:text-is('Released by bert')")
    assert tab.page.get_attribute(".stop-released", "data-time") == shown


def test_a_tab_that_looks_on_may_stop(tab, open_tab, pressed):
    second = open_tab()
    second.wait("body[data-link=view-only]")
    second.page.keyboard.press("Escape")
    assert pressed() == ["stop"]
    tab.wait(".unconfirmed:visible")


@pytest.mark.parametrize("lost", [True, False], ids=["connection lost", "connection kept"])
def test_a_stop_in_an_outage_is_shown_kept_and_delivered(open_seated, station, cable, pressed, lost):
    page, _ = station
    tab = open_seated(cable.url)
    cable.cut()
    tab.wait("body[data-link=offline] .banner-offline:visible")
    tab.page.keyboard.press("Escape")
    tab.wait(".unconfirmed:visible:has-text('Not delivered yet')")
    assert page.take_presses() == []
    cable.mend(lost=lost)
    assert pressed() == ["stop"]
    tab.wait("body:not([data-stop-waits])")


def test_while_the_link_is_cut_no_operator_is_present(open_seated, station, cable, eventually):
    page, _ = station
    open_seated(cable.url)
    eventually(lambda: page.take_input().present)
    cable.cut()
    eventually(lambda: not page.take_input().present)


def test_a_stop_is_carried_over_a_reload(open_seated, cable, pressed):
    tab = open_seated(cable.url)
    cable.cut()
    tab.wait("body[data-link=offline]")
    tab.page.keyboard.press("Escape")
    tab.page.evaluate("window.dispatchEvent(new PageTransitionEvent('pagehide'))")
    stored = tab.page.evaluate("sessionStorage.getItem('retouch-stop')")
    assert stored is not None
    cable.mend(lost=True)
    tab.page.reload()
    assert set(pressed()) == {"stop"}


@pytest.mark.parametrize("lost", [True, False], ids=["connection lost", "connection kept"])
def test_a_press_of_a_second_ago_is_not_done_and_said_not_to_be(open_seated, station, cable, eventually, lost):
    page, _ = station
    tab = open_seated(cable.url)
    tab.wait("[data-action=teach]:enabled")
    cable.cut()
    tab.page.click("[data-action=teach]")
    tab.wait(".banner-dropped:visible:has-text('Teach this')")
    cable.mend(lost=lost)
    tab.wait("body[data-link=armed]")
    taken = []

    def finished():
        tab.page.click("[data-action=finish]")
        taken.extend(page.take_presses())
        return taken

    eventually(finished)
    assert set(taken) == {Press("finish")}
