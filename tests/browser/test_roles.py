"""Operator, second operator, observer and supervisor at one station, each in a browser of their own."""

from dataclasses import replace

import pytest

from protocol.messages import Light, Role, SafetyState
from services.station.neighbours import Neighbour

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]


@pytest.fixture
def join(tab, open_tab, station):
    """A function that lets somebody come with a name and a role, both in the address."""

    def one(name, role):
        opened = open_tab(f"{station[0].url}/?name={name}&role={role}")
        opened.wait("body[data-link=view-only]")
        tab.wait(f".who-others:has-text('{name}')")
        return opened

    return one


def seen(tab, group):
    """The names that a page lists in a group."""
    return tab.page.text_content(f"[data-value=people-{group}]")


def test_an_observer_watches_seen_by_all_and_claims_nothing(tab, join, station, pressed):
    page, _ = station
    carl = join("Carl", "observer")
    carl.wait(".banner-view-only:has-text('You are watching')")
    carl.wait(".light[data-light=red]")
    carl.wait(".who:has-text('commands'):not(:has-text('You command'))")
    assert not carl.shows("[data-action=take_input], [data-action=seize_input], [data-action=revoke]")
    carl.page.keyboard.down("e")
    carl.page.keyboard.press("Space")
    tab.wait(".who-others:has-text('Carl watches')")
    tab.wait(".who:has-text('You command')")
    assert page.take_input().keys == ()
    carl.page.keyboard.press("Escape")
    assert pressed() == ["stop"]


@pytest.mark.parametrize("role", [role.value for role in Role])
def test_everybody_may_stop_and_is_named(join, presses, role):
    join("Zoe", role).page.keyboard.press("Escape")
    (press,) = presses()
    assert (press.action, press.by) == ("stop", "Zoe")


def test_who_leaves_is_listed_no_more(tab, join):
    carl = join("Carl", "observer")
    eve = join("Eve", "supervisor")
    tab.wait(".who-others:has-text('Carl watches, Eve supervises')")
    assert (seen(tab, "watching"), seen(tab, "supervising")) == ("Carl", "Eve")
    carl.page.close()
    tab.page.wait_for_selector(".who-others:text-is('Eve supervises')", state="attached", timeout=2_000)
    assert seen(eve, "supervising") == "Eve"


def test_a_second_operator_takes_the_input_over_with_a_reason_that_the_first_is_shown(tab, join):
    bob = join("Bob", "operator")
    bob.page.click("[data-action=seize_input]")
    bob.page.keyboard.type("she has left")
    bob.page.keyboard.press("Enter")
    bob.wait("body[data-link=armed]")
    tab.wait("body[data-link=view-only] .banner-view-only:has-text('Bob has taken the input over: she has left')")
    bob.page.click("body", position={"x": 5, "y": 400})
    tab.press("take_input", lambda: bob.shows(".banner-asked:has-text('asks for the input')"))
    bob.press("give_input", lambda: tab.shows("body[data-link=armed]"))


def test_a_reason_that_says_nothing_takes_nothing(tab, join):
    bob = join("Bob", "operator")
    bob.page.click("[data-action=seize_input]")
    bob.page.keyboard.type("no")
    bob.page.keyboard.press("Enter")
    bob.wait(".reason:visible")
    tab.wait("body[data-link=armed]")


def test_a_supervisor_ends_the_authority_with_a_reason_and_cannot_steer(tab, join, station, presses):
    page, _ = station
    eve = join("Eve", "supervisor")
    eve.wait(".banner-view-only:has-text('You supervise')")
    assert not eve.shows("[data-action=take_input], [data-action=seize_input]")
    eve.page.keyboard.down("e")
    eve.page.click("[data-action=revoke]")
    eve.page.keyboard.type("the lab closes")
    eve.page.keyboard.press("Enter")
    (press,) = presses()
    assert (press.action, press.argument, press.by) == ("revoke", "the lab closes", "Eve")
    assert page.take_input().keys == ()


def test_a_name_is_given_in_the_page_refused_in_a_line_and_remembered(tab, join):
    bob = join("Bob", "operator")
    bob.page.click(".who > summary")
    bob.page.fill(".who-name", "<b>")
    bob.page.click(".who-say")
    bob.wait(".who-fault:has-text('is no name')")
    bob.page.fill(".who-name", "Zoë van Dijk")
    bob.page.select_option(".who-role", "observer")
    bob.page.click(".who-say")
    bob.wait(".who-you:text-is('Watching as Zoë van Dijk')")
    assert bob.page.text_content(".who-fault") == ""
    tab.wait(".who-others:has-text('Zoë van Dijk watches')")
    bob.page.reload()
    bob.wait("body[data-link=view-only]")
    tab.wait(".who-others:has-text('Zoë van Dijk watches')")


def test_a_role_that_does_not_exist_is_refused_in_a_line_and_watches(tab, join):
    boss = join("Max", "boss")
    boss.page.click(".who > summary")
    boss.wait(".who-fault:has-text(\"There is no role 'boss'\")")
    tab.wait(".who-others:has-text('Max watches')")


GARAGE = Neighbour("garage", Light.GREEN, "bob", SafetyState(emergency_stop=False), stopping=False, page="")


def test_another_robot_is_seen_and_stopped_from_every_page_of_this_one(tab, join, station, presses):
    _, feed = station
    assert not tab.shows(".robots")
    feed.view = replace(feed.view, neighbours=(GARAGE,))
    carl = join("Carl", "observer")
    for page in (tab, carl):
        page.wait(".robot:has-text('garage'):has-text('bob commands')[data-light=green]")
        page.page.click(".robot-stop:visible")
        (press,) = presses()
        assert (press.action, press.argument) == ("stop_other", "garage")
    feed.view = replace(feed.view, neighbours=(replace(GARAGE, stopping=True),))
    tab.wait(".robot-stop:text-is('Stop not confirmed')")
    stopped = SafetyState(emergency_stop=True, standing=True)
    feed.view = replace(feed.view, neighbours=(replace(GARAGE, safety=stopped),))
    tab.wait(".robot[data-stop=stopped] .robot-stop:text-is('Stopped')")
    tab.wait(".stop[data-stop=ready]")


def test_the_way_to_another_robot_s_page_takes_name_and_role_along(tab, join, station):
    page, feed = station
    feed.view = replace(feed.view, neighbours=(replace(GARAGE, page=f"{page.url}/"),))
    carl = join("Carl", "observer")
    carl.page.click(".robot-way:visible")
    carl.page.wait_for_url("**/?name=Carl&role=observer")
    tab.wait(".who-others:has-text('Carl watches')")
