"""Sessions of people who have logged in: in memory only, each found again by a token that only its browser has."""

from __future__ import annotations

import hashlib
import secrets
from collections.abc import Callable, Iterable

from services.accounts.account import Account, Accounts
from services.process.clock import Clock

UNUSED_NS = 12 * 3600 * 1_000_000_000
"""A session that is not used for so long ends."""

MOST = 64
"""Sessions; of more the one that was unused longest ends."""

TOKEN_BYTES = 32


class Session:
    """Somebody who has logged in.

    Args:
        account: with which they did.
        now_ns: when.

    Attributes:
        account: as it was then.
        ended: it counts no more.
        used_ns: when they did anything last.
    """

    def __init__(self, account: Account, now_ns: int) -> None:
        self.account = account
        self.ended = False
        self.used_ns = now_ns


class Sessions:
    """All of them. Of one thread, which serves the page.

    Args:
        clock: by which they age.

    Attributes:
        on_end: called with a session that has ended, at once.
    """

    def __init__(self, clock: Clock) -> None:
        self.on_end: Callable[[Session], None] = lambda _: None
        self._clock = clock
        self._sessions: dict[bytes, Session] = {}

    def open(self, account: Account) -> str:
        """Begin one; its token, of 256 random bits, which is kept nowhere else."""
        token = secrets.token_urlsafe(TOKEN_BYTES)
        now_ns = self._clock.now_ns()
        self._sessions[_digest(token)] = Session(account, now_ns)
        if len(self._sessions) > MOST:
            self._end([min(self._sessions, key=lambda one: self._sessions[one].used_ns)])
        return token

    def find(self, token: str) -> Session | None:
        """The session of this token, which is used by that; None where there is none, or none any more."""
        self.expire()
        found = self._sessions.get(_digest(token))
        if found is not None:
            found.used_ns = self._clock.now_ns()
        return found

    def end(self, session: Session) -> None:
        """Somebody logs out."""
        self._end(one for one, kept in self._sessions.items() if kept is session)

    def expire(self) -> None:
        """End those that were not used."""
        now_ns = self._clock.now_ns()
        self._end(one for one, kept in self._sessions.items() if now_ns - kept.used_ns >= UNUSED_NS)

    def follow(self, accounts: Accounts) -> None:
        """End those of people whose account is gone, or another one by now: its password, its role."""
        self._end(one for one, kept in self._sessions.items() if accounts.find(kept.account.name) != kept.account)

    def _end(self, digests: Iterable[bytes]) -> None:
        for digest in list(digests):
            session = self._sessions.pop(digest)
            session.ended = True
            self.on_end(session)


def _digest(token: str) -> bytes:
    return hashlib.sha256(token.encode()).digest()
