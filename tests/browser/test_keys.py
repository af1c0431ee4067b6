"""The operator's keys in a real browser: what counts, what is shown, and what else a keyboard is for."""

import pytest
from hand import Hand

from protocol.messages import OperatorInput
from services.station.press import Press

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

LAYOUTS = {
    "AZERTY": {"KeyQ": "a", "KeyW": "z", "KeyE": "e", "KeyA": "q", "KeyS": "s", "KeyD": "d", "KeyY": "y", "KeyZ": "w"},
    "QWERTZ": {"KeyQ": "q", "KeyW": "w", "KeyE": "e", "KeyA": "a", "KeyS": "s", "KeyD": "d", "KeyY": "z", "KeyZ": "y"},
    "Dvorak": {"KeyQ": "'", "KeyW": ",", "KeyE": ".", "KeyA": "a", "KeyS": "o", "KeyD": "e", "KeyY": "f", "KeyZ": ";"},
}
AZERTY = LAYOUTS["AZERTY"]

WITHOUT_LAYOUT = "Object.defineProperty(navigator, 'keyboard', {value: undefined});"


def with_layout(layout):
    """A browser that tells what is printed where."""
    return f"""Object.defineProperty(navigator, 'keyboard', {{value: {{
        getLayoutMap: async () => new Map(Object.entries({layout}))}}}});"""


WITH_AZERTY = with_layout(AZERTY)
STALL = "setTimeout(() => { const end = performance.now() + 600; while (performance.now() < end); }, 0)"


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


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_the_page_shows_what_is_printed_on_this_keyboard_and_it_is_the_place_that_counts(open_seated, station, layout):
    tab = open_seated(script=with_layout(layout))
    tab.wait(f'[data-key=KeyW] .key-cap:text-is("{layout["KeyW"].upper()}")')
    shown = {code: cap(tab, code) for code in layout if code != "KeyZ"}
    assert shown == {code: legend.upper() for code, legend in layout.items() if code != "KeyZ"}
    assert cap(tab, "KeyR") == "R"
    assert tab.page.inner_text(".keys-layout") == ""
    Hand(tab, station[0], 20.0).hold("KeyQ")
    say_key(tab, "keydown", code="KeyY", key=layout["KeyY"])
    tab.wait("[data-key=KeyY][data-held]")


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_where_the_browser_does_not_tell_the_page_learns_from_the_keys(open_seated, layout):
    tab = open_seated(script=WITHOUT_LAYOUT)
    assert "US keyboard" in tab.page.inner_text(".keys-layout")
    for code in ("KeyQ", "KeyY"):
        say_key(tab, "keydown", code=code, key=layout[code])
        assert cap(tab, code) == layout[code].upper()
    say_key(tab, "keydown", code="KeyD", key="E", shiftKey=True)
    assert cap(tab, "KeyD") == "D"
    assert tab.page.inner_text(".keys-layout") == ""


@pytest.mark.parametrize("layout", LAYOUTS.values(), ids=LAYOUTS)
def test_no_key_is_lost_where_the_browser_gives_no_code(open_seated, layout):
    tab = open_seated(script=with_layout(layout))
    tab.wait(f'[data-key=KeyW] .key-cap:text-is("{layout["KeyW"].upper()}")')
    for code in ("KeyQ", "KeyS", "KeyY"):
        say_key(tab, "keydown", code="", key=layout[code])
        tab.wait(f"[data-key={code}][data-held]")
        say_key(tab, "keyup", code="", key=layout[code])
        tab.wait(".station:not(:has([data-held]))")


def set_key(tab, name, **event):
    """Set a key for what another one does."""
    tab.page.click(".keys-set")
    tab.page.click(f"[data-key={name}]")
    say_key(tab, "keydown", **event)


def test_every_key_can_be_set_and_stays_set(open_seated, station, eventually):
    tab = open_seated()
    set_key(tab, "KeyE", code="KeyI", key="i")
    assert cap(tab, "KeyE") == "I"
    tab.page.click(".keys-set")
    hand = Hand(tab, station[0], 20.0)
    hand.let_go()
    tab.page.keyboard.down("KeyI")
    eventually(lambda: station[0].take_input().keys == ("KeyE",))
    tab.page.keyboard.up("KeyI")
    tab.page.keyboard.down("KeyE")
    tab.page.keyboard.down("KeyQ")
    eventually(lambda: station[0].take_input().keys == ("KeyQ",))
    tab.page.keyboard.up("KeyE")
    tab.page.keyboard.up("KeyQ")
    tab.page.reload()
    tab.wait("[data-key=KeyE] .key-cap:text-is('I')")
    tab.page.click(".keys-set")
    tab.page.click(".keys-reset")
    assert cap(tab, "KeyE") == "E"


def test_a_key_without_a_place_can_be_set_by_what_is_printed_on_it(tab):
    set_key(tab, "KeyE", code="", key="é")
    assert cap(tab, "KeyE") == "É"
    tab.page.click(".keys-set")
    say_key(tab, "keydown", code="", key="é")
    tab.wait("[data-key=KeyE][data-held]")
    say_key(tab, "keyup", code="", key="é")
    tab.wait(".station:not(:has([data-held]))")


@pytest.mark.parametrize(
    ("event", "said"),
    [
        ({"code": "KeyD", "key": "d"}, "D is for down already: press another one."),
        ({"code": "Space", "key": " "}, "is needed for something else"),
        ({"code": "", "key": "Unidentified"}, "does not tell which key that is"),
    ],
)
def test_a_key_that_cannot_be_set_is_refused_in_one_line(tab, event, said):
    set_key(tab, "KeyE", **event)
    tab.wait(f".keys-note:has-text('{said}')")
    assert cap(tab, "KeyE") == "E"


def test_while_keys_are_set_nothing_steers_and_escape_stops(tab, station, pressed, eventually):
    tab.page.click(".keys-set")
    tab.page.keyboard.down("KeyQ")
    tab.page.keyboard.up("KeyQ")
    assert not tab.shows("[data-held]")
    tab.page.keyboard.press("Escape")
    assert pressed() == ["stop"]
    tab.wait(".devices:not([data-setting])")


def test_keys_are_set_by_keys_alone(tab):
    tab.page.focus(".keys-set")
    tab.page.keyboard.press("Enter")
    tab.page.focus("[data-key=KeyE]")
    tab.page.keyboard.press("Enter")
    tab.wait(".keys-note:has-text('Press the key for: up.')")
    tab.page.keyboard.press("KeyO")
    assert cap(tab, "KeyE") == "O"


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


def test_a_button_that_was_clicked_leaves_space_to_finish(tab, clicked, pressed):
    assert clicked("[data-action=teach]") == [Press("teach")]
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
