"""Who commands, with several tabs open in a real browser."""

from dataclasses import replace

import msgspec
import pytest

from services.station.page import seat
from services.station.press import Press

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]


@pytest.fixture
def second(tab, open_tab):
    """A tab that looks on."""
    opened = open_tab()
    opened.wait("body[data-link=view-only]")
    return opened


def take(tab):
    """Ask for the input."""
    tab.press("take_input", lambda: tab.shows(".banner-view-only:has-text('without an answer'), body[data-link=armed]"))


def give(tab):
    """Give the input to who asks for it."""
    tab.wait(".banner-asked:has-text('asks for the input')")
    tab.press("give_input", lambda: tab.shows("body[data-link=view-only]"))


def test_a_second_tab_looks_on_and_the_first_keeps_the_input(tab, second, station):
    _, feed = station
    second.wait(".light[data-light=red]")
    feed.view = replace(feed.view, notice="said since")
    tab.wait("body[data-link=armed]:has(.notice:text-is('said since'))")


def test_whoever_sits_is_asked_and_may_keep_the_input(tab, second):
    take(second)
    tab.wait(".banner-asked:has-text('asks for the input')")
    tab.press("keep_input", lambda: not tab.shows(".banner-asked"))
    second.wait(".banner-view-only:has-text('keeps it')")
    tab.wait("body[data-link=armed]")
    second.wait("body[data-link=view-only]")


def test_given_input_moves_and_counts_and_can_be_given_back(tab, second, station, eventually):
    page, _ = station
    take(second)
    give(tab)
    second.wait("body[data-link=armed]")
    second.page.keyboard.press("KeyA")
    eventually(lambda: page.take_input().focused)
    take(tab)
    give(second)
    tab.wait("body[data-link=armed]")


def test_silence_gives_the_input(tab, second, monkeypatch):
    monkeypatch.setattr(seat, "ASKED_NS", 2_000_000_000)
    take(second)
    second.wait("body[data-link=armed]")
    tab.wait("body[data-link=view-only]")
    take(tab)
    give(second)
    tab.wait("body[data-link=armed]")


def test_who_commands_gives_the_robot_to_another_station_or_keeps_it(tab, station, clicked):
    _, feed = station
    asked = msgspec.structs.replace(feed.view.authority, asked=7, asked_by="bob", asked_left=9.0)
    for action in ("keep_authority", "give_authority"):
        feed.view = replace(feed.view, authority=asked)
        tab.wait(".banner-asked:has-text('bob asks for the robot')")
        assert clicked(f"[data-action={action}]") == [Press(action)]
        feed.view = replace(feed.view, authority=msgspec.structs.replace(asked, asked=0))
        tab.wait(".banner-asked[data-value=robot-asked]", state="hidden")


def test_a_take_over_is_pressed_with_a_reason_and_typing_it_steers_nothing(tab, station, presses):
    page, feed = station
    watching = msgspec.structs.replace(feed.view.teaching, phase="watching", actions=("ask", "take_over"))
    feed.view = replace(feed.view, teaching=watching, authority_is_mine=False)
    tab.page.click("[data-action=take_over]:enabled")
    tab.page.keyboard.type("ed")
    tab.page.keyboard.press("Enter")
    tab.wait(".reason:visible")
    tab.page.keyboard.type(" is at home ")
    assert page.take_input().keys == ()
    tab.page.keyboard.press("Enter")
    (press,) = presses()
    assert (press.action, press.argument) == ("take_over", "ed is at home")
    tab.wait(".reason", state="hidden")


def test_a_take_over_that_was_thought_better_of_is_none(tab, station, eventually):
    page, feed = station
    watching = msgspec.structs.replace(feed.view.teaching, phase="watching", actions=("take_over",))
    feed.view = replace(feed.view, teaching=watching)
    tab.page.click("[data-action=take_over]:enabled")
    tab.page.keyboard.type("bob is at home")
    tab.page.click(".reason-cancel")
    tab.wait(".reason", state="hidden")
    tab.page.keyboard.down("e")
    eventually(lambda: page.take_input().keys == ("KeyE",))
    tab.page.keyboard.up("e")
    assert page.take_presses() == []


def test_a_tab_finds_its_seat_again_after_a_reload_and_resumes_nothing(tab, second, station, eventually, clicked):
    page, _ = station
    eventually(lambda: page.take_input().present)
    tab.page.reload(wait_until="commit")
    eventually(lambda: not page.take_input().present)
    second.page.reload()
    tab.wait("body[data-link=armed]")
    second.wait("body[data-link=view-only]")
    assert clicked("[data-action=teach]") == [Press("teach")]


def test_a_stranger_s_page_cannot_open_the_link(browser, station):
    page, _ = station
    stranger = browser.new_page()
    opened = stranger.evaluate(
        """(url) => new Promise((done) => {
            const socket = new WebSocket(url);
            socket.onopen = () => done(true);
            socket.onerror = () => done(false);
        })""",
        page.url.replace("http", "ws") + "/link",
    )
    stranger.close()
    assert not opened
