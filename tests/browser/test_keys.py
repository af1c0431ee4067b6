"""The operator's keys in a real browser: what counts, what is shown, and what else a keyboard is for."""

import pytest
from hand import Hand

from protocol.messages import OperatorInput

pytestmark = pytest.mark.browser

AZERTY = {"KeyQ": "a", "KeyW": "z", "KeyE": "e", "KeyA": "q", "KeyS": "s", "KeyD": "d"}

WITHOUT_LAYOUT = "Object.defineProperty(navigator, 'keyboard', {value: undefined});"
WITH_AZERTY = f"""Object.defineProperty(navigator, 'keyboard', {{value: {{
    getLayoutMap: async () => new Map(Object.entries({AZERTY}))}}}});"""
STALL = "setTimeout(() => { const end = performance.now() + 600; while (performance.now() < end); }, 0)"

TRIGGERS = """const pad = {connected: true, timestamp: 1, axes: [0.05, 0, -1, 0, 0.3, -1]};
    navigator.getGamepads = () => [null, pad, {...pad, timestamp: 9}, null];"""
THROWING = "navigator.getGamepads = () => { throw new DOMException('no', 'SecurityError'); };"
WITHOUT_GAMEPADS = "navigator.getGamepads = undefined;"
BROKEN_PAD = "navigator.getGamepads = () => [{connected: true, timestamp: 1, axes: [NaN, 7, -Infinity]}];"


def say_key(tab, kind, **fields):
    """An event as a browser of another kind makes it."""
    tab.page.evaluate(
        "([kind, fields]) => document.body.dispatchEvent(new KeyboardEvent(kind, {bubbles: true, ...fields}))",
        [kind, fields],
    )


def cap(tab, code):
    return tab.page.inner_text(f"[data-key={code}] .key-cap")


def test_a_held_key_arrives_lights_up_and_goes(tab, hand):
    hand.hold("KeyE")
    tab.wait("[data-key=KeyE][data-held]")
    hand.hold("KeyE", "KeyQ")
    hand.let_go()
    tab.wait(".station:not(:has([data-held]))")


def test_the_keys_that_turn_lie_beside_those_that_push(tab, hand):
    places = {code: tab.page.locator(f"[data-key=Key{code}]").bounding_box() for code in "QWERTYASDFGH"}
    for row in ("QWERTY", "ASDFGH"):
        assert [places[code]["x"] for code in row] == sorted(places[code]["x"] for code in row)
        assert len({places[code]["y"] for code in row}) == 1
    for code in "RFTGYH":
        hand.hold(f"Key{code}")
        tab.wait(f"[data-key=Key{code}][data-held]")


def test_a_held_key_goes_with_the_focus(tab, hand, station, eventually):
    page, _ = station
    hand.hold("KeyE")
    tab.page.evaluate("window.dispatchEvent(new Event('blur'))")
    eventually(lambda: page.take_input().keys == ())


def test_a_held_key_goes_with_the_tab(tab, hand, station, eventually):
    page, _ = station
    hand.hold("KeyE")
    eventually(lambda: page.take_input().present)
    tab.page.close()
    eventually(lambda: page.take_input() == OperatorInput())


def test_a_key_that_was_held_while_the_browser_hung_holds_the_robot_and_says_so(tab, hand, station):
    page, _ = station
    hand.hold("KeyE")
    tab.page.evaluate(STALL)
    tab.wait("body[data-let-go] .light[data-light=hold] .light-word:text-is('Paused')")
    tab.wait("[data-key=KeyE][data-held]")
    tab.wait(".keys-let-go:has-text('Let go of all keys')")
    assert not page.take_input().focused
    hand.let_go()
    tab.wait("body:not([data-let-go]) .light[data-light=green]")
    hand.hold("KeyE")


def test_the_operator_is_present_while_the_page_is_seen(tab, station, eventually):
    page, _ = station
    eventually(lambda: page.take_input().present)
    tab.page.evaluate(
        """Object.defineProperty(document, 'visibilityState', {value: 'hidden', configurable: true});
        document.dispatchEvent(new Event('visibilitychange'));"""
    )
    eventually(lambda: not page.take_input().present)


