"""This machine's certificate, by itself: is it there, of the authority beside it, in its time, and not revoked."""

from __future__ import annotations

from datetime import datetime
from pathlib import Path

from cryptography import x509
from cryptography.exceptions import InvalidSignature
from cryptography.x509.oid import NameOID

from services.certificates import register
from services.certificates.credentials import Credentials
from services.certificates.exceptions import Unreadable
from services.certificates.expiry import NOTICE
from services.commands.doctor.finding import Finding, look, ok, wrong

CERTIFICATE = "certificate"

_COPY = "copy the folder of 'retouch certs issue --to' here again"


def examined(shown: Credentials, at: datetime) -> Finding:
    """How it stands with a certificate of this machine.

    Args:
        shown: which.
        at: by this machine's clock, UTC.
    """
    try:
        certificate = _read(shown.file)
        root = _read(shown.root)
        issued = register.load(shown.folder).find(str(shown.subject))
    except (OSError, ValueError) as error:
        return wrong(CERTIFICATE, f"{shown.folder} cannot be used: {error}", _COPY)
    except Unreadable as error:
        return wrong(CERTIFICATE, str(error), _COPY)
    if not _issued_by(root, certificate):
        return wrong(CERTIFICATE, f"{shown.file} was not issued by the authority of the {shown.root.name} there", _COPY)
    return (
        _timed(shown, certificate, root, at)
        or _revoked(shown, certificate, issued)
        or ok(CERTIFICATE, f"{shown.subject} is valid until {certificate.not_valid_after_utc:%Y-%m-%d %H:%M} UTC")
    )


def _timed(shown: Credentials, certificate: x509.Certificate, root: x509.Certificate, at: datetime) -> Finding | None:
    """What its time says against it, or its authority's."""
    name, until = shown.subject, certificate.not_valid_after_utc
    if at < certificate.not_valid_before_utc:
        told = f"{name} is valid from {certificate.not_valid_before_utc:%Y-%m-%d %H:%M} UTC only, and here it is"
        return wrong(CERTIFICATE, f"{told} {at:%Y-%m-%d %H:%M} UTC", "set this machine's clock, or the authority's")
    if at >= root.not_valid_after_utc:
        remedy = "make another one with 'retouch certs init', and all certificates anew"
        return wrong(CERTIFICATE, f"its authority has ended on {root.not_valid_after_utc:%Y-%m-%d %H:%M} UTC", remedy)
    renew = f"'retouch certs renew {name}' where the authority is, and copy it here"
    if at >= until:
        here = f"here it is {at:%Y-%m-%d %H:%M} UTC"
        return wrong(CERTIFICATE, f"{name} has ended on {until:%Y-%m-%d %H:%M} UTC, {here}", renew)
    if until - at <= NOTICE:
        return look(CERTIFICATE, f"{name} ends on {until:%Y-%m-%d %H:%M} UTC", renew)
    return None


def _revoked(shown: Credentials, certificate: x509.Certificate, issued: register.Issued | None) -> Finding | None:
    """What the register beside it says against it; the routers have their own."""
    if issued is None or (issued.revoked is None and issued.common_name == common_name(certificate)):
        return None
    told = f"{shown.subject} was revoked, says the {register.REGISTER} beside it"
    return wrong(CERTIFICATE, told, f"'retouch certs issue {shown.subject}' where the authority is, and copy it here")


def common_name(certificate: x509.Certificate) -> str:
    """Whom it is for, as routers know it; empty where it names nobody."""
    names = certificate.subject.get_attributes_for_oid(NameOID.COMMON_NAME)
    return str(names[0].value) if names else ""


def _read(path: Path) -> x509.Certificate:
    return x509.load_pem_x509_certificate(path.read_bytes())


def _issued_by(root: x509.Certificate, certificate: x509.Certificate) -> bool:
    try:
        certificate.verify_directly_issued_by(root)
    except (ValueError, TypeError, InvalidSignature):
        return False
    return True
