"""Judges passwords on a thread of its own, one at a time: that takes long by intent, and nothing else is to wait."""

from __future__ import annotations

import asyncio
import contextlib
import os
import threading
from collections.abc import AsyncIterator, Callable
from concurrent.futures import ThreadPoolExecutor

from services.accounts.account import Account, Accounts
from services.accounts.file import AccountsFile

NICE = 5
"""How far the thread stands back from the processor."""

WAITING_AT_MOST = 8

IsRight = Callable[[str, Account | None], bool]
"""Whether a password is an account's; takes as long where there is no account."""


class Busy(Exception):
    """So many are judged already that another one would wait too long."""


class Judge:
    """Knows whose password is right, as the accounts are now.

    Args:
        file: of the accounts.
        is_right: see `IsRight`.
    """

    def __init__(self, file: AccountsFile, is_right: IsRight) -> None:
        self._file = file
        self._is_right = is_right
        self._turn = asyncio.Lock()
        self._waiting = 0
        self._thread = ThreadPoolExecutor(1, "passwords", initializer=_stand_back)

    @property
    def accounts(self) -> Accounts:
        """As they were read last; none where they cannot be read."""
        return self._file.accounts

    @property
    def fault(self) -> str:
        """Why the accounts cannot be read; empty where they can."""
        return self._file.fault

    @contextlib.asynccontextmanager
    async def turn(self) -> AsyncIterator[None]:
        """In which nobody else is judged; raises Busy."""
        if self._waiting >= WAITING_AT_MOST:
            raise Busy
        self._waiting += 1
        try:
            async with self._turn:
                yield
        finally:
            self._waiting -= 1

    async def judged(self, name: str, password: str) -> Account | None:
        """The account of whoever says this name and password; None where they do not belong together."""
        return await asyncio.get_running_loop().run_in_executor(self._thread, self._judge, name, password)

    async def refresh(self) -> bool:
        """Look whether the accounts have changed."""
        return await asyncio.get_running_loop().run_in_executor(self._thread, self._file.refresh)

    def close(self) -> None:
        """Judge nobody any more."""
        self._thread.shutdown(wait=False, cancel_futures=True)

    def _judge(self, name: str, password: str) -> Account | None:
        self._file.refresh()
        account = self._file.accounts.find(name)
        return account if self._is_right(password, account) else None


def _stand_back() -> None:
    with contextlib.suppress(OSError):
        os.setpriority(os.PRIO_PROCESS, threading.get_native_id(), NICE)
