"""The register of an authority: whom it has issued certificates to, until when, and which of them were revoked."""

from __future__ import annotations

from datetime import UTC, datetime
from pathlib import Path

import msgspec

from protocol.exceptions import InvalidName
from protocol.rights import Subject, subject
from services.certificates.exceptions import Unreadable
from services.process.files import write_whole

REGISTER = "issued.json"


class Issued(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """One certificate.

    Attributes:
        name: whom it is for, `KIND.NAME`.
        generation: of the name: grows when a certificate of it is revoked.
        serial: its number, hexadecimal.
        until: when it ends, UTC.
        hosts: names and addresses under which its process is reached, where others dial it.
        revoked: when it was revoked, UTC; None where it was not.
    """

    name: str
    generation: int
    serial: str
    until: datetime
    hosts: tuple[str, ...] = ()
    revoked: datetime | None = None

    @property
    def subject(self) -> Subject:
        """Whom it is for."""
        return subject(self.name)

    @property
    def common_name(self) -> str:
        """What stands in the certificate. Routers know certificates by it: after a revocation it is another one."""
        return common_name(self.name, self.generation)


class Register(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """All certificates of an authority, the newest of each name."""

    issued: tuple[Issued, ...] = ()

    def find(self, name: str) -> Issued | None:
        """The newest certificate of the name."""
        return next((one for one in self.issued if one.name == name), None)

    def admitted(self) -> tuple[Issued, ...]:
        """Whom routers let in: all that were not revoked, but for pages.

        Whoever comes with an expired one is turned away by the handshake.
        """
        return tuple(one for one in self.issued if one.revoked is None and not one.subject.kind.page)

    def noting(self, issued: Issued) -> Register:
        """The register with the newest certificate of a name."""
        others = (one for one in self.issued if one.name != issued.name)
        return Register(tuple(sorted((*others, issued), key=lambda one: one.name)))


def common_name(name: str, generation: int) -> str:
    """Of a name's certificates since so many revocations."""
    return f"{name}~{generation}" if generation else name


def now() -> datetime:
    """The time of day, as certificates count it."""
    return datetime.now(UTC).replace(microsecond=0)


def load(folder: Path) -> Register:
    """The register in a folder; an empty one where there is none.

    Raises:
        Unreadable: it is no register.
    """
    path = folder / REGISTER
    try:
        register = msgspec.json.decode(path.read_bytes(), type=Register)
        for one in register.issued:
            subject(one.name)
    except FileNotFoundError:
        return Register()
    except (ValueError, RecursionError, InvalidName) as error:  # no UTF-8 among them
        raise Unreadable(path, f"it is no register of certificates ({error})") from None
    return register


def save(register: Register, folder: Path) -> None:
    """Keep the register in a folder.

    Raises:
        OSError: it cannot be written.
    """
    write_whole(folder / REGISTER, msgspec.json.format(msgspec.json.encode(register)) + b"\n")
