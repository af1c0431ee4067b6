"""At a desk where people log in: the account says who somebody is and what they may, and its end ends everything."""

from dataclasses import replace

import pytest
from browser_tab import BrowserTab
from views import SEATED, shown

from protocol.messages import OperatorInput, Person, Role
from services.accounts.account import Account
from services.station.page.identity import identify
from services.station.page.input import Desk
from services.station.page.people import people
from services.station.press import Press

DIGEST = f"$argon2id$v=19$m=65536,t=3,p=1${'A' * 22}${'A' * 43}"
ANNA = Account("Anna", Role.OPERATOR, DIGEST)
BOB = Account("Bob", Role.OPERATOR, DIGEST)
CARL = Account("Carl", Role.OBSERVER, DIGEST)
EVE = Account("Eve", Role.SUPERVISOR, DIGEST)
COMMANDS = ("take_input", "seize_input", "give_input", "execute", "finish", "release_stop")


@pytest.fixture
def anna():
    """Somebody who has the input, and had time to be present."""
    tab = BrowserTab(Desk("station's"), account=ANNA, name="Eve", role="supervisor")
    tab.keep_on(2.0)
    return tab


def comes(anna, account, number=2, **said):
    tab = BrowserTab(anna.desk, tab=number, now_ms=anna.now_ms, account=account, **said)
    tab.hold()
    anna.now_ms = tab.now_ms
    anna.hold()
    return tab


def test_what_a_tab_says_of_its_person_counts_for_nothing(anna):
    assert anna.desk.attendance().people == (Person("Anna", Role.OPERATOR, has_input=True),)
    assert anna.input().operator == "Anna"


@pytest.mark.parametrize("account", [CARL, EVE])
@pytest.mark.parametrize("asked", ["", "operator", "observer"])
def test_whose_account_lets_nobody_command_does_not_command(account, asked):
    tab = BrowserTab(Desk(), account=account, role=asked)
    tab.keep_on(2.0, "KeyQ")
    for action in COMMANDS:
        tab.press(action, argument="because I say so")
    assert tab.input() == OperatorInput()
    assert tab.desk.take_presses() == []
    assert not tab.standing().armed


@pytest.mark.parametrize(("account", "may"), [(ANNA, False), (CARL, False), (EVE, True)])
def test_a_supervisors_account_revokes_and_no_other_does(account, may):
    tab = BrowserTab(Desk(), account=account, role="supervisor")
    tab.hold()
    tab.press("revoke", argument="the lab closes")
    assert tab.desk.take_presses() == ([Press("revoke", "the lab closes", by="Eve")] if may else [])


@pytest.mark.parametrize("account", [ANNA, CARL, EVE])
def test_everybody_with_an_account_may_stop_and_is_named(anna, account):
    comes(anna, account).press("stop")
    assert anna.desk.take_presses() == [Press("stop", by=account.name)]


def test_a_stop_of_a_tab_that_has_not_said_who_it_is_carries_the_accounts_name():
    desk = Desk()
    pressed = b'{"kind": "pressed", "sequence": 1, "stamp_ms": 1.0, "number": 1, "action": "stop"}'
    desk.receive(1, pressed, 1_000_000_000, CARL)
    assert desk.take_presses() == [Press("stop", by="Carl")]


def test_who_operates_may_look_on(anna):
    anna.says("observer", "")
    anna.hold("KeyQ")
    assert anna.input() == OperatorInput()
    assert anna.desk.attendance().people == (Person("Anna", Role.OBSERVER),)


def test_once_somebody_is_dismissed_nothing_held_counts_and_nobody_is_present(anna):
    anna.hold("KeyQ")
    assert (anna.input().present, anna.input().keys) == (True, ("KeyQ",))
    anna.desk.dismiss(1, anna.now_ms * 1_000_000)
    assert anna.input() == OperatorInput()
    assert anna.desk.attendance().people == ()
    anna.hold("KeyQ")
    assert anna.input() == OperatorInput()


def test_the_seat_of_somebody_who_was_dismissed_is_free_and_is_not_inherited_at_the_same_tab(anna):
    anna.desk.dismiss(1, anna.now_ms * 1_000_000)
    bob = BrowserTab(anna.desk, tab=2, now_ms=anna.now_ms, token=anna.token, account=BOB)
    bob.hold()
    assert not bob.standing().armed
    bob.press("take_input")
    assert bob.standing().armed


def test_who_logs_in_again_at_their_tab_finds_their_seat(anna):
    anna.desk.dismiss(1, anna.now_ms * 1_000_000)
    again = BrowserTab(anna.desk, tab=2, now_ms=anna.now_ms, token=anna.token, account=ANNA)
    assert again.standing().armed


def test_whoever_asks_gets_the_seat_of_somebody_who_is_dismissed(anna):
    bob = comes(anna, BOB)
    bob.press("take_input")
    anna.desk.dismiss(1, anna.now_ms * 1_000_000)
    assert bob.standing().armed


def test_somebody_else_who_is_dismissed_takes_nothing_along(anna):
    carl = comes(anna, CARL)
    anna.hold("KeyQ")
    anna.desk.dismiss(carl.tab, anna.now_ms * 1_000_000)
    assert anna.input().keys == ("KeyQ",)


@pytest.mark.parametrize("account", [None, ANNA, CARL, EVE])
def test_a_tab_shows_what_its_account_allows(account):
    values = people(shown(), replace(SEATED, identity=identify("", "", "ann", account)))
    assert values["log-out@hidden"] is (account is None)
    hidden = {role for role in Role if values[f"role-{role.value}@hidden"]}
    assert hidden == (set() if account is None else set(Role) - {account.role, Role.OBSERVER})
