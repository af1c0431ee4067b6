"""The file of accounts, in the user's folder of settings, and whoever follows it while it changes."""

from __future__ import annotations

from pathlib import Path

import msgspec

from services.accounts.account import Accounts
from services.accounts.exceptions import AccountsUnreadable
from services.process.files import settings_folder, signature, write_whole

NAME = "accounts.json"

LARGEST = 1 << 20
"""Of the file [byte]."""

_PRIVATE = 0o600


def accounts_path() -> Path:
    """Where the accounts are.

    Raises:
        FolderUnusable: there is no folder for a user's settings.
    """
    return settings_folder() / NAME


def load(path: Path) -> Accounts:
    """The accounts in a file; none where there is no file.

    Raises:
        AccountsUnreadable: it holds something else, or cannot be read.
    """
    try:
        if path.stat().st_size > LARGEST:
            raise AccountsUnreadable(path, f"it is larger than {LARGEST >> 20} MiB")
        return msgspec.json.decode(path.read_bytes(), type=Accounts)
    except FileNotFoundError:
        return Accounts()
    except OSError as error:
        raise AccountsUnreadable(path, (error.strerror or str(error)).lower()) from None
    except (ValueError, RecursionError) as error:  # no UTF-8 among them
        raise AccountsUnreadable(path, str(error)) from None


def save(accounts: Accounts, path: Path) -> None:
    """Keep the accounts; whoever else has this machine cannot read them.

    Raises:
        OSError: they cannot be written.
    """
    write_whole(path, msgspec.json.format(msgspec.json.encode(accounts)) + b"\n", mode=_PRIVATE)


class AccountsFile:
    """The accounts as they are now: read again where the file has changed.

    Args:
        path: of the file.

    Attributes:
        accounts: as they were read last; none where they cannot be read.
        fault: why they cannot be read; empty where they can.
    """

    def __init__(self, path: Path) -> None:
        self._path = path
        self._signature: tuple[int, int, int] | None = None
        self.accounts = Accounts()
        self.fault = ""
        self._read()

    def refresh(self) -> bool:
        """Look at the file; whether it was read again."""
        if signature(self._path) == self._signature:
            return False
        self._read()
        return True

    def _read(self) -> None:
        self._signature = signature(self._path)  # before it is read: what changes meanwhile is read again
        try:
            self.accounts, self.fault = load(self._path), ""
        except AccountsUnreadable as error:
            self.accounts, self.fault = Accounts(), str(error)
