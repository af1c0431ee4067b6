"""Logging in and out in a browser, over HTTPS, at a page that commands; and that everything ends with the session."""

import re

import pytest

pytest.importorskip("argon2")

from playwright.sync_api import expect

from protocol.messages import OperatorInput, Role
from services.accounts.account import Account, Accounts
from services.accounts.file import AccountsFile, save
from services.accounts.passwords import digest, is_right
from services.certificates.authority import make_authority
from services.station.page.login.judge import Judge
from tests.browser import scripts
from tests.ports import free_port

pytestmark = [pytest.mark.browser, pytest.mark.undrawn]

PASSWORDS = {"Anna": "correct horse", "Carl": "battery staple"}
ROLES = {"Anna": Role.OPERATOR, "Carl": Role.OBSERVER}
WITHIN_MS = 30_000
SIZE = {"width": 1600, "height": 900}


@pytest.fixture(scope="module")
def everybody():
    return Accounts(tuple(Account(name, ROLES[name], digest(password)) for name, password in PASSWORDS.items()))


@pytest.fixture
def accounts(tmp_path, everybody):
    """A function that writes the file of accounts."""

    def write(accounts):
        save(accounts, tmp_path / "accounts.json")

    write(everybody)
    return write


@pytest.fixture
def station(tmp_path, accounts):
    """A page at which people log in, under a certificate of an authority's."""
    from harness import served

    authority = make_authority(tmp_path / "certs")
    authority.issue("page.desk", hosts=("127.0.0.1",))
    judge = Judge(AccountsFile(tmp_path / "accounts.json"), is_right)
    certificate = str(authority.folder / "page.desk.pem")
    with served(judge=judge, port=free_port(), certificate=certificate) as (page, feed):
        yield page, feed


@pytest.fixture
def visit(browser, station):
    """A function that comes to the page in a browser of one's own; what it asked for, and complained of, beside."""
    contexts = []

    def come(path="/", **options):
        contexts.append(browser.new_context(**{"ignore_https_errors": True, "viewport": SIZE} | options))
        contexts[-1].set_default_timeout(WITHIN_MS)
        tab = contexts[-1].new_page()
        tab.add_init_script(f"{scripts.TOURED} {scripts.UNDRAWN}")
        tab.asked, tab.links = [], []
        tab.on("websocket", lambda link: tab.links.append(link.url))
        tab.on("request", lambda request: tab.asked.append(request.url))
        tab.goto(f"{station[0].url}{path}")
        return tab

    yield come
    for context in contexts:
        context.close()


def log_in(tab, name, password=None):
    tab.fill("[name=name]", name)
    tab.fill("[name=password]", PASSWORDS[name] if password is None else password)
    tab.keyboard.press("Enter")


@pytest.fixture
def anna(visit, station, eventually):
    """A tab of Anna's that commands."""
    tab = visit()
    log_in(tab, "Anna")
    tab.wait_for_selector("body[data-link=armed]")
    eventually(lambda: station[0].take_input().focused or tab.wait_for_timeout(20))
    return tab


def held(tab, page, eventually):
    """Press a key and hold it, until it counts."""
    tab.keyboard.down("e")
    eventually(lambda: page.take_input().keys or tab.wait_for_timeout(20))


def test_who_logs_in_commands_under_their_own_name_over_https_alone(anna, station, eventually):
    page, _ = station
    assert anna.url == f"{page.url}/"
    assert {url.partition(":")[0] for url in anna.asked} <= {"https", "wss", "data", "blob"}
    assert page.take_input().operator == "Anna"
    held(anna, page, eventually)
    anna.keyboard.up("e")
    anna.keyboard.press("Escape")
    presses = []
    eventually(lambda: presses.extend(page.take_presses()) or presses or anna.wait_for_timeout(20))
    assert [(press.action, press.by) for press in presses] == [("stop", "Anna")]


def test_a_wrong_password_is_told_and_then_waited_for(visit):
    tab = visit("/?name=Anna&role=observer")
    assert re.search(r"/login\?name=Anna&role=observer$", tab.url)
    expect(tab.locator("[name=name]")).to_have_value("Anna")
    expect(tab.locator("[name=password]")).to_be_focused()
    for _ in range(3):
        log_in(tab, "Anna", "wrong")
        expect(tab.get_by_role("alert")).to_have_text("Name or password is wrong.")
    log_in(tab, "Anna")
    expect(tab.get_by_role("alert")).to_have_text("Too many attempts: wait 1 s, then try again.")
    tab.wait_for_timeout(1100)
    log_in(tab, "Anna")
    tab.wait_for_selector("body[data-link=view-only]")
    assert tab.url.endswith("/?role=observer")


def test_an_observer_may_choose_nothing_and_stop(visit, station, eventually):
    page, _ = station
    tab = visit("/?role=operator&name=Anna")
    log_in(tab, "Carl")
    tab.wait_for_selector("body[data-link=view-only]")
    tab.click(".who > summary")
    expect(tab.locator(".who-you")).to_have_text("Watching as Carl")
    expect(tab.locator(".who-fault")).to_have_text("Your account lets you watch.")
    for hidden in (".who-name", ".who-role", ".who-say"):
        expect(tab.locator(hidden)).to_be_hidden()
    tab.keyboard.press("Escape")
    presses = []
    eventually(lambda: presses.extend(page.take_presses()) or presses or tab.wait_for_timeout(20))
    assert [(press.action, press.by) for press in presses] == [("stop", "Carl")]


