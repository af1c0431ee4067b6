"""Who a tab's person says to be: what can be used is, and what cannot is said in one line."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Role
from services.accounts.account import Account
from services.station.page.identity import Identity, identify


@pytest.mark.parametrize("role", list(Role))
def test_a_name_and_a_role_are_taken_as_they_are_given(role):
    assert identify(" Zoë van Dijk-O'Hara Jr. ", role.value, "anna") == Identity("Zoë van Dijk-O'Hara Jr.", role)


def test_an_operator_without_a_name_has_the_station_s_and_nobody_else_has():
    assert identify("", "", "anna") == Identity("anna", Role.OPERATOR)
    assert identify("", "observer", "anna") == Identity("", Role.OBSERVER)
    assert identify("", "supervisor", "anna") == Identity("", Role.SUPERVISOR)


@pytest.mark.parametrize("name", ["<b>", "-anna", "a" * 41, "anna\nbob", "anna/bob", "_", "\u202eanna", "🤖"])
def test_what_is_no_name_is_refused_in_one_line_and_is_as_good_as_none(name):
    identity = identify(name, "operator", "anna")
    assert identity.name == "anna"
    assert "is no name: give 1 to 40 letters" in identity.fault
    assert "\n" not in identity.fault


def test_a_role_that_does_not_exist_is_refused_in_one_line_and_looks_on():
    identity = identify("bob", "boss", "anna")
    assert (identity.name, identity.role) == ("bob", Role.OBSERVER)
    assert identity.fault == "There is no role 'boss': give operator, observer, supervisor; you look on."


ANNA = Account("Anna", Role.OPERATOR, f"$argon2id$v=19$m=65536,t=3,p=1${'A' * 22}${'A' * 43}")


@pytest.mark.parametrize("most", list(Role))
@pytest.mark.parametrize("asked", ["", *(role.value for role in Role), "boss"])
def test_who_has_logged_in_is_who_the_account_says_and_no_more_whatever_the_tab_says(most, asked):
    account = msgspec.structs.replace(ANNA, role=most)
    identity = identify("Eve", asked, "ann", account)
    assert (identity.name, identity.account) == ("Anna", most)
    assert identity.role is (Role.OBSERVER if asked == "observer" else most)
    assert bool(identity.fault) == (asked not in ("", "observer", most.value))
    assert "\n" not in identity.fault


@given(st.text(max_size=64), st.text(max_size=64))
def test_whatever_is_said_makes_a_person_and_one_line_at_most(name, role):
    identity = identify(name, role, "anna")
    assert len(identity.name) <= 40
    assert len(identity.fault.splitlines()) <= 1
    assert identity.role is not Role.SUPERVISOR or role == "supervisor"
