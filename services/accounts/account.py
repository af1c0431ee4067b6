"""An account: who somebody is at the page, what they may do there, and the digest of their password."""

from __future__ import annotations

import re
import unicodedata
from typing import Annotated

import msgspec

from protocol.messages import Role
from services.accounts.exceptions import AccountThere, NoSuchAccount

Digest = Annotated[
    str,
    msgspec.Meta(
        max_length=512,
        pattern=r"^\$argon2id\$v=[0-9]{1,3}\$m=[0-9]{1,8},t=[0-9]{1,3},p=[0-9]{1,2}\$[A-Za-z0-9+/]+\$[A-Za-z0-9+/]+$",
    ),
]
"""Of a password, by argon2id (RFC 9106), with its costs and its salt."""

_NAME = re.compile(r"[^\W_]([\w .'-]{0,38}[\w.'-])?")


def is_name(text: str) -> bool:
    """Whether a text can be a person's name at the page."""
    return _NAME.fullmatch(text) is not None


def key(name: str) -> str:
    """By which a person is found: names that differ in nothing but case or the way they are typed are one."""
    return unicodedata.normalize("NFKC", name).casefold()


class Account(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One account.

    Attributes:
        name: of the person, as others read it.
        role: the most that they may be at the page: this, or somebody who looks on.
        password: its digest.
    """

    name: str
    role: Role
    password: Digest

    def __post_init__(self) -> None:
        """Raises ValueError where the name is none."""
        if not is_name(self.name):
            raise ValueError(f"{self.name!r} is no name")


class Accounts(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """All accounts of a station, by name."""

    accounts: tuple[Account, ...] = ()

    def __post_init__(self) -> None:
        """Raises ValueError where two people have one name."""
        keys = [key(one.name) for one in self.accounts]
        if len(set(keys)) < len(keys):
            raise ValueError("two accounts have one name")

    def find(self, name: str) -> Account | None:
        """The account of somebody who says to be called so."""
        wanted = key(name)
        return next((one for one in self.accounts if key(one.name) == wanted), None)

    def known(self, name: str) -> Account:
        """The same, where there has to be one; raises NoSuchAccount."""
        found = self.find(name)
        if found is None:
            raise NoSuchAccount(name)
        return found

    def with_new(self, account: Account) -> Accounts:
        """These and another one; raises AccountThere."""
        if self.find(account.name) is not None:
            raise AccountThere(account.name)
        return self._of(*self.accounts, account)

    def with_changed(self, account: Account) -> Accounts:
        """The same, this one in the place of its name's; raises NoSuchAccount."""
        return self._of(*self.without(account.name).accounts, account)

    def without(self, name: str) -> Accounts:
        """The others; raises NoSuchAccount."""
        gone = self.known(name)
        return self._of(*(one for one in self.accounts if one is not gone))

    @staticmethod
    def _of(*accounts: Account) -> Accounts:
        return Accounts(tuple(sorted(accounts, key=lambda one: key(one.name))))
