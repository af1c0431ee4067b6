"""The names of robots and processes, and what a process' name says of it."""

from __future__ import annotations

import re

from protocol.exceptions import InvalidName

_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9_-]{0,63}")


def is_name(text: str) -> bool:
    """Whether it can stand in a key expression."""
    return _NAME.fullmatch(text) is not None


def role(process: str) -> str:
    """What a process is by its name: the part before the first "-", behind which its operator or number stands."""
    return process.partition("-")[0]


def process_name(role: str, operator: str) -> str:
    """The name of an operator's process: it says whose it is, so that two can be there at once."""
    return f"{role}-{operator}"


def person(process: str) -> str:
    """Whose a process is by its name; empty where it is no operator's, or one of an operator who gave no name."""
    return process.partition("-")[2]


def checked_name(name: str) -> str:
    """The name itself.

    Raises:
        InvalidName: it cannot stand in a key expression.
    """
    if not is_name(name):
        raise InvalidName(name)
    return name
