"""Who is at a station's page, also of the class `state`."""

from __future__ import annotations

import enum
from typing import Annotated

import msgspec

from protocol.messages.values import Message, Name, Reason

Address = Annotated[str, msgspec.Meta(max_length=256)]


class Role(enum.Enum):
    """What somebody at a page may do.

    OPERATOR: steer, one at a time: who has the input. The others ask for it, are handed it, or take it over.
    OBSERVER: watch, and stop.
    SUPERVISOR: watch, stop, and end the authority of whoever commands; never steer.
    """

    OPERATOR = "operator"
    OBSERVER = "observer"
    SUPERVISOR = "supervisor"


class Person(msgspec.Struct, frozen=True):
    """Somebody at a page.

    Attributes:
        name: as they gave it; empty where they gave none.
        role: what they may do.
        has_input: what they hold down at this station counts.
    """

    name: Name
    role: Role
    has_input: bool = False


class TakeOver(msgspec.Struct, frozen=True):
    """The input of a station was taken over.

    Attributes:
        by: whom.
        before: who lost it; empty where nobody had it.
        why: the reason for it.
    """

    by: Name
    before: Name
    why: Reason


class Attendance(Message, frozen=True, kw_only=True):
    """Who is at a station's page now: nobody looks on unseen.

    Attributes:
        holder: the station's name as holder of the authority.
        people: a tab each.
        page: its page's address; empty where it has none.
        taken: how the input was taken over last; None where it never was.
    """

    holder: Name
    people: Annotated[tuple[Person, ...], msgspec.Meta(max_length=16)] = ()
    page: Address = ""
    taken: TakeOver | None = None
