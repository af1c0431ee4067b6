"""A page is opened for whom its configuration says, and not at all where others would reach it unasked."""

import pytest

pytest.importorskip("argon2")

from protocol.messages import Role
from services.accounts.account import Account, Accounts
from services.accounts.exceptions import AccountsUnreadable, LoginImpossible
from services.accounts.file import accounts_path, save
from services.accounts.passwords import digest
from services.accounts.policy import page_is_open
from services.certificates.authority import make_authority
from services.certificates.exceptions import Unsecured
from services.process.clock import SystemClock
from services.process.config import Configuration, StationSection
from services.station.live_view.description import described
from services.station.opening import open_page
from sim.tasks.scene import Eye
from tests.ports import free_port
from tests.services.station.page.login.house import Browser

PASSWORD = "correct horse"


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))
    monkeypatch.setattr("services.station.opening.describe", lambda *_: described((), {}, Eye(), None))


@pytest.fixture
def accounts():
    save(Accounts((Account("Anna", Role.OPERATOR, digest(PASSWORD)),)), accounts_path())


@pytest.fixture
def certificate(tmp_path):
    """Of this machine, for its page; the authority's own, that a browser trusts."""
    authority = make_authority(tmp_path / "retouch" / "certs")
    authority.issue("page.desk", hosts=("127.0.0.1",))
    return authority.folder / "ca.pem"


@pytest.fixture
def opened():
    """A function that opens a page; it is closed in the end."""
    pages = []

    def open_one(configuration):
        pages.append(open_page(configuration, SystemClock()))
        return pages[-1]

    yield open_one
    for page in pages:
        page.close()


def configured(host="127.0.0.1", insecure=False, **section):
    return Configuration(station=StationSection(host=host, port=free_port(), **section), insecure=insecure)


@pytest.mark.usefixtures("accounts")
def test_on_this_machine_alone_nobody_is_asked(opened):
    page = opened(configured())
    assert Browser(page).ask("GET", "/").status == 200
    assert Browser(page).ask("GET", "/login").status == 404


@pytest.mark.usefixtures("accounts")
def test_where_it_is_always_asked_the_password_of_an_account_opens_it_and_no_other_does(opened):
    browser = Browser(opened(configured(login="always")))
    assert browser.ask("GET", "/").status == 303
    assert browser.log_in("Anna", "wrong").status == 403
    assert browser.log_in("Nobody", PASSWORD).status == 403
    assert browser.log_in("anna", PASSWORD).status == 303
    assert browser.ask("GET", "/").status == 200


@pytest.mark.usefixtures("accounts")
def test_a_page_that_others_reach_is_served_over_https_to_whoever_logs_in(opened, certificate, caplog):
    page = opened(configured("0.0.0.0"))
    browser = Browser(page, certificate, host="127.0.0.1")
    assert browser.ask("GET", "/").status == 303
    assert browser.log_in("Anna", PASSWORD).status == 303
    assert browser.ask("GET", "/").status == 200
    assert page.attendance().page.startswith("https://127.0.0.1:")
    assert caplog.text == ""
    assert not page_is_open(configured("0.0.0.0"))


@pytest.mark.usefixtures("certificate")
def test_without_accounts_it_is_not_opened(opened):
    with pytest.raises(LoginImpossible, match="accounts add NAME"):
        opened(configured("0.0.0.0"))


@pytest.mark.usefixtures("accounts")
def test_without_a_certificate_it_is_not_opened(opened):
    with pytest.raises(Unsecured, match=r"certs issue page\.NAME"):
        opened(configured("0.0.0.0"))


def test_with_accounts_that_cannot_be_read_it_is_not_opened(opened):
    accounts_path().write_bytes(b"\xff")
    with pytest.raises(AccountsUnreadable):
        opened(configured(login="always"))


def test_where_it_is_said_that_it_may_be_it_is_open_and_tells_so(opened, caplog):
    configuration = configured("0.0.0.0", insecure=True)
    assert Browser(opened(configuration), host="127.0.0.1").ask("GET", "/").status == 200
    assert "open to others (--insecure)" in caplog.text
    assert page_is_open(configuration)


@pytest.mark.usefixtures("accounts", "certificate")
def test_without_a_log_in_it_is_open_even_over_https():
    assert page_is_open(configured("0.0.0.0", insecure=True, login="never"))
    assert not page_is_open(configured("0.0.0.0", insecure=True))
    assert not page_is_open(configured(login="never"))
