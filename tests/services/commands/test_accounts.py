"""Accounts at a terminal, and by a script."""

import io
import os
import pty
import stat
import subprocess
import sys

import pytest

pytest.importorskip("argon2")

from protocol.messages import Role
from services import cli
from services.accounts.file import accounts_path, load
from services.accounts.passwords import LONGEST, is_right
from services.process.exit_codes import Exit

PASSWORD = "correct horse"
WITHIN_S = 60.0

AT_A_TERMINAL = """
import fcntl, os, sys, termios
os.setsid()
fcntl.ioctl(0, termios.TIOCSCTTY, 0)
from services import cli
sys.exit(cli.main(sys.argv[1:]))
"""
"""The password is asked for at the terminal that a process belongs to."""


@pytest.fixture(autouse=True)
def home(tmp_path, monkeypatch):
    monkeypatch.setenv("XDG_CONFIG_HOME", str(tmp_path))


@pytest.fixture
def retouch(monkeypatch, capsys):
    """A function that runs `retouch accounts` with something coming in; its exit code, and all that it said."""

    def run(*arguments, stdin=f"{PASSWORD}\n"):
        content = stdin if isinstance(stdin, bytes) else stdin.encode()
        monkeypatch.setattr(sys, "stdin", io.TextIOWrapper(io.BytesIO(content), encoding="utf-8"))
        code = cli.main(["accounts", *arguments])
        said = capsys.readouterr()
        return code, said.out + said.err

    return run


def known(name):
    return load(accounts_path()).find(name)


def test_an_account_is_made_of_the_first_line_that_comes_in(retouch):
    code, said = retouch("add", "Anna", stdin=f"{PASSWORD}\nanother line\n")
    assert (code, said) == (0, "Anna has an account and commands, teaches, stops; or looks on\n")
    assert known("anna").role is Role.OPERATOR
    assert is_right(PASSWORD, known("anna"))
    assert stat.S_IMODE(accounts_path().stat().st_mode) == 0o600
    assert PASSWORD not in accounts_path().read_text(encoding="utf-8")


def test_everybody_is_listed_with_what_they_may(retouch):
    assert "accounts add NAME" in retouch("list")[1]
    retouch("add", "eve", "--role", "supervisor")
    retouch("add", "Carl", "--role", "observer")
    lines = retouch("list")[1].splitlines()
    assert [line.split()[:2] for line in lines] == [["Carl", "observer"], ["eve", "supervisor"]]


def test_a_password_is_changed_and_the_old_one_is_none(retouch):
    retouch("add", "anna")
    assert retouch("password", "Anna", stdin="battery staple")[0] == 0
    assert is_right("battery staple", known("anna"))
    assert not is_right(PASSWORD, known("anna"))


def test_an_account_is_taken_away(retouch):
    retouch("add", "anna")
    assert retouch("remove", "ANNA") == (0, "anna has no account any more\n")
    assert known("anna") is None


@pytest.mark.parametrize(
    ("arguments", "stdin", "words"),
    [
        (("add", "<b>"), PASSWORD, ("'<b>' is no name", "give 1 to 40 letters")),
        (("add", ""), PASSWORD, ("'' is no name",)),
        (("add", "anna"), PASSWORD, ("anna has an account already",)),
        (("add", "bob"), "", ("0 characters", "at least 8")),
        (("add", "bob"), "7 chars\n", ("7 characters", "at least 8")),
        (("add", "bob"), "x" * (LONGEST + 1), ("longer than 1024 bytes",)),
        (("add", "bob"), "x" * 1_000_000, ("longer than 1024 bytes",)),
        (("add", "bob"), b"\xff\xfe\xfd secret", ("no text in UTF-8",)),
        (("password", "bob"), PASSWORD, ("'bob'", "accounts list")),
        (("password", "anna"), "short", ("at least 8",)),
        (("remove", "bob"), "", ("'bob'", "accounts list")),
    ],
    ids=lambda value: "-".join(value) if isinstance(value, tuple) else None,
)
def test_what_a_person_gets_wrong_is_one_line_and_changes_nothing(retouch, arguments, stdin, words):
    retouch("add", "anna")
    before = accounts_path().read_bytes()
    code, said = retouch(*arguments, stdin=stdin)
    assert code == Exit.BAD_INPUT
    assert said.startswith("retouch: ")
    assert said.count("\n") == 1
    for word in words:
        assert word in said
    assert accounts_path().read_bytes() == before


@pytest.mark.parametrize("part", [("add", "bob"), ("list",), ("password", "anna"), ("remove", "anna")])
def test_a_file_of_something_else_is_named_and_stays(retouch, part):
    accounts_path().write_bytes(b"\xffnonsense")
    code, said = retouch(*part)
    assert (code, said.count("\n")) == (Exit.BAD_INPUT, 1)
    assert "accounts.json holds no accounts" in said
    assert accounts_path().read_bytes() == b"\xffnonsense"


def test_with_nothing_to_read_from_it_says_so(retouch, monkeypatch, capsys):
    monkeypatch.setattr(sys, "stdin", None)
    assert cli.main(["accounts", "add", "bob"]) == Exit.BAD_INPUT
    assert "nothing came in" in capsys.readouterr().err


class Terminal:
    """A terminal at which a command was started.

    Args:
        arguments: of `retouch`.
    """

    def __init__(self, *arguments):
        self._ours, theirs = pty.openpty()
        command = [sys.executable, "-c", AT_A_TERMINAL, *arguments]
        self._process = subprocess.Popen(command, stdin=theirs, stdout=theirs, stderr=theirs)
        os.close(theirs)
        self.shown = ""

    def until(self, words):
        """Read until it shows them; fails where it ends before."""
        while words not in self.shown:
            self.shown += os.read(self._ours, 4096).decode()

    def type(self, line):
        os.write(self._ours, line.encode() + b"\n")

    def ended(self):
        """Its exit code."""
        try:
            return self._process.wait(WITHIN_S)
        finally:
            self._process.kill()
            os.close(self._ours)


def test_at_a_terminal_it_is_asked_for_twice_and_never_shown():
    terminal = Terminal("accounts", "add", "anna")
    terminal.until("Password: ")
    terminal.type(PASSWORD)
    terminal.until("The same again: ")
    terminal.type(PASSWORD)
    terminal.until("anna has an account")
    assert terminal.ended() == 0
    assert PASSWORD not in terminal.shown
    assert is_right(PASSWORD, known("anna"))


def test_two_that_differ_make_no_account():
    terminal = Terminal("accounts", "add", "anna")
    terminal.until("Password: ")
    terminal.type(PASSWORD)
    terminal.until("The same again: ")
    terminal.type(PASSWORD.upper())
    terminal.until("differ")
    assert terminal.ended() == Exit.BAD_INPUT
    assert known("anna") is None
