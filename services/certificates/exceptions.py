"""Certificates' failures, each one line."""

from __future__ import annotations

from pathlib import Path

from services.process.exceptions import ServiceError


class CertificateError(ServiceError):
    """A certificate that cannot be made, found or used."""


class NoAuthority(CertificateError):
    """The folder holds no authority that could issue anything."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        super().__init__(f"there is no certificate authority in {folder}: make one with 'retouch certs init'")


class AuthorityThere(CertificateError):
    """A folder that holds an authority already gets no other."""

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        super().__init__(f"{folder} holds a certificate authority already: it stays; name another folder with --folder")


class CannotIssue(CertificateError):
    """A certificate that is not issued, renewed or revoked."""

    def __init__(self, name: str, reason: str) -> None:
        self.name = name
        self.reason = reason
        super().__init__(f"{name}: {reason}")


class Unreadable(CertificateError):
    """A file of the folder that holds something else than it should."""

    def __init__(self, path: Path, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"{path} cannot be used: {reason}")


class CertificateMissing(CertificateError):
    """A process for which the folder holds no certificate."""

    def __init__(self, folder: Path, wanted: tuple[str, ...], remedy: str) -> None:
        self.folder = folder
        self.wanted = wanted
        self.remedy = remedy
        super().__init__(f"{folder} holds no certificate for {' or '.join(wanted)}: {remedy}")


class Unsecured(CertificateError):
    """An endpoint that others could reach or listen in on, without certificates."""

    def __init__(self, endpoint: str, reason: str, right: str) -> None:
        self.endpoint = endpoint
        self.reason = reason
        super().__init__(f"{endpoint} is open to others, and {reason}: {right}, or say --insecure")
