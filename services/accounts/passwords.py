"""Passwords: which can be used, and how one is known again by its digest alone (argon2id, RFC 9106)."""

from __future__ import annotations

import unicodedata

from argon2 import PasswordHasher
from argon2.exceptions import InvalidHashError, VerificationError

from services.accounts.account import Account
from services.accounts.exceptions import PasswordUnusable

SHORTEST = 8
"""Characters."""

LONGEST = 1024
"""Bytes, in UTF-8."""

_HASHER = PasswordHasher(time_cost=1, memory_cost=46 * 1024, parallelism=1)
"""Passes, memory [KiB] and cores, the first choice of OWASP's cheat sheet of password storage: a tenth of a second of
one core, for the others of a desk hold a robot."""

NOBODYS = f"$argon2id$v=19$m=47104,t=1,p=1${'A' * 22}${'A' * 43}"
"""A digest of the same costs that no password is known to have: whoever has no account is judged by it, as slowly."""


def digest(password: str) -> str:
    """What is kept of a password.

    Raises:
        PasswordUnusable: it is too short or too long.
    """
    normal = _normal(password)
    if len(normal) < SHORTEST:
        raise PasswordUnusable(f"it has {len(normal)} characters; give at least {SHORTEST}")
    if len(_bytes(normal)) > LONGEST:
        raise PasswordUnusable(f"it is longer than {LONGEST} bytes; give a shorter one")
    return _HASHER.hash(_bytes(normal))


def is_right(password: str, account: Account | None) -> bool:
    """Whether this is the account's password; takes as long where there is no account, and is none then."""
    try:
        _HASHER.verify(account.password if account is not None else NOBODYS, _bytes(_normal(password)))
    except (VerificationError, InvalidHashError):
        return False
    return account is not None


def _normal(password: str) -> str:
    """However its letters are put together on a keyboard (NIST SP 800-63B, section 5.1.1.2)."""
    return unicodedata.normalize("NFKC", password)


def _bytes(password: str) -> bytes:
    return password.encode("utf-8", "surrogatepass")
