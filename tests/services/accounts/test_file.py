"""The file of accounts: its owner's alone, and where it holds something else nobody gets in."""

import os
import stat

import pytest

from protocol.messages import Role
from services.accounts.account import Account, Accounts
from services.accounts.exceptions import AccountsUnreadable
from services.accounts.file import AccountsFile, accounts_path, load, save

DIGEST = f"$argon2id$v=19$m=65536,t=3,p=1${'A' * 22}${'A' * 43}"
ANNA = Account("Anna", Role.OPERATOR, DIGEST)

GARBAGE = [
    b"",
    b"nonsense",
    b"\xff\xfe\x00",
    b'{"accounts": [{"name": "\xff", "role": "operator", "password": "x"}]}',
    b"[" * 100_000,
    b'{"accounts": 1}',
    b'{"accounts": [], "more": 1}',
    b'{"accounts": [{"name": "Anna", "role": "king", "password": "%s"}]}' % DIGEST.encode(),
    b'{"accounts": [{"name": "<b>", "role": "operator", "password": "%s"}]}' % DIGEST.encode(),
    b'{"accounts": [{"name": "Anna", "role": "operator", "password": "secret words"}]}',
    b'{"accounts": [{"name": "Anna", "role": "operator", "password": "$argon2i$v=19$m=8,t=1,p=1$AAAA$AAAA"}]}',
    b" " * ((1 << 20) + 1),
]


@pytest.fixture
def path(tmp_path):
    return tmp_path / "accounts.json"


@pytest.fixture
def kept(path):
    save(Accounts((ANNA,)), path)
    return path


def touch(path, second):
    """Let the file be of another time: what is written twice within one tick of its clock looks the same."""
    os.utime(path, (second, second))


def test_it_is_in_the_folder_of_what_a_person_has_set(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    assert accounts_path() == tmp_path / "retouch" / "accounts.json"


def test_what_is_kept_is_found_again_and_is_its_owners_alone(kept):
    assert load(kept).accounts == (ANNA,)
    assert stat.S_IMODE(kept.stat().st_mode) == 0o600


def test_without_a_file_there_are_no_accounts(path):
    assert load(path) == Accounts()


@pytest.mark.parametrize("content", GARBAGE, ids=range(len(GARBAGE)))
def test_what_holds_something_else_is_one_line_that_says_what_to_do(path, content):
    path.write_bytes(content)
    with pytest.raises(AccountsUnreadable, match="accounts add NAME") as caught:
        load(path)
    assert str(path) in str(caught.value)
    assert "\n" not in str(caught.value)


def test_a_folder_in_its_place_is_told(path):
    path.mkdir()
    with pytest.raises(AccountsUnreadable, match="is a directory"):
        load(path)


def test_it_is_read_again_where_it_has_changed_and_only_there(kept):
    file = AccountsFile(kept)
    assert file.accounts.accounts == (ANNA,)
    assert not file.refresh()
    save(Accounts(), kept)
    touch(kept, 1)
    assert file.refresh()
    assert file.accounts == Accounts()
    assert not file.refresh()


@pytest.mark.parametrize("content", GARBAGE, ids=range(len(GARBAGE)))
def test_while_it_holds_something_else_nobody_has_an_account(kept, content):
    file = AccountsFile(kept)
    kept.write_bytes(content)
    touch(kept, 1)
    assert file.refresh()
    assert file.accounts == Accounts()
    assert "holds no accounts" in file.fault
    save(Accounts((ANNA,)), kept)
    touch(kept, 2)
    assert file.refresh()
    assert (file.accounts.accounts, file.fault) == ((ANNA,), "")


def test_a_file_that_is_gone_has_no_accounts(kept):
    file = AccountsFile(kept)
    kept.unlink()
    assert file.refresh()
    assert (file.accounts, file.fault) == (Accounts(), "")
