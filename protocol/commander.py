"""The keys of the tokens that say which robots there are and who commands each."""

from __future__ import annotations

from protocol.exceptions import InvalidName
from protocol.names import checked_name, is_name
from protocol.topic import VERSION

_WORD = "commander"

EVERYBODY = f"retouch/{VERSION}/*/{_WORD}/**"
"""All of them."""


def commander_key(robot: str, operator: str) -> str:
    """Says that an operator commands a robot; nobody, where the operator has no name that can stand in a key."""
    return f"retouch/{VERSION}/{robot}/{_WORD}" + (f"/{operator}" if is_name(operator) else "")


def commander_keys(robot: str) -> str:
    """All that one robot may say; its own process alone."""
    return f"retouch/{VERSION}/{robot}/{_WORD}/**"


def told(key: str) -> tuple[str, str]:
    """The robot and who commands it, empty for nobody.

    Raises:
        InvalidName: the key is none of these.
    """
    match key.split("/"):
        case ["retouch", version, robot, word] if (version, word) == (VERSION, _WORD):
            return checked_name(robot), ""
        case ["retouch", version, robot, word, operator] if (version, word) == (VERSION, _WORD):
            return checked_name(robot), checked_name(operator)
    raise InvalidName(key)
