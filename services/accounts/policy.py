"""Whether somebody has to log in at the page: wherever others than this machine reach it."""

from __future__ import annotations

from services.accounts.exceptions import LoginImpossible
from services.accounts.file import accounts_path, load
from services.certificates.page import is_plain
from services.process.addresses import is_loopback
from services.process.config import Configuration

ALWAYS, NEVER = "always", "never"

SETTING = "[station] login"

_REMEDY = "make them with 'retouch accounts add NAME'"


def page_is_open(configuration: Configuration) -> bool:
    """Whether others reach the page, and read on the way what passes or need no account; raises as these do."""
    return is_plain(configuration) or not (is_loopback(configuration.station.host) or asks(configuration))


def asks(configuration: Configuration) -> bool:
    """Whether the page asks who is there.

    Raises:
        LoginImpossible: it has to and there are no accounts, or it is not to and others reach it.
        AccountsUnreadable: the file of accounts holds something else.
        FolderUnusable: there is no folder for a user's settings.
    """
    station = configuration.station
    own, said = is_loopback(station.host), configuration.insecure
    if station.login == NEVER:
        if own or said:
            return False
        raise LoginImpossible(SETTING, f"without a log-in whoever reaches {station.host} commands: say --insecure")
    if own and station.login != ALWAYS:
        return False
    if load(accounts_path()).accounts:
        return True
    if station.login == ALWAYS:
        raise LoginImpossible(SETTING, f"nobody can log in, for there are no accounts: {_REMEDY}")
    if said:
        return False
    raise LoginImpossible(
        "[station] host", f"others reach the page on {station.host}, and there are no accounts: {_REMEDY}"
    )
