"""Accounts: one for each name, found however the name is typed."""

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from protocol.messages import Role
from services.accounts.account import Account, Accounts, is_name
from services.accounts.exceptions import AccountThere, NoSuchAccount

DIGEST = f"$argon2id$v=19$m=65536,t=3,p=1${'A' * 22}${'A' * 43}"
ANNA = Account("Anna", Role.OPERATOR, DIGEST)
CARL = Account("Carl", Role.OBSERVER, DIGEST)


@pytest.mark.parametrize("name", ["anna", "Zoë van Dijk-O'Hara Jr.", "7", "李", "a" * 40])
def test_what_people_are_called_is_a_name(name):
    assert is_name(name)


@pytest.mark.parametrize(
    "name", ["", " anna", "anna ", "-anna", "_", "a" * 41, "anna\n", "anna/bob", "<b>", "\u202eanna"]
)
def test_what_cannot_be_read_as_one_is_none(name):
    assert not is_name(name)
    with pytest.raises(ValueError, match="is no name"):
        Account(name, Role.OPERATOR, DIGEST)


def test_somebody_is_found_however_their_name_is_typed():
    zoe = Account("Zoë", Role.OPERATOR, DIGEST)
    accounts = Accounts().with_new(zoe)
    for typed in ("Zoë", "zoë", "ZOË", "Zoe\u0308"):
        assert accounts.find(typed) == zoe
    assert accounts.find("zoe") is None


def test_there_is_one_account_for_each_name():
    accounts = Accounts().with_new(CARL).with_new(ANNA)
    assert [one.name for one in accounts.accounts] == ["Anna", "Carl"]
    with pytest.raises(AccountThere, match="accounts password"):
        accounts.with_new(Account("ANNA", Role.OBSERVER, DIGEST))
    with pytest.raises(ValueError, match="one name"):
        Accounts((ANNA, Account("anna", Role.OBSERVER, DIGEST)))


def test_one_is_changed_or_taken_away_and_the_others_stay():
    accounts = Accounts().with_new(ANNA).with_new(CARL)
    promoted = msgspec.structs.replace(CARL, role=Role.SUPERVISOR)
    assert accounts.with_changed(promoted).accounts == (ANNA, promoted)
    assert accounts.without("carl").accounts == (ANNA,)
    for change in (lambda: accounts.without("bob"), lambda: accounts.known("bob")):
        with pytest.raises(NoSuchAccount, match="accounts list"):
            change()


@given(st.text(max_size=45))
def test_whoever_is_added_is_found(name):
    if is_name(name):
        assert Accounts().with_new(Account(name, Role.OBSERVER, DIGEST)).find(name) is not None
