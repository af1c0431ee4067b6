"""`retouch accounts`: who may log in at the operator's page."""

from __future__ import annotations

import sys
from argparse import ArgumentParser, Namespace, _SubParsersAction
from getpass import getpass
from pathlib import Path

import msgspec

from protocol.messages import Role
from services.accounts import passwords
from services.accounts.account import Account, Accounts, is_name
from services.accounts.exceptions import NameUnusable, PasswordUnusable
from services.accounts.file import accounts_path, load, save
from services.commands.arguments import add_debug

_ABOUT = """\
Accounts of the people at this machine's page, in ~/.config/retouch/accounts.json. The
page asks for one where others reach it: [station] host is not of this machine alone,
or login = "always". Passwords have 8 characters or more; they are asked for at the
terminal, or are the first line that comes in. What is changed counts at once: whoever's
account is removed or gets another password is logged out.
"""

_ROLES = {
    Role.OPERATOR: "commands, teaches, stops; or looks on",
    Role.OBSERVER: "looks on, stops",
    Role.SUPERVISOR: "looks on, stops, ends the authority of whoever commands",
}


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    parser.description = _ABOUT
    add_debug(parser)
    parts = parser.add_subparsers(dest="part", required=True, metavar="PART")
    add = _part(parts, "add", "make an account; asks for its password")
    add.add_argument(
        "--role",
        choices=[role.value for role in Role],
        default=Role.OPERATOR.value,
        help="; ".join(f"{role.value}: {may}" for role, may in _ROLES.items()) + " (default: operator)",
    )
    _part(parts, "password", "change a password")
    _part(parts, "remove", "take an account away; who is logged in with it is no longer")
    parts.add_parser("list", help="who has an account, as what", description="Who has an account, as what.")


def _part(parts: _SubParsersAction[ArgumentParser], name: str, about: str) -> ArgumentParser:
    part = parts.add_parser(name, help=about, description=f"{about[0].upper()}{about[1:]}.")
    part.add_argument("name", metavar="NAME", help="of the person, as others read it")
    return part


def run(arguments: Namespace) -> int:
    """See `Action`."""
    path = accounts_path()
    accounts = load(path)
    match arguments.part:
        case "add":
            _add(accounts, path, arguments.name.strip(), Role(arguments.role))
        case "password":
            known = accounts.known(arguments.name)
            digest = passwords.digest(_asked())
            save(accounts.with_changed(msgspec.structs.replace(known, password=digest)), path)
            _say(f"{known.name} has a new password, and logs in anew")
        case "remove":
            known = accounts.known(arguments.name)
            save(accounts.without(known.name), path)
            _say(f"{known.name} has no account any more")
        case "list":
            for one in accounts.accounts:
                _say(f"{one.name:<24}  {one.role.value:<10}  {_ROLES[one.role]}")
            if not accounts.accounts:
                _say("there are no accounts; 'retouch accounts add NAME' makes one")
    return 0


def _add(accounts: Accounts, path: Path, name: str, role: Role) -> None:
    if not is_name(name):
        raise NameUnusable(name)
    accounts.with_new(Account(name, role, passwords.NOBODYS))  # before anybody thinks of a password
    account = Account(name, role, passwords.digest(_asked()))
    save(accounts.with_new(account), path)
    _say(f"{name} has an account and {_ROLES[role]}")


def _asked() -> str:
    """The password that somebody wants: typed twice and not shown, or the first line that comes in.

    Raises:
        PasswordUnusable: none came, or the two differ.
    """
    if sys.stdin is None:  # it was closed before
        raise PasswordUnusable("nothing came in")
    if not sys.stdin.isatty():
        return _first_line()
    try:
        password, again = getpass("Password: "), getpass("The same again: ")
    except EOFError:
        raise PasswordUnusable("nothing was typed") from None
    except UnicodeDecodeError:
        raise PasswordUnusable("it is no text in UTF-8") from None
    if password != again:
        raise PasswordUnusable("the two that were typed differ; nothing was changed")
    return password


def _first_line() -> str:
    try:
        return sys.stdin.buffer.readline(4 * passwords.LONGEST).rstrip(b"\r\n").decode()
    except UnicodeDecodeError:
        raise PasswordUnusable("it is no text in UTF-8") from None


def _say(line: str) -> None:
    sys.stdout.write(f"{line}\n")
