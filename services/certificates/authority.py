"""A certificate authority in a folder: issues, renews and revokes the certificates of a network."""

from __future__ import annotations

import ipaddress
import re
from collections.abc import Sequence
from datetime import datetime, timedelta
from pathlib import Path

from cryptography import x509
from cryptography.hazmat.primitives import hashes, serialization
from cryptography.hazmat.primitives.asymmetric import ec
from cryptography.x509.oid import ExtendedKeyUsageOID, NameOID

from protocol.exceptions import InvalidName
from protocol.rights import KINDS, Subject, subject
from services.certificates import register
from services.certificates.exceptions import AuthorityThere, CannotIssue, NoAuthority, Unreadable
from services.certificates.register import Issued, Register
from services.process.files import make_folder, write_whole
from services.process.processes import NOBODY_IN_PARTICULAR

ROOT = "ca.pem"
ROOT_KEY = "ca.key"

ROOT_DAYS = 3650
DAYS = 14
"""A certificate lasts, where nobody says how long."""

LONGEST_DAYS = 397

SKEW = timedelta(minutes=5)
"""Clocks of the machines of a network may differ by so much."""

_OWN_HOSTS = ("localhost", "127.0.0.1", "::1")
_PRIVATE = 0o600

_HOST = re.compile(r"(\*\.)?[A-Za-z0-9_]([A-Za-z0-9_.-]{0,251}[A-Za-z0-9_])?")


class Authority:
    """The authority in a folder.

    Args:
        folder: where it is.

    Raises:
        NoAuthority: there is none.
        Unreadable: its files hold something else.
    """

    def __init__(self, folder: Path) -> None:
        self.folder = folder
        try:
            self._root = x509.load_pem_x509_certificate((folder / ROOT).read_bytes())
            self._key = _private_key(folder / ROOT_KEY)
        except FileNotFoundError:
            raise NoAuthority(folder) from None
        except ValueError as error:
            raise Unreadable(folder / ROOT, f"it is no authority's certificate ({error})") from None
        if self._root.public_key() != self._key.public_key():
            raise Unreadable(folder / ROOT_KEY, f"it is not the key of {ROOT}")
        self._register = register.load(folder)

    @property
    def register(self) -> Register:
        """Whom it has issued certificates to."""
        return self._register

    def issue(self, name: str, days: int = DAYS, hosts: Sequence[str] = (), to: Path | None = None) -> Issued:
        """Make somebody's first certificate, or the first after a revocation, with a key of its own.

        Args:
            name: whom it is for, `KIND.NAME`.
            days: how long it lasts.
            hosts: names and addresses under which a router, or a page, is reached.
            to: the folder of the machine that it is for; by default the authority's own.

        Raises:
            CannotIssue: it is no name of a certificate, or there is a valid one.
            OSError: it cannot be written.
        """
        whose = _subject(name)
        before = self._register.find(name)
        if before is not None and before.revoked is None:
            raise CannotIssue(name, f"it has a certificate until {before.until:%Y-%m-%d %H:%M} UTC: renew or revoke it")
        wrong = next((host for host in hosts if not _is_host(host)), None)
        if wrong is not None:
            raise CannotIssue(name, f"--host {wrong!r} is neither a host's name nor an address, such as desk.lan")
        if whose.kind.page and not hosts:
            raise CannotIssue(name, "say with --host under which name or address browsers of others open the page")
        generation = before.generation + 1 if before is not None else 0
        return self._make(whose, generation, days, tuple(hosts), to)

    def renew(self, name: str, days: int = DAYS, to: Path | None = None) -> Issued:
        """Make a new certificate in the place of one that was not revoked; raises as `issue`."""
        before = self._valid(name)
        return self._make(before.subject, before.generation, days, before.hosts, to)

    def revoke(self, name: str) -> Issued:
        """Let a certificate count no more, at every router that has the new register; raises as `issue`."""
        self._valid(name)
        revoked = self._register.find(name)
        assert revoked is not None
        noted = Issued(
            revoked.name, revoked.generation, revoked.serial, revoked.until, revoked.hosts, revoked=register.now()
        )
        self._note(noted)
        return noted

    def _valid(self, name: str) -> Issued:
        found = self._register.find(str(_subject(name)))
        if found is None:
            raise CannotIssue(name, "no certificate was issued to it; 'retouch certs list' names them all")
        if found.revoked is not None:
            raise CannotIssue(name, f"its certificate was revoked on {found.revoked:%Y-%m-%d %H:%M} UTC: issue another")
        return found

    def _make(self, whose: Subject, generation: int, days: int, hosts: tuple[str, ...], to: Path | None) -> Issued:
        if not 1 <= days <= LONGEST_DAYS:
            raise CannotIssue(str(whose), f"a certificate lasts from 1 to {LONGEST_DAYS} days, not {days}")
        key = ec.generate_private_key(ec.SECP256R1())
        until = min(register.now() + timedelta(days=days), self._root.not_valid_after_utc)
        issued = Issued(str(whose), generation, "", until, hosts)
        certificate = self._signed(issued, key)
        issued = Issued(str(whose), generation, f"{certificate.serial_number:x}", until, hosts)
        folder = _folder(to or self.folder)
        write_whole(folder / f"{whose}.pem", _pem(key) + _pem(certificate), mode=_PRIVATE)
        self._note(issued)
        if folder != self.folder:
            write_whole(folder / ROOT, _pem(self._root))
            register.save(self._register, folder)
        return issued

    def _signed(self, issued: Issued, key: ec.EllipticCurvePrivateKey) -> x509.Certificate:
        kind = issued.subject.kind
        usages = [] if kind.page else [ExtendedKeyUsageOID.CLIENT_AUTH]
        builder = _builder(issued.common_name, self._root.subject, key, issued.until)
        if kind.dialled:  # nobody else can pass for a router or a page
            usages.append(ExtendedKeyUsageOID.SERVER_AUTH)
            # A page vouches for what it was told alone: with more of them its key would be worth more to a thief.
            hosts = issued.hosts if kind.page else (*_OWN_HOSTS, *issued.hosts)
            names = [_general_name(host) for host in dict.fromkeys(hosts)]
            builder = builder.add_extension(x509.SubjectAlternativeName(names), critical=False)
        return (
            builder.add_extension(x509.BasicConstraints(ca=False, path_length=None), critical=True)
            .add_extension(x509.ExtendedKeyUsage(usages), critical=False)
            .sign(self._key, hashes.SHA256())
        )

    def _note(self, issued: Issued) -> None:
        self._register = self._register.noting(issued)
        register.save(self._register, self.folder)


