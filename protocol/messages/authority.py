"""Who may command: the class `authority`."""

from __future__ import annotations

import enum

from protocol.messages.values import Count, Message, Name, Real, Reason

SILENCE_GIVES_S = 10.0
"""Whoever has what somebody asks for, a station's input or a robot's authority, gives it by so much silence [s]."""

SHORTEST_REASON = 3
"""Characters of a reason, at least, where the authority is taken from somebody."""


class AuthorityEvent(enum.Enum):
    """How the authority came to be as it is."""

    NONE = "none"
    ACQUIRED = "acquired"
    GIVEN = "given"
    GIVEN_BY_SILENCE = "given_by_silence"
    TAKEN_OVER = "taken_over"
    RELEASED = "released"
    EXPIRED = "expired"
    REVOKED = "revoked"
    STOPPED = "stopped"


class AuthorityRenewal(Message, frozen=True, kw_only=True):
    """The holder's sign of life while an operator is present; without it the robot holds, then the lease runs out."""

    operator: Name = ""
    holder: Name
    epoch: Count


class AuthorityRequest(Message, frozen=True, kw_only=True):
    """Somebody asks whoever holds the authority for it. Repeated while it is asked.

    Attributes:
        operator: the person who asks.
        holder: the name of that person's station, which gets the authority.
        number: random, of this request: what was kept from it is not asked for again by it.
    """

    operator: Name = ""
    holder: Name
    number: Count


class AuthorityState(Message, frozen=True, kw_only=True):
    """Who may command; an empty holder means nobody.

    Attributes:
        operator: the person who holds it.
        holder: the name of that person's station.
        epoch: grows with every change of holder; commands of another epoch are refused.
        expires_in: until the lease runs out if it is not renewed [s].
        event: how it came to be so.
        by: who caused that.
        before: who had it before; empty for nobody.
        reason: why it was taken over or revoked.
        asked_by: who asks for it; empty where nobody does.
        asked: number of that request; 0 for none.
        asked_left: until silence gives it [s].
        kept_from: number of the request that the holder declined last; 0 for none.
    """

    operator: Name = ""
    holder: Name
    epoch: Count
    expires_in: Real
    event: AuthorityEvent = AuthorityEvent.NONE
    by: Name = ""
    before: Name = ""
    reason: Reason = ""
    asked_by: Name = ""
    asked: Count = 0
    asked_left: Real = 0.0
    kept_from: Count = 0
