"""Passwords are known again by their digest alone, and whoever has no account is judged as slowly."""

import pytest

pytest.importorskip("argon2")

from argon2 import extract_parameters

from protocol.messages import Role
from services.accounts.account import Account
from services.accounts.exceptions import PasswordUnusable
from services.accounts.passwords import LONGEST, NOBODYS, digest, is_right

PASSWORD = "correct horse"


@pytest.fixture(scope="module")
def anna():
    return Account("Anna", Role.OPERATOR, digest(PASSWORD))


def test_the_right_password_is_right_and_no_other_is(anna):
    assert is_right(PASSWORD, anna)
    for other in ("", PASSWORD.upper(), PASSWORD + " ", "correct", PASSWORD * 200):
        assert not is_right(other, anna)


def test_a_password_is_kept_under_a_salt_of_its_own_and_nothing_of_it_is_in_its_digest(anna):
    again = digest(PASSWORD)
    assert again != anna.password
    assert PASSWORD not in again


def test_whoever_has_no_account_has_no_right_password_and_waits_as_long(anna):
    assert not is_right(PASSWORD, None)
    assert extract_parameters(NOBODYS) == extract_parameters(anna.password)


def test_a_digest_that_cannot_be_read_lets_nobody_in(anna):
    for kept in ("$argon2id$v=19$m=8,t=0,p=1$AAAA$AAAA", "$argon2id$v=99$m=65536,t=3,p=1$AAAAAAAA$A", "nonsense"):
        assert not is_right(PASSWORD, Account("Anna", Role.OPERATOR, kept))


def test_it_does_not_matter_how_a_letter_is_put_together():
    account = Account("Zoe", Role.OPERATOR, digest("cafe\u0301 noir"))
    assert is_right("caf\u00e9 noir", account)


@pytest.mark.parametrize("password", ["", "7 chars", "é" * 7, "x" * (LONGEST + 1), "é" * (LONGEST // 2 + 1)])
def test_what_is_too_short_or_too_long_is_refused_in_one_line(password):
    with pytest.raises(PasswordUnusable, match="give"):
        digest(password)


def test_the_shortest_and_the_longest_can_be_used():
    for password in ("é" * 8, "x" * LONGEST):
        assert is_right(password, Account("Anna", Role.OPERATOR, digest(password)))
