"""Who a tab's person says to be: a name and a role, where they can be used, and one line where they cannot."""

from __future__ import annotations

from dataclasses import dataclass

from protocol.messages import Role
from services.accounts.account import Account, is_name
from services.station.words.table import say

_ROLES = {role.value: role for role in Role}


@dataclass(frozen=True)
class Identity:
    """A tab's person.

    Attributes:
        name: empty where none was given.
        role: what they may do.
        fault: what is wrong with what they said; empty where nothing is.
        account: the most that they may be, by their account; None where nobody has to log in.
    """

    name: str = ""
    role: Role = Role.OPERATOR
    fault: str = ""
    account: Role | None = None


SOMEBODY = Identity()
"""Who has said nothing yet."""


def identify(name: str, role: str, operator: str, account: Account | None = None) -> Identity:
    """The person that a tab speaks of.

    Whoever asks for a role that does not exist looks on; a name that is none is as good as none. Who has logged in is
    called as in their account, whatever the tab says, and is what that says, or looks on where s/he asks for that.

    Args:
        name: as given, empty for none.
        role: as given, empty for the operator's, or the account's.
        operator: the name of an operator who gives none.
        account: with which they have logged in; None where nobody has to.
    """
    if account is not None:
        return _of_account(role, account)
    known = _ROLES.get(role or Role.OPERATOR.value)
    chosen = known or Role.OBSERVER
    given = name.strip()
    faults = []
    if known is None:
        faults.append(say("who.no_role", role=repr(role), roles=", ".join(_ROLES)))
    if given and not is_name(given):
        faults.append(say("who.no_name", name=repr(given)))
        given = ""
    return Identity(given or (operator if chosen is Role.OPERATOR else ""), chosen, " ".join(faults))


def _of_account(role: str, account: Account) -> Identity:
    if role == Role.OBSERVER.value:
        return Identity(account.name, Role.OBSERVER, account=account.role)
    fault = say(f"who.only_{account.role.value}") if role and role != account.role.value else ""
    return Identity(account.name, account.role, fault, account.role)
