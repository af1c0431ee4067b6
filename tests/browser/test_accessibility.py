"""The page is for everybody: no violation that axe knows, all of it by keyboard, without colour and without motion."""

import pytest
from states import states

pytest.importorskip("axe_playwright_python")

pytestmark = pytest.mark.browser

STATES = states()


@pytest.fixture
def violations(axe):
    """A function that says what axe finds in a tab as it is."""
    return lambda tab: axe(tab.page)


def show(tab, feed, view):
    """Show a view, until its sentence is there."""
    feed.view = view
    words = view.teaching.text if view.teaching is not None else "The station is starting."
    tab.wait(f'.light-text:text-is("{words}")')


@pytest.mark.parametrize("scheme", ["dark", "light"])
def test_axe_finds_nothing_in_any_state(viewed, station, violations, scheme):
    # At once: on a busy computer a colour that fades is seen halfway.
    viewed.page.emulate_media(color_scheme=scheme, reduced_motion="reduce")
    found = {}
    for name, view in STATES.items():
        show(viewed, station[1], view)
        found[name] = violations(viewed)
    assert found == {name: [] for name in STATES}


@pytest.mark.parametrize("size", [(390, 844), (960, 540)])
def test_axe_finds_nothing_in_a_small_window(viewed, station, violations, size):
    viewed.page.set_viewport_size({"width": size[0], "height": size[1]})
    show(viewed, station[1], STATES["failed"])
    assert violations(viewed) == []


def test_axe_finds_nothing_in_what_opens(tab, station, violations):
    show(tab, station[1], STATES["failed"])
    tab.page.click(".health > summary")
    assert violations(tab) == []
    tab.page.click(".legend", force=True)
    tab.wait(".figures", "hidden")
    tab.page.click("[data-action=undo]")
    tab.wait(".confirm:not([hidden])")
    assert violations(tab) == []
    tab.page.click(".confirm-no")
    tab.page.click(".tour-open")
    tab.wait(".tour:not([hidden])")
    assert violations(tab) == []
    for pad in ("gamepad", "pointer"):
        tab.page.click(f"[data-pad-for={pad}]")
        assert violations(tab) == []


def test_who_looks_on_sees_no_violation(tab, open_tab, violations):
    looking_on = open_tab()
    looking_on.wait("body[data-link=view-only]")
    assert violations(looking_on) == []


def focused(tab):
    """What has the focus, and whether it is seen to."""
    return tab.page.evaluate(
        """() => {
            const of = document.activeElement;
            const style = getComputedStyle(of);
            const name = of.dataset.action ?? of.dataset.swap ?? of.dataset.padFor ?? of.className.split(" ").pop();
            return [name || of.tagName, of === document.body || style.outlineStyle !== "none"];
        }"""
    )


def test_everything_is_reached_by_tab_in_the_order_in_which_it_is_read_and_is_seen_to_be(tab, station):
    show(tab, station[1], STATES["failed"])
    reached = []
    for _ in range(40):
        tab.page.keyboard.press("Tab")
        name, is_seen = focused(tab)
        assert is_seen, name
        if name == "BODY":
            break
        reached.append(name)
    wanted = ["skip", "view", "head", "wrist", "refine", "execute", "next", "undo", "end", "keyboard", "stop"]
    assert [name for name in reached if name in wanted] == wanted


def test_a_person_teaches_by_keyboard_alone(tab, station, pressed):
    show(tab, station[1], STATES["failed"])
    tab.page.keyboard.press("Tab")
    tab.page.keyboard.press("Enter")
    while focused(tab)[0] != "refine":
        tab.page.keyboard.press("Tab")
    tab.page.keyboard.press("Enter")
    assert pressed() == ["refine"]
    show(tab, station[1], STATES["correcting"])
    while focused(tab)[0] != "finish":
        tab.page.keyboard.press("Tab")
    tab.page.keyboard.press("Space")
    assert pressed() == ["finish"]


def test_what_takes_something_away_is_asked_twice(tab, station, pressed, eventually):
    show(tab, station[1], STATES["failed"])
    tab.page.click("[data-action=undo]")
    tab.wait(".confirm:visible:has-text('Take back')")
    assert focused(tab)[0] == "confirm-no"
    tab.page.keyboard.press("Enter")
    tab.wait(".confirm", "hidden")
    tab.page.click("[data-action=undo]")
    tab.page.click(".confirm-yes")
    assert pressed() == ["undo"]
    tab.page.click("[data-action=end]")
    tab.wait(".confirm:visible:has-text('End this session')")
    tab.page.click(".confirm-yes")
    assert pressed() == ["end"]


def test_a_question_goes_with_the_button_that_asked_it(tab, station):
    show(tab, station[1], STATES["failed"])
    tab.page.click("[data-action=undo]")
    tab.wait(".confirm:visible")
    show(tab, station[1], STATES["alone"])
    tab.wait(".confirm", "hidden")


def test_the_views_change_places_by_key_and_by_hand(tab):
    tab.page.focus("[data-swap=head]")
    tab.page.keyboard.press("Enter")
    tab.wait(".scene[data-main=head]")
    assert tab.page.locator("[data-stage=head]").bounding_box()["width"] > 900
    tab.page.click("[data-swap=live]")
    tab.wait(".scene[data-main=live]")


def test_the_view_turns_and_comes_closer_by_key(tab, eventually):
    tab.wait(".scene[data-view=live]")
    tab.page.focus(".view")
    before = tab.page.locator(".view").screenshot()
    for key in ("ArrowLeft", "ArrowUp", "+"):
        tab.page.keyboard.press(key)
    eventually(lambda: tab.page.locator(".view").screenshot() != before or tab.page.wait_for_timeout(50))


def test_lights_differ_by_shape_and_word_and_not_by_colour_alone(viewed, station):
    shown = set()
    for name in ("alone", "learning", "paused", "correcting"):
        show(viewed, station[1], STATES[name])
        symbol = viewed.page.evaluate(
            """() => {
                const lamps = [...document.querySelectorAll(".lamp")];
                const colours = lamps.map((lamp) => getComputedStyle(lamp).color);
                const lit = lamps.filter((_, i) => colours.filter((other) => other === colours[i]).length === 1);
                return lit.map((lamp) => lamp.className + lamp.querySelector("use").getAttribute("href"));
            }"""
        )
        assert len(symbol) == 1
        shown.add((symbol[0], viewed.page.inner_text(".light-word")))
    assert len(shown) == 4


def test_who_asks_for_less_motion_gets_none(viewed):
    viewed.page.emulate_media(reduced_motion="reduce")
    moving = viewed.page.evaluate(
        """[...document.querySelectorAll("*")].filter((e) => {
            const { transitionDuration, animationName } = getComputedStyle(e);
            return animationName !== "none" || transitionDuration.split(",").some((d) => parseFloat(d) > 0);
        }).length"""
    )
    viewed.page.emulate_media(reduced_motion="no-preference")
    assert moving == 0


def test_who_asks_for_more_contrast_gets_it(viewed):
    line = "getComputedStyle(document.documentElement).getPropertyValue('--line')"
    before = viewed.page.evaluate(line)
    viewed.page.emulate_media(contrast="more")
    after = viewed.page.evaluate(line)
    viewed.page.emulate_media(contrast="no-preference")
    assert before != after


def test_what_changes_is_read_out_and_in_its_urgency(viewed):
    roles = viewed.page.evaluate(
        "[...document.querySelectorAll('[role=status], [role=alert]')].map((e) => e.className || e.dataset.value)"
    )
    assert {"light-words", "outcome", "unconfirmed", "stopped", "banner banner-offline"} <= set(roles)
