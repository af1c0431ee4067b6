"""Gamepads, 3-D mice and the pointer's pad in a real browser: what is read, and what is said where there is none."""

from dataclasses import replace

import pytest

from protocol.messages import Controller, MasterState, Trouble

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

PADS = """
    window.pads = [];
    navigator.getGamepads = () => window.pads;
    window.pad = (index, axes, buttons = [], id = 'Some pad (STANDARD GAMEPAD)', mapping = 'standard') => {
        window.pads[index] = {index, id, mapping, connected: true, timestamp: 1, axes,
            buttons: buttons.map((value) => ({value, pressed: value > 0.5}))};
    };
"""
WITHOUT_GAMEPADS = "navigator.getGamepads = undefined;"
FORBIDDEN = "navigator.getGamepads = () => { throw new DOMException('no', 'SecurityError'); };"
BROKEN = """navigator.getGamepads = () => [null, {connected: true, axes: [NaN, 7, -Infinity], buttons: [{}, null]},
    {connected: false, axes: [1], buttons: []}];"""


@pytest.fixture
def read(station, eventually):
    """A function that waits until the station reads these devices, whatever each is called."""

    def wait(*expected):
        page, _ = station

        def seen():
            return tuple(replace_name(one) for one in page.take_input().controllers) == expected

        eventually(seen)

    return wait


def replace_name(controller):
    return Controller(controller.kind, controller.number, "", controller.standard, controller.axes, controller.buttons)


def show_pad(tab, pad):
    tab.page.click(f"[data-pad-for={pad}]")
    tab.wait(f".device-pad[data-pad-of={pad}]")


def grip(tab, x=0.5, y=0.5):
    """Put the pointer down at a place of its pad; where that is."""
    box = tab.page.locator(".pointer-pad").bounding_box()
    place = box["x"] + x * box["width"], box["y"] + y * box["height"]
    tab.page.mouse.move(*place)
    tab.page.mouse.down()
    return place, tab.page.evaluate("document.querySelector('.pointer-pad').clientHeight") / 2


def test_axes_and_buttons_arrive_as_they_are_read(open_seated, read):
    tab = open_seated(script=PADS)
    tab.page.evaluate("window.pad(0, [0.05, -1, 0.5, 0], [0, 1, 0.4])")
    read(Controller("gamepad", 0, "", True, (0.05, -1.0, 0.5, 0.0), (0.0, 1.0, 0.4)))
    tab.page.evaluate("window.pad(1, [0, 0, -1, 0, 0, -1], [], 'Generic USB', '')")
    read(
        Controller("gamepad", 0, "", True, (0.05, -1.0, 0.5, 0.0), (0.0, 1.0, 0.4)),
        Controller("gamepad", 1, "", False, (0.0, 0.0, -1.0, 0.0, 0.0, -1.0)),
    )
    tab.page.evaluate("window.pads = []")
    read()
    assert tab.faults == []


def test_a_3d_mouse_is_known_by_its_name(open_seated, read):
    tab = open_seated(script=PADS)
    tab.page.evaluate(
        "window.pad(0, [0, 0, 0.5, 0, 0, 0], [0, 0], '3Dconnexion SpaceMouse (Vendor: 256f Product: c635)', '')"
    )
    read(Controller("spacemouse", 0, "", False, (0.0, 0.0, 0.5, 0.0, 0.0, 0.0), (0.0, 0.0)))


def test_what_is_no_number_is_at_rest(open_seated, read):
    open_seated(script=BROKEN)
    read(Controller("gamepad", 0, "", False, (0.0, 1.0, 0.0), (0.0, 0.0)))


@pytest.mark.parametrize(
    ("script", "said"),
    [
        (WITHOUT_GAMEPADS, "This browser reads no gamepads"),
        (FORBIDDEN, "does not let this page read gamepads"),
        (PADS, "plug it in and press one of its buttons"),
    ],
)
def test_where_there_is_no_gamepad_the_page_says_why_and_what_to_do(open_seated, script, said):
    tab = open_seated(script=script)
    tab.wait(f".device-tab[data-absent][title*='{said}']")
    show_pad(tab, "gamepad")
    tab.wait(f".gamepads-none:has-text('{said}')")


def test_a_pad_is_drawn_as_it_is_held(open_seated):
    tab = open_seated(script=PADS)
    show_pad(tab, "gamepad")
    tab.page.evaluate("window.pad(0, [0.25, -1, 0, 0], [0, 1, 0])")
    tab.wait(".gamepad-button[data-pressed]")
    assert tab.page.locator(".gamepad-stick").count() == 2
    assert tab.page.locator(".gamepad-stick").first.evaluate("(stick) => stick.style.getPropertyValue('--x')") == "0.25"
    assert tab.page.locator(".gamepad-button[data-pressed]").count() == 1
    assert tab.page.inner_text(".gamepad-name").startswith("Some pad")


