"""Behind the door nobody is but who has logged in, as who the account says, until the session ends."""

import pytest
from house import ANNA, DIGEST, EVERYBODY, Browser, Tab
from websockets.exceptions import ConnectionClosed

from protocol.messages import OperatorInput, Person, Role
from services.accounts.account import Account
from tests.system.harness import eventually

WITHIN_S = 20.0
BEHIND = ("/view/description.json", "/history/1/1", "/assets/station.css", "/assets/js/station.js", "/nothing")


def turned_away(link):
    """The code with which a link is closed."""
    try:
        while True:
            link.recv(timeout=WITHIN_S)
    except ConnectionClosed as closed:
        return closed.rcvd.code


def test_without_a_session_there_is_nothing_but_the_log_in(browser):
    page = browser.ask("GET", "/?role=observer&name=Carl&other=1")
    assert (page.status, page.headers["Location"]) == (303, "/login?name=Carl&role=observer")
    for path in BEHIND:
        assert browser.ask("GET", path).status == 401
    assert browser.ask("POST", "/logout", "").status == 401
    assert browser.ask("HEAD", "/view/description.json").status == 401
    with browser.link() as link:
        assert turned_away(link) == 4401


def test_who_comes_from_another_site_s_page_is_let_ask_anew_so_that_the_browser_shows_its_cookie(browser, inside):
    stranger = Browser(inside.page)
    came = stranger.ask("GET", "/?role=observer&name=Carl%20B", Sec_Fetch_Site="cross-site")
    assert (came.status, came.headers["Refresh"]) == (200, "0; url=/?name=Carl+B&role=observer")
    again = stranger.ask("GET", "/?name=Carl+B&role=observer", Sec_Fetch_Site="same-origin")
    assert (again.status, again.headers["Location"]) == (303, "/login?name=Carl+B&role=observer")
    assert stranger.ask("GET", "/view/description.json", Sec_Fetch_Site="cross-site").status == 401


@pytest.mark.parametrize("token", ["", "x", "A" * 43, "A" * 5000])
def test_a_token_that_nobody_was_given_opens_nothing(open_house, browser, token):
    browser.cookies[f"retouch-{open_house.page.url.rpartition(':')[2]}"] = token
    assert browser.ask("GET", "/").status == 303
    assert browser.ask("GET", "/view/description.json").status == 401


def test_the_account_says_who_somebody_is_and_what_they_may(open_house, inside):
    page = open_house.page
    with inside.link() as link:
        tab = Tab(link, name="Eve", role="supervisor")
        eventually(lambda: page.attendance().people, WITHIN_S, "the tab is there")
        assert page.attendance().people == (Person("Anna", Role.OPERATOR, has_input=True),)
        tab.press("revoke", "I say so")
        tab.press("stop")
        presses = []
        eventually(lambda: presses.extend(page.take_presses()) or presses, WITHIN_S, "the stop is pressed")
        assert [(press.action, press.by) for press in presses] == [("stop", "Anna")]


def test_an_observer_commands_nothing_and_stops(open_house, browser):
    page = open_house.page
    browser.log_in("carl")
    with browser.link() as link:
        tab = Tab(link, name="Anna", role="operator")
        for action in ("take_input", "execute", "finish"):
            tab.press(action, "I say so")
        tab.hold("KeyQ")
        tab.press("stop")
        presses = []
        eventually(lambda: presses.extend(page.take_presses()) or presses, WITHIN_S, "the stop is pressed")
        assert [(press.action, press.by) for press in presses] == [("stop", "Carl")]
        assert page.attendance().people == (Person("Carl", Role.OBSERVER),)
        assert page.take_input() == OperatorInput()


def holds(page, tab):
    """Whether a key counts by now, that is held on."""
    tab.hold() if page.take_input().keys == () and not page.take_input().focused else tab.hold("KeyQ")
    return page.take_input().keys == ("KeyQ",)


ENDS = {
    "log-out": lambda opened, browser: browser.log_out(),
    "removal": lambda opened, _: opened.change(EVERYBODY.without("Anna")),
    "password": lambda opened, _: opened.change(
        EVERYBODY.with_changed(Account("Anna", Role.OPERATOR, DIGEST.format("D" * 22)))
    ),
    "role": lambda opened, _: opened.change(EVERYBODY.with_changed(Account("Anna", Role.OBSERVER, ANNA.password))),
    "garbage": lambda opened, _: opened.accounts.write_bytes(b"\xffnonsense"),
    "no file": lambda opened, _: opened.accounts.unlink(),
}


@pytest.mark.parametrize("end", ENDS)
def test_when_a_session_ends_its_tabs_are_closed_and_nothing_held_in_them_counts(open_house, inside, end):
    page = open_house.page
    with inside.link() as link:
        tab = Tab(link)
        eventually(lambda: holds(page, tab), WITHIN_S, "the key counts")
        ENDS[end](open_house, inside)
        assert turned_away(link) == 4401
    assert page.take_input() == OperatorInput()
    eventually(lambda: page.figures()[0].value == 0, WITHIN_S, "the tab is gone")
    assert page.attendance().people == ()
    assert inside.ask("GET", "/").status == 303
    with inside.link() as link:
        assert turned_away(link) == 4401


def test_somebody_elses_session_goes_on(open_house, inside):
    other = Browser(open_house.page)
    other.log_in("Carl")
    with other.link() as link:
        Tab(link)
        inside.log_out()
        open_house.change(EVERYBODY.without("Anna"))
        eventually(lambda: inside.log_in().status == 403, WITHIN_S, "Anna has no account")
        link.recv(timeout=WITHIN_S)
        assert open_house.page.attendance().people == (Person("Carl", Role.OBSERVER),)


def test_who_has_just_got_an_account_gets_in_at_once(open_house, browser):
    open_house.change(EVERYBODY.without("Carl"))
    assert browser.log_in("Carl").status == 403
    open_house.change(EVERYBODY)
    assert browser.log_in("Carl").status == 303


def test_while_the_accounts_cannot_be_read_nobody_gets_in_and_the_log_says_why(open_house, browser, caplog):
    open_house.accounts.write_bytes(b"\xffnonsense")
    answer = browser.log_in()
    assert answer.status == 503
    assert "Nobody can log in now" in answer.text
    assert "accounts.json holds no accounts" in caplog.text
    open_house.change(EVERYBODY)
    assert browser.log_in().status == 303


def test_who_logs_in_again_has_another_token_and_the_old_one_is_worth_nothing(inside):
    before = dict(inside.cookies)
    inside.log_in("Carl")
    assert inside.cookies != before
    inside.cookies = before
    assert inside.ask("GET", "/").status == 303


def test_nothing_of_the_page_is_kept_by_what_stands_between(inside):
    for path in ("/", "/assets/station.css"):
        assert "public" not in inside.ask("GET", path).headers.get("Cache-Control", "")
