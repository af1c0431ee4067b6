"""The page in a real Firefox: what browsers do differently is keys, focus, pointers, and what they draw with."""

import shutil
from dataclasses import replace

import msgspec
import pytest

from protocol.messages import Person, Role
from services.accounts.account import Account, Accounts
from services.accounts.file import AccountsFile, save
from services.station.page.login.judge import Judge
from services.station.press import Press
from tests.browser import scripts
from tests.ports import free_port

DIGEST = f"$argon2id$v=19$m=65536,t=3,p=1${'A' * 22}${'A' * 43}"

pytestmark = pytest.mark.browser


@pytest.fixture(scope="module")
def firefox(tmp_path_factory):
    """A headless Firefox."""
    from firefox import running

    executable = shutil.which("firefox-esr") or shutil.which("firefox")
    if executable is None:
        pytest.skip("no firefox in PATH")
    with running(executable, tmp_path_factory.mktemp("firefox")) as started:
        yield started


@pytest.fixture
def open_page(firefox, calm_station, eventually):
    """A function that opens a tab that has the input."""
    page, _ = calm_station
    tabs = []

    def open_one(script=""):
        tabs.append(firefox.open(page.url, scripts.TOURED + scripts.SEATED + script))
        tabs[-1].wait("body[data-link=armed]")
        eventually(lambda: page.take_input().focused)
        return tabs[-1]

    yield open_one
    for tab in tabs:
        tab.close()


@pytest.fixture
def tab(open_page, station, eventually):
    """A tab that has the input and whose keys count, where nothing is drawn in three dimensions."""
    opened = open_page(scripts.UNDRAWN)
    eventually(lambda: station[0].take_input().focused)
    return opened


def test_it_loads_without_a_fault_and_draws_or_says_that_it_cannot(open_page):
    tab = open_page()
    tab.wait(".camera[data-state]:not([data-state=waiting])")
    tab.wait(".scene[data-view]:not([data-view=loading])")
    if tab.evaluate("document.querySelector('.scene').dataset.view") != "live":
        tab.wait(".scene-empty-text", "WebGL 2")
    tab.wait(".light[data-light=green]", "Your turn")
    assert tab.faults == []


def test_a_held_key_counts_and_goes_with_the_focus(tab, firefox, station, eventually):
    page, _ = station
    tab.key("e", down=True)
    eventually(lambda: page.take_input().keys == ("KeyE",))
    tab.wait("[data-key=KeyE][data-held]")
    other = firefox.open("about:blank", "")
    eventually(lambda: page.take_input().keys == ())
    other.close()
    tab.bring_forward()
    eventually(lambda: page.take_input().focused)
    tab.key("e", down=False)
    tab.key("q", down=True)
    eventually(lambda: page.take_input().keys == ("KeyQ",))
    tab.key("q", down=False)


def test_escape_stops_and_space_finishes(tab, pressed):
    for key, action in ((" ", "finish"), ("Escape", "stop")):
        tab.key(key, down=True)
        tab.key(key, down=False)
        assert pressed() == [action]


def test_a_button_is_pressed_once_wherever_it_is_when_the_pointer_is_let_go(tab, station, presses):
    _, feed = station
    tab.pointer("[data-action=teach]", "down", "up")
    assert presses() == [Press("teach")]
    tab.pointer("[data-action=teach]", "down")
    feed.view = replace(
        feed.view, teaching=msgspec.structs.replace(feed.view.teaching, recommended="teach", text="That one.")
    )
    tab.wait(".light-text", "That one.")
    tab.pointer("up")
    assert presses() == [Press("teach")]


def test_the_pointer_s_pad_is_gripped_dragged_and_let_go(tab, station, eventually):
    page, _ = station
    tab.pointer("[data-pad-for=pointer]", "down", "up")
    tab.wait(".pointer-pad")
    tab.pointer(".pointer-pad", "down", (40, 0))

    def read(gripped):
        pointers = [one for one in page.take_input().controllers if one.kind == "pointer"]
        return pointers and pointers[0].buttons == (gripped,) and pointers[0].axes[0] > 0.0

    eventually(lambda: read(1.0))
    tab.pointer("up")
    eventually(lambda: read(0.0))


@pytest.fixture
def guarded(tmp_path):
    """A page at which Anna has to log in."""
    from harness import served

    anna = Account("Anna", Role.OPERATOR, DIGEST)
    save(Accounts((anna,)), tmp_path / "accounts.json")
    judge = Judge(AccountsFile(tmp_path / "accounts.json"), lambda password, account: password == "correct horse")
    with served(judge=judge, port=free_port()) as (page, _):
        yield page


def log_in(tab, password):
    tab.wait("[name=password]")
    tab.evaluate("document.querySelector('[name=name]').value = 'Anna'")
    tab.evaluate(f"document.querySelector('[name=password]').value = '{password}'")
    tab.pointer(".login-enter", "down", "up")


def test_somebody_logs_in_commands_and_logs_out(firefox, guarded, eventually):
    tab = firefox.open(guarded.url, scripts.TOURED + scripts.UNDRAWN)
    try:
        for password, then, says in (
            ("wrong", ".login-notice", "is wrong"),
            ("correct horse", "body[data-link=armed]", ""),
        ):
            tab.wait("[name=password]")
            tab.evaluate("document.querySelector('[name=name]').value = 'Anna'")
            tab.evaluate(f"document.querySelector('[name=password]').value = '{password}'")
            tab.pointer(".login-enter", "down", "up")
            tab.wait(then, says)
        eventually(lambda: guarded.attendance().people)
        assert guarded.attendance().people == (Person("Anna", Role.OPERATOR, has_input=True),)
        tab.pointer(".who > summary", "down", "up")
        tab.wait("[data-value=people-commands]", "Anna")  # what lies below stays where it is now
        tab.wait(".log-out button:not([data-come])")
        tab.pointer(".log-out button", "down", "up")
        tab.wait(".login-notice", "You have logged out.")
        eventually(lambda: guarded.attendance().people == ())
    finally:
        tab.close()
