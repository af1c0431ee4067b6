"""The log-in: one form, told alike whatever is wrong, and a wait for whoever is wrong often."""

import re
import threading

import pytest
from house import CLOSE, PASSWORD, TEXT, Browser, house

from services.certificates.authority import make_authority
from services.station.page.login.judge import WAITING_AT_MOST
from services.station.page.login.waits import FREE_OF_A_NAME
from tests.system.harness import eventually

WITHIN_S = 20.0


def test_the_log_in_is_one_form_without_a_script_that_asks_nobody_else(browser):
    page = browser.ask("GET", "/login")
    assert (page.status, page.headers["Cache-Control"]) == (200, "no-store")
    assert "<script" not in page.text
    loaded = re.findall(r'(?:href|src)="([^"#]+)', page.text)
    assert set(loaded) == {"/assets/login.css", "/assets/retouch.svg", "/assets/symbols.svg"}
    assert all(browser.ask("GET", address).status == 200 for address in loaded)
    assert 'autocomplete="current-password"' in page.text
    assert "password" not in page.headers["Content-Security-Policy"]


def test_who_logs_in_sees_the_page_and_finds_no_log_in(inside):
    assert inside.ask("GET", "/").status == 200
    assert inside.ask("GET", "/assets/station.css").status == 200
    assert inside.ask("GET", "/login").headers["Location"] == "/"


def test_the_cookie_is_the_browsers_alone_for_this_page_alone(open_house, browser):
    answer = browser.log_in()
    (name,) = browser.cookies
    assert name == f"retouch-{open_house.page.url.rpartition(':')[2]}"
    morsel = answer.morsel
    assert (morsel["httponly"], morsel["samesite"], morsel["path"], morsel["domain"]) == (True, "strict", "/", "")
    assert (morsel["secure"], morsel["max-age"], morsel["expires"]) == ("", "", "")
    assert len(morsel.value) == 43


def test_over_https_it_goes_nowhere_else(tmp_path):
    authority = make_authority(tmp_path / "certs")
    authority.issue("page.desk", hosts=("127.0.0.1",))
    with house(tmp_path, certificate=str(authority.folder / "page.desk.pem")) as opened:
        browser = Browser(opened.page, authority.folder / "ca.pem")
        morsel = browser.log_in().morsel
        assert (morsel["secure"], morsel["httponly"], morsel["samesite"]) == (True, True, "strict")
        assert list(browser.cookies) == [f"__Host-retouch-{opened.page.url.rpartition(':')[2]}"]
        assert browser.ask("GET", "/").status == 200
        assert browser.first_frame() == TEXT
        browser.log_out()
        assert browser.first_frame() == CLOSE
        assert opened.page.attendance().page.startswith("https://")


@pytest.mark.parametrize(
    ("name", "password"), [("Anna", "wrong"), ("Nobody", PASSWORD), ("", ""), ("Anna", ""), ("<b>", PASSWORD)]
)
def test_what_is_wrong_is_told_alike_whoever_it_is(browser, name, password):
    answer = browser.log_in(name, password)
    assert answer.status == 403
    assert "Name or password is wrong." in answer.text
    assert browser.cookies == {}
    own = re.compile(r' value="[^"]*"| *(?:autofocus)? />')
    assert own.sub("", answer.text) == own.sub("", browser.log_in("Carl", "wrong").text)


def test_a_name_is_shown_as_text(browser):
    answer = browser.log_in('"><script>alert(1)</script>', "wrong")
    assert "<script" not in answer.text
    asked = browser.ask("GET", "/login?name=%22%3E%3Cscript%3E&said=%3Cscript%3E&role=%3Cscript%3E")
    assert "<script" not in asked.text


