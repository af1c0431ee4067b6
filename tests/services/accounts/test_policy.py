"""Who has to log in: whoever comes to a page that others reach; nobody at a page of one machine, unless it is asked."""

import msgspec
import pytest

from protocol.messages import Role
from services.accounts.account import Account, Accounts
from services.accounts.exceptions import AccountsUnreadable, LoginImpossible
from services.accounts.file import accounts_path, save
from services.accounts.policy import asks
from services.process.config import Configuration, StationSection

DIGEST = f"$argon2id$v=19$m=65536,t=3,p=1${'A' * 22}${'A' * 43}"
OPEN = ("0.0.0.0", "192.0.2.1", "desk.lan", "::")
OWN = ("127.0.0.1", "localhost", "::1", "127.0.0.2")


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))


@pytest.fixture
def accounts():
    save(Accounts((Account("Anna", Role.OPERATOR, DIGEST),)), accounts_path())


def configured(host, login="auto", insecure=False):
    return msgspec.structs.replace(Configuration(), station=StationSection(host=host, login=login), insecure=insecure)


@pytest.mark.parametrize("host", OWN)
@pytest.mark.usefixtures("accounts")
def test_at_a_page_of_this_machine_alone_nobody_is_asked_unless_always(host):
    assert not asks(configured(host))
    assert not asks(configured(host, "never"))
    assert asks(configured(host, "always"))


@pytest.mark.parametrize("host", OPEN)
@pytest.mark.usefixtures("accounts")
def test_where_others_reach_the_page_everybody_is_asked(host):
    for login in ("auto", "always"):
        assert asks(configured(host, login))
        assert asks(configured(host, login, insecure=True))


@pytest.mark.parametrize("host", OPEN)
def test_without_accounts_others_cannot_reach_it_unless_it_is_said_that_they_may(host):
    with pytest.raises(LoginImpossible, match=r"^\[station\] host: .*'retouch accounts add NAME'$"):
        asks(configured(host))
    assert not asks(configured(host, insecure=True))


@pytest.mark.parametrize("host", [*OWN, *OPEN])
def test_who_always_asks_needs_accounts(host):
    for insecure in (False, True):
        with pytest.raises(LoginImpossible, match=r"^\[station\] login: .*'retouch accounts add NAME'$"):
            asks(configured(host, "always", insecure))


@pytest.mark.parametrize("host", OPEN)
@pytest.mark.usefixtures("accounts")
def test_a_page_that_others_reach_is_never_without_a_log_in_unless_that_is_said(host):
    with pytest.raises(LoginImpossible, match="--insecure"):
        asks(configured(host, "never"))
    assert not asks(configured(host, "never", insecure=True))


def test_accounts_that_cannot_be_read_are_no_open_door():
    accounts_path().write_bytes(b"\xff")
    for insecure in (False, True):
        with pytest.raises(AccountsUnreadable):
            asks(configured("0.0.0.0", insecure=insecure))
    assert not asks(configured("127.0.0.1"))