@pytest.mark.parametrize("pads", [TRIGGERS, THROWING, WITHOUT_GAMEPADS, BROKEN_PAD])
def test_the_keyboard_steers_whatever_gamepads_there_are(open_seated, station, pads):
    tab = open_seated(script=pads)
    Hand(tab, station[0], 20.0).hold("KeyE")
    assert tab.faults == []


def test_the_page_shows_what_is_printed_on_this_keyboard(open_seated, station):
    tab = open_seated(script=WITH_AZERTY)
    tab.wait("[data-key=KeyQ] .key-cap:text-is('A')")
    assert (cap(tab, "KeyW"), cap(tab, "KeyA"), cap(tab, "KeyR")) == ("Z", "Q", "R")
    assert tab.page.inner_text(".keys-layout") == ""
    Hand(tab, station[0], 20.0).hold("KeyQ")


def test_where_the_browser_does_not_tell_the_page_learns_from_the_keys(open_seated):
    tab = open_seated(script=WITHOUT_LAYOUT)
    assert "US keyboard" in tab.page.inner_text(".keys-layout")
    say_key(tab, "keydown", code="KeyQ", key="'")
    assert cap(tab, "KeyQ") == "'"
    say_key(tab, "keydown", code="KeyE", key=".")
    say_key(tab, "keydown", code="KeyD", key="E", shiftKey=True)
    assert (cap(tab, "KeyE"), cap(tab, "KeyD")) == (".", "D")
    assert tab.page.inner_text(".keys-layout") == ""


@pytest.mark.parametrize("code", ["", "Unidentified"])
def test_keys_without_a_place_are_found_by_what_is_printed_on_them(open_seated, code):
    tab = open_seated(script=WITH_AZERTY)
    tab.wait("[data-key=KeyQ] .key-cap:text-is('A')")
    say_key(tab, "keydown", code=code, key="a")
    tab.wait("[data-key=KeyQ][data-held]")
    say_key(tab, "keyup", code=code, key="A")
    tab.wait(".station:not(:has([data-held]))")


def test_enter_presses_the_button_that_has_the_focus(tab, pressed):
    tab.page.focus("[data-action=teach]")
    tab.page.keyboard.press("Enter")
    assert pressed() == ["teach"]


def test_space_is_for_finish_except_where_a_button_has_the_focus(tab, pressed):
    tab.page.focus("[data-action=teach]")
    tab.page.keyboard.press("Space")
    assert pressed() == ["teach"]
    tab.page.evaluate("document.activeElement.blur()")
    tab.page.keyboard.press("Space")
    assert pressed() == ["finish"]


def test_a_button_that_was_clicked_leaves_space_to_finish(tab, pressed):
    tab.page.click("[data-action=teach]")
    assert pressed() == ["teach"]
    tab.page.keyboard.press("Space")
    assert pressed() == ["finish"]


def test_a_key_that_is_held_presses_a_button_once(tab, pressed):
    taken = []
    tab.page.focus("[data-action=teach]")
    for _ in range(4):
        tab.page.keyboard.down("Enter")
    tab.page.keyboard.up("Enter")
    tab.page.evaluate("document.activeElement.blur()")
    tab.page.keyboard.press("Space")
    while "finish" not in taken:
        taken += pressed()
    assert taken == ["teach", "finish"]


def test_only_keys_that_steer_are_taken_from_the_browser(tab):
    tab.page.evaluate(
        """window.taken = {}; window.addEventListener('keydown', (event) => {
            window.taken[event.code] = event.defaultPrevented; });"""
    )
    for key in ("KeyE", "Slash", "Enter", "Tab", "F2"):
        tab.page.keyboard.press(key)
    tab.page.keyboard.press("Control+KeyE")
    taken = tab.page.evaluate("window.taken")
    assert taken == {
        "KeyE": False,
        "Slash": False,
        "Enter": False,
        "Tab": False,
        "F2": False,
        "ControlLeft": False,
    }
    tab.page.keyboard.press("KeyW")
    assert tab.page.evaluate("window.taken.KeyW")


@pytest.mark.parametrize("modifier", ["ctrlKey", "altKey", "metaKey"])
def test_a_shortcut_of_the_browser_does_not_steer(tab, hand, modifier):
    say_key(tab, "keydown", code="KeyE", key="e", **{modifier: True})
    hand.hold("KeyQ")