@pytest.mark.parametrize(
    "fields",
    [
        "",
        "name=Anna",
        "name=Anna&password=a&password=b",
        "name=Anna&password=a&more=1",
        "name=%ff&password=secret",
        b"name=\xff&password=secret",
        {"name": "a" * 65, "password": PASSWORD},
        "name=Anna&password=" + "x" * 9000,
    ],
    ids=["nothing", "half", "twice", "more", "no UTF-8", "no ASCII", "long name", "large"],
)
def test_what_is_no_form_is_refused_and_nothing_else_happens(browser, fields):
    answer = browser.ask("POST", "/login", fields)
    assert answer.status == 400
    assert browser.cookies == {}
    assert browser.log_in().status == 303


@pytest.mark.parametrize("origin", ["https://evil.example", "null"])
def test_no_other_site_logs_anybody_in_or_out(inside, origin):
    for path in ("/login", "/logout"):
        assert inside.ask("POST", path, {"name": "Carl", "password": PASSWORD}, Origin=origin).status == 403
    assert inside.ask("GET", "/").status == 200


def test_a_role_is_taken_along_and_nothing_else_is(browser):
    answer = browser.log_in(path="/login?role=observer&name=Carl&next=https://evil.example")
    assert (answer.status, answer.headers["Location"]) == (303, "/?role=observer")


@pytest.mark.parametrize("name", ["Anna", "Nobody"])
def test_who_fails_often_waits_and_is_told_for_how_long_and_not_whether_the_name_exists(browser, name):
    for _ in range(FREE_OF_A_NAME + 2):
        answer = browser.log_in(name, "wrong")
        if answer.status == 429:
            break
    assert answer.status == 429
    assert answer.headers["Retry-After"] == "1"
    assert "Too many attempts: wait 1 s, then try again." in answer.text
    assert browser.log_in(name).status == 429, "the right password has to wait, too"


def test_the_wait_is_by_the_address_that_comes_whatever_it_says_of_others(browser):
    for number in range(FREE_OF_A_NAME + 1):
        answer = browser.ask(
            "POST", "/login", {"name": "Anna", "password": "wrong"}, X_Forwarded_For=f"192.0.2.{number}"
        )
    assert answer.status == 429


def test_passwords_are_judged_one_at_a_time_and_nothing_else_waits(tmp_path):
    judged, surplus, go, answers = [], 2, threading.Event(), []

    def at_leisure(password, account):
        judged.append("begins")
        go.wait(WITHIN_S)
        judged.append("ends")
        return False

    with house(tmp_path, judged=at_leisure) as opened:

        def try_once(number):
            answers.append(Browser(opened.page).log_in(f"name {number}").status)

        tries = [threading.Thread(target=try_once, args=(n,)) for n in range(WAITING_AT_MOST + surplus)]
        for one in tries:
            one.start()
        eventually(lambda: len(answers) == surplus, WITHIN_S, "for so many there is no time")
        assert answers == [503] * surplus
        assert Browser(opened.page).ask("GET", "/login").status == 200
        assert judged == ["begins"]
        go.set()
        for one in tries:
            one.join(WITHIN_S)
    assert judged == ["begins", "ends"] * WAITING_AT_MOST
    assert answers == [503] * surplus + [403] * WAITING_AT_MOST


def test_who_logs_out_is_told_so_and_the_browser_forgets(inside):
    answer = inside.log_out()
    assert (answer.status, answer.headers["Location"]) == (303, "/login?said=out")
    assert set(inside.cookies.values()) == {""}
    assert "You have logged out." in inside.ask("GET", answer.headers["Location"]).text


def test_what_is_told_in_the_log_names_nobody_who_has_no_account(browser, caplog):
    caplog.set_level("INFO")
    browser.log_in("my password by mistake", "x")
    browser.log_in("anna", "wrong secret")
    browser.log_in("anna")
    browser.log_out()
    told = [record.getMessage() for record in caplog.records if record.name.startswith("services.station.page.login")]
    assert told == [
        "a log-in of nobody who has an account from 127.0.0.1 failed",
        "a log-in of Anna from 127.0.0.1 failed",
        "Anna has logged in from 127.0.0.1, as operator",
        "Anna has logged out",
    ]
