"""Accounts' failures, each one line."""

from __future__ import annotations

from pathlib import Path

from services.process.exceptions import ServiceError


class AccountError(ServiceError):
    """An account that cannot be made, found or used."""


class AccountsUnreadable(AccountError):
    """The file of accounts holds something else, or cannot be read."""

    def __init__(self, path: Path, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(
            f"{path} holds no accounts: {reason}; nobody can log in with it: move it away,"
            " and make them anew with 'retouch accounts add NAME'"
        )


class NameUnusable(AccountError):
    """A text that is no person's name."""

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(
            f"{name!r} is no name: give 1 to 40 letters, digits, spaces, . - _ ', a letter or digit first and none of"
            " the spaces last"
        )


class AccountThere(AccountError):
    """Somebody of this name has an account already."""

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(
            f"{name} has an account already: 'retouch accounts password' changes its password, and 'retouch accounts"
            " remove' takes it away"
        )


class NoSuchAccount(AccountError):
    """Nobody of this name has an account."""

    def __init__(self, name: str) -> None:
        self.name = name
        super().__init__(f"nobody called {name!r} has an account; 'retouch accounts list' names those who have")


class PasswordUnusable(AccountError):
    """A password that is none."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(f"this password cannot be used: {reason}")


class LoginImpossible(AccountError):
    """A page at which somebody should log in, and nobody can; or one that others reach, at which nobody has to."""

    def __init__(self, setting: str, reason: str) -> None:
        self.setting = setting
        self.reason = reason
        super().__init__(f"{setting}: {reason}")