def make_authority(folder: Path) -> Authority:
    """A new authority in a folder.

    A key that is there alone is that of one that was not made to its end, as when the power went: it stays.

    Raises:
        AuthorityThere: the folder holds one.
        Unreadable: it holds a key that is none.
        OSError: it cannot be written.
    """
    if any((folder / name).exists() for name in (ROOT, register.REGISTER)):
        raise AuthorityThere(folder)
    folder = _folder(folder)
    begun = (folder / ROOT_KEY).exists()
    key = _private_key(folder / ROOT_KEY) if begun else ec.generate_private_key(ec.SECP256R1())
    name = x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, "Retouch certificate authority")])
    builder = _builder("Retouch certificate authority", name, key, register.now() + timedelta(days=ROOT_DAYS))
    certificate = (
        builder.add_extension(x509.BasicConstraints(ca=True, path_length=0), critical=True)
        .add_extension(x509.KeyUsage(*_ONLY_SIGNS), critical=True)
        .sign(key, hashes.SHA256())
    )
    write_whole(folder / ROOT_KEY, _pem(key), mode=_PRIVATE)
    write_whole(folder / ROOT, _pem(certificate))
    register.save(Register(), folder)
    return Authority(folder)


_ONLY_SIGNS = (False, False, False, False, False, True, True, False, False)
"""Of the uses of a key, in the order of `x509.KeyUsage`: certificates and lists of revoked ones."""


def _builder(
    common_name: str, issuer: x509.Name, key: ec.EllipticCurvePrivateKey, until: datetime
) -> x509.CertificateBuilder:
    return (
        x509.CertificateBuilder()
        .subject_name(x509.Name([x509.NameAttribute(NameOID.COMMON_NAME, common_name)]))
        .issuer_name(issuer)
        .public_key(key.public_key())
        .serial_number(x509.random_serial_number())
        .not_valid_before(register.now() - SKEW)
        .not_valid_after(until)
    )


def _subject(name: str) -> Subject:
    try:
        whose = subject(name)
    except InvalidName:
        kinds = ", ".join(kind.name for kind in KINDS)
        raise CannotIssue(
            name, f"this is no name of a certificate: KIND.NAME, such as operator.anna; the kinds are {kinds}"
        ) from None
    if whose.kind.person and whose.name == NOBODY_IN_PARTICULAR:
        raise CannotIssue(name, "this is how a person without a name is called: give the person's own")
    return whose


def _general_name(host: str) -> x509.GeneralName:
    try:
        return x509.IPAddress(ipaddress.ip_address(host))
    except ValueError:
        return x509.DNSName(host)


def _is_host(text: str) -> bool:
    try:
        ipaddress.ip_address(text)
    except ValueError:
        return _HOST.fullmatch(text) is not None
    return True


def _private_key(path: Path) -> ec.EllipticCurvePrivateKey:
    try:
        key: object = serialization.load_pem_private_key(path.read_bytes(), password=None)
    except ValueError as error:
        raise Unreadable(path, f"it is no key ({error})") from None
    if not isinstance(key, ec.EllipticCurvePrivateKey):
        raise Unreadable(path, "it is no key that 'retouch certs init' made")
    return key


def _pem(what: x509.Certificate | ec.EllipticCurvePrivateKey) -> bytes:
    if isinstance(what, x509.Certificate):
        return what.public_bytes(serialization.Encoding.PEM)
    return what.private_bytes(
        serialization.Encoding.PEM, serialization.PrivateFormat.PKCS8, serialization.NoEncryption()
    )


def _folder(folder: Path) -> Path:
    make_folder(folder, mode=0o700)
    return folder