def test_an_operator_may_choose_to_look_on_and_nothing_more(anna, station):
    anna.click(".who > summary")
    expect(anna.locator(".who-name")).to_be_hidden()
    assert anna.locator(".who-role option:not([hidden])").all_text_contents() == ["operate", "watch"]
    expect(anna.locator(".who-role")).to_have_value("operator")
    anna.select_option(".who-role", "observer")
    anna.click(".who-say")
    anna.wait_for_selector("body[data-link=view-only]")
    assert station[0].take_input() == OperatorInput()


def test_who_logs_out_is_out_in_every_tab_and_comes_back_by_no_way(anna, station):
    other = anna.context.new_page()
    other.add_init_script(f"{scripts.TOURED} {scripts.UNDRAWN}")
    other.goto(station[0].url)
    other.wait_for_selector("body[data-link=view-only]")
    anna.bring_to_front()
    anna.click(".who > summary")
    anna.click(".log-out button")
    anna.wait_for_url("**/login?said=out")
    expect(anna.get_by_role("alert")).to_have_text("You have logged out.")
    other.wait_for_url("**/login?said=ended")
    expect(other.get_by_role("alert")).to_have_text("You are not logged in any more.")
    assert anna.context.cookies() == []
    assert station[0].take_input() == OperatorInput()
    anna.go_back()
    anna.wait_for_url("**/login*")


def test_a_key_that_is_held_counts_no_more_once_the_session_ends_and_the_tab_goes_to_the_log_in(
    anna, station, accounts, everybody, eventually
):
    page, _ = station
    held(anna, page, eventually)
    accounts(everybody.without("Anna"))
    eventually(lambda: page.take_input() == OperatorInput() or anna.wait_for_timeout(20))
    anna.wait_for_url("**/login?said=ended")
    assert len(anna.links) == 1, "it did not dial again"
    assert page.take_input() == OperatorInput()
    log_in(anna, "Anna")
    expect(anna.get_by_role("alert")).to_have_text("Name or password is wrong.")
    accounts(everybody)
    log_in(anna, "Anna")
    anna.wait_for_selector("body[data-link=armed]")


def test_a_stop_that_nobody_took_as_the_session_ended_is_pressed_once_somebody_has_logged_in(
    anna, station, accounts, everybody, eventually
):
    page, _ = station
    accounts(everybody.without("Anna"))
    anna.wait_for_url("**/login?said=ended")
    anna.evaluate("sessionStorage.setItem('retouch-stop', 'due')")  # as the page's script keeps it
    log_in(anna, "Carl")
    presses = []
    eventually(lambda: presses.extend(page.take_presses()) or presses or anna.wait_for_timeout(20))
    assert [(press.action, press.by) for press in presses] == [("stop", "Carl")]


def test_who_is_logged_in_here_needs_no_password_on_the_way_from_another_site(anna, station):
    here = f"{station[0].url}/"
    other = anna.context.new_page()
    other.add_init_script(f"{scripts.TOURED} {scripts.UNDRAWN}")
    other.goto(here.replace("127.0.0.1", "localhost"))
    expect(other.locator("[name=password]")).to_be_visible()
    other.evaluate(
        "(href) => document.body.append(Object.assign(document.createElement('a'), { href, id: 'way' }))", here
    )
    other.evaluate("document.getElementById('way').click()")
    other.wait_for_selector("body[data-link=view-only]")
    assert other.url == here


@pytest.mark.parametrize("scheme", ["dark", "light"])
@pytest.mark.parametrize("size", [SIZE, {"width": 390, "height": 700}], ids=["large", "small"])
def test_axe_finds_nothing_at_the_log_in(visit, axe, scheme, size):
    tab = visit(color_scheme=scheme, viewport=size)
    assert axe(tab) == []
    log_in(tab, "Anna", "wrong")
    expect(tab.get_by_role("alert")).to_have_text("Name or password is wrong.")
    assert axe(tab) == []
    assert tab.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_axe_finds_nothing_where_somebody_is_logged_in(anna, axe):
    anna.click(".who > summary")
    expect(anna.locator(".log-out")).to_be_visible()
    assert axe(anna) == []


def test_all_of_the_log_in_is_reached_by_tab_and_seen_to_be(visit):
    tab = visit()
    reached = []
    for _ in range(3):
        reached.append(tab.evaluate("document.activeElement.name || document.activeElement.type"))
        assert tab.evaluate("getComputedStyle(document.activeElement).outlineStyle") != "none"
        tab.keyboard.press("Tab")
    assert reached == ["name", "password", "submit"]


def test_without_scripts_the_log_in_works_all_the_same(visit, station):
    tab = visit(java_script_enabled=False)
    log_in(tab, "Anna", "wrong")
    expect(tab.get_by_text("Name or password is wrong.")).to_be_visible()
    log_in(tab, "Anna")
    tab.wait_for_url(f"{station[0].url}/")