def test_a_drag_the_wheel_and_shift_lead_along_and_about_three_axes(tab, station, eventually):
    page, _ = station
    show_pad(tab, "pointer")
    (x, y), half = grip(tab)

    def axes():
        pads = page.take_input().controllers
        return pads[0].axes if pads and pads[0].buttons == (1.0,) else ()

    eventually(axes)
    tab.page.mouse.move(x + 20.0, y - 10.0)
    tab.page.mouse.wheel(0.0, -100.0)
    eventually(lambda: axes()[:3] == pytest.approx((20.0 / half, -10.0 / half, -0.05), abs=0.01))
    tab.page.keyboard.down("Shift")
    tab.page.mouse.move(x + 20.0, y + 20.0)
    eventually(lambda: axes()[3:] == pytest.approx((0.0, 30.0 / half, 0.0), abs=0.01))
    tab.page.keyboard.up("Shift")
    tab.page.mouse.up()
    eventually(lambda: page.take_input().controllers[0].buttons == (0.0,))
    tab.page.mouse.move(x, y)
    assert page.take_input().controllers[0].axes[:3] == pytest.approx((20.0 / half, -10.0 / half, -0.05), abs=0.01)


def test_a_pad_that_is_not_shown_is_not_there(tab, read):
    show_pad(tab, "pointer")
    read(Controller("pointer", axes=(0.0,) * 6, buttons=(0.0,)))
    show_pad(tab, "keyboard")
    read()


@pytest.mark.parametrize(
    "end",
    [
        "window.dispatchEvent(new Event('blur'))",
        "document.querySelector('.pointer-pad').dispatchEvent(new PointerEvent('pointercancel', {pointerId: 1}))",
    ],
)
def test_a_grip_ends_with_the_focus_and_where_the_system_takes_the_pointer(tab, station, eventually, end):
    page, _ = station
    show_pad(tab, "pointer")
    grip(tab)
    eventually(lambda: [one.buttons for one in page.take_input().controllers] == [(1.0,)])
    tab.page.evaluate(end)
    eventually(lambda: [one.buttons for one in page.take_input().controllers] == [(0.0,)])


def test_a_finger_on_the_pad_leads_nothing_and_is_told_what_does(tab, station, eventually):
    page, _ = station
    show_pad(tab, "pointer")
    eventually(lambda: page.take_input().controllers)
    tab.page.evaluate(
        """document.querySelector('.pointer-pad').dispatchEvent(
            new PointerEvent('pointerdown', {pointerId: 5, pointerType: 'touch', button: 0, bubbles: true}))"""
    )
    tab.wait(".pointer-touched:has-text('use a mouse or a pen')")
    assert not tab.shows(".pointer-pad[data-gripped]")


@pytest.mark.parametrize(
    ("trouble", "device", "said"),
    [
        (Trouble.TWO, "gamepad and keyboard", "Two devices at once, gamepad and keys: let go of one."),
        (Trouble.GONE, "gamepad", "The gamepad is gone: plug it in again, or use another device."),
        (Trouble.NOT_AT_REST, "gamepad 2", "The gamepad 2 is not at rest"),
        (Trouble.ABSENT, "spacemouse", "No 3-D mouse here"),
    ],
)
def test_what_is_wrong_with_a_device_is_said_with_what_to_do(viewed, station, trouble, device, said):
    _, feed = station
    feed.view = replace(feed.view, master=MasterState(device="gamepad", trouble=trouble, trouble_with=device))
    viewed.wait(f".device-trouble:has-text('{said}')")


def test_the_pad_of_the_device_that_is_taken_into_use_comes_forward(tab, calm_station):
    _, feed = calm_station
    tab.wait(".device-pad[data-pad-of=keyboard]")
    feed.view = replace(feed.view, master=MasterState(device="gamepad"))
    tab.wait(".device-pad[data-pad-of=gamepad]")
    tab.wait("[data-value=device-name]:text-is('gamepad')")


def test_a_master_that_is_not_heard_for_a_moment_takes_no_pad_away(tab, calm_station):
    _, feed = calm_station
    show_pad(tab, "pointer")
    heard = feed.view
    feed.view = replace(heard, master=None)
    tab.wait(".devices[data-device='']")
    feed.view = heard
    tab.wait(".devices[data-device=keyboard]")
    tab.wait(".device-pad[data-pad-of=pointer]")


def test_a_tab_that_was_clicked_leaves_space_to_finish(tab, pressed):
    show_pad(tab, "gamepad")
    tab.page.keyboard.press("Space")
    assert pressed() == ["finish"]
