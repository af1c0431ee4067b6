"""What interrupts an operator: a page that hangs, a link that is lost, a reload in the middle, a laptop that sleeps."""

import pytest
from hand import Hand

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

HANG = """() => setTimeout(() => {
    const request = new XMLHttpRequest();
    request.open("GET", "/hung", false);
    request.send();
})"""
"""The page waits for an answer, and does nothing else meanwhile."""

SLEEPS = """
    const [now, today] = [performance.now.bind(performance), Date.now.bind(Date)];
    window.slept = { clock: 0, day: 0 };
    performance.now = () => now() - window.slept.clock;
    Date.now = () => today() + window.slept.day;
"""
"""The clock of a tab stands still while its computer sleeps; the time of day does not."""

WAKES = "() => { window.slept = { clock: 800, day: 3_600_000 }; }"


@pytest.fixture
def hang(eventually):
    """A function that lets a page hang, and gives a function that lets it go on; at the latest with the test's end."""
    asked = []

    def keep(route):
        asked.append(route)

    def ask(tab):
        tab.page.route("**/hung", keep)
        tab.page.evaluate(HANG)
        eventually(lambda: asked or tab.page.wait_for_timeout(20))
        return lambda: asked.pop().fulfill(body="")

    yield ask
    for route in asked:
        route.fulfill(body="")


@pytest.fixture
def cut(cable):
    """A function that cuts a tab's link, and gives a function that lets another one come about."""

    def one(tab):
        del tab
        cable.cut()
        return lambda: cable.mend(lost=True)

    return one


@pytest.fixture(params=["hang", "cut"])
def interrupt(request):
    """A function that interrupts a tab, and gives a function that ends this."""
    return request.getfixturevalue(request.param)


@pytest.fixture
def two_operators(open_seated, open_tab, station, cable):
    """A tab that has the input, over a link that can be cut, and another operator's."""
    first = open_seated(cable.url)
    second = open_tab(f"{station[0].url}/?name=Bob&role=operator")
    second.wait("body[data-link=view-only]")
    return first, second


def test_who_takes_over_meanwhile_keeps_the_input_and_the_first_is_told(two_operators, station, eventually, interrupt):
    page, _ = station
    tab, bob = two_operators
    Hand(tab, page, 20.0).hold("KeyE")
    end = interrupt(tab)
    eventually(lambda: page.take_input().keys == ())
    bob.page.click("[data-action=seize_input]")
    bob.page.keyboard.type("she does not answer")
    bob.page.keyboard.press("Enter")
    bob.wait("body[data-link=armed]")
    end()
    tab.wait("body[data-link=view-only] .banner-view-only:has-text('Bob has taken the input over')")
    tab.wait("[data-key=KeyE][data-held]")
    assert page.take_input().keys == ()
    tab.press("take_input", lambda: bob.shows(".banner-asked:has-text('asks for the input')"))
    bob.press("give_input", lambda: tab.shows("body[data-link=armed]"))


def test_a_key_that_is_held_over_a_reload_counts_once_it_was_let_go(tab, hand, station, eventually):
    page, _ = station
    hand.hold("KeyE")
    tab.page.reload(wait_until="commit")
    eventually(lambda: page.take_input().keys == ())
    tab.wait("body[data-link=armed]")
    tab.page.keyboard.down("KeyE")  # as a keyboard repeats it
    eventually(lambda: page.take_input().focused)
    assert page.take_input().keys == ()
    hand.hold("KeyE")


def test_a_laptop_that_wakes_up_steers_and_presses_nothing_of_before(open_seated, station, cable, eventually):
    page, _ = station
    tab = open_seated(cable.url, script=SLEEPS)
    hand = Hand(tab, page, 20.0)
    hand.hold("KeyE")
    cable.cut()
    tab.page.click("[data-action=teach]")
    eventually(lambda: page.take_input().keys == ())
    tab.page.evaluate(WAKES)
    cable.mend(lost=True)
    tab.wait(".banner-dropped:visible:has-text('Teach this')")
    tab.wait("body[data-link=armed]")
    tab.wait("[data-key=KeyE][data-held]")
    assert page.take_input().keys == ()
    assert page.take_presses() == []
    hand.hold("KeyQ")
