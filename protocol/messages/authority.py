"""Who may command: the class `authority`."""

from __future__ import annotations

from protocol.messages.values import Count, Message, Name, Real


class AuthorityRenewal(Message, frozen=True, kw_only=True):
    """The holder's sign of life while an operator is present; without it the robot holds, then the lease runs out."""

    operator: Name = ""
    holder: Name
    epoch: Count


class AuthorityState(Message, frozen=True, kw_only=True):
    """Who may command; an empty holder means nobody.

    Attributes:
        operator: the person who holds it.
        holder: the name of that person's station.
        epoch: grows with every change of holder; commands of another epoch are refused.
        expires_in: until the lease runs out if it is not renewed [s].
    """

    operator: Name = ""
    holder: Name
    epoch: Count
    expires_in: Real
