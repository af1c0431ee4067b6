"""With which certificate the operator's page is served, and under which address others open it."""

from __future__ import annotations

from pathlib import Path

import msgspec

from protocol.rights import Subject
from services.certificates.credentials import Credentials, folder, subjects_in
from services.certificates.exceptions import Unsecured
from services.process.addresses import EVERYWHERE, in_url, is_loopback
from services.process.config import Configuration, StationSection
from services.process.exceptions import UnusableSetting

SETTING = "[station] certificate"

_REMEDY = (
    "issue it a certificate ('retouch certs issue page.NAME --host HOST', copied here),"
    " name one with [station] certificate"
)


def of_page(configuration: Configuration) -> Credentials | None:
    """This machine's certificate for its page; None where the page needs none, or has another one.

    Raises:
        UnusableSetting: there are several, and none is the robot's.
        FolderUnusable: there is no folder for a user's settings.
    """
    station = configuration.station
    if station.certificate or is_loopback(station.host):
        return None
    where = folder(configuration.tls)
    there = [one for one in subjects_in(where) if one.kind.page]
    if not there:
        return None
    return Credentials(where, _one_of(there, configuration.name, where))


def _one_of(there: list[Subject], robot: str, where: Path) -> Subject:
    if len(there) == 1:
        return there[0]
    found = next((one for one in there if one.name == robot), None)
    if found is None:
        names = ", ".join(f"{one}.pem" for one in there)
        raise UnusableSetting(SETTING, f"{where} holds several for a page: name {names} there")
    return found


def secured(configuration: Configuration) -> StationSection:
    """The station as it is served: with this machine's certificate, where others reach it and it names none.

    Raises:
        Unsecured: others reach the page, it has no certificate, and nobody said that it may be open.
        UnusableSetting: see `of_page`.
        FolderUnusable: see `of_page`.
    """
    station = configuration.station
    found = of_page(configuration)
    if found is not None:
        return msgspec.structs.replace(station, certificate=str(found.file), key="")
    if not (station.certificate or configuration.insecure or is_loopback(station.host)):
        raise Unsecured(f"[station] host {station.host!r}", "the page would be served over plain HTTP", _REMEDY)
    return station


def is_plain(configuration: Configuration) -> bool:
    """Whether others reach the page, and what it says can be read on the way; raises as `secured`."""
    station = secured(configuration)
    return not (station.certificate or is_loopback(station.host))


def address(station: StationSection, otherwise: str) -> str:
    """Where a browser opens the page.

    Args:
        station: as it is served.
        otherwise: host of one that listens everywhere, and whose certificate names no host.
    """
    host = station.host
    if host in EVERYWHERE:
        host = next(iter(hosts(Path(station.certificate)) if station.certificate else ()), otherwise)
    return f"{station.scheme}://{in_url(host)}:{station.port}/"


def hosts(file: Path) -> tuple[str, ...]:
    """Names and addresses that a certificate vouches for; none where it cannot be read."""
    # Imported here: it takes a while, and most pages are of one machine.
    from cryptography import x509  # noqa: PLC0415

    try:
        certificate = x509.load_pem_x509_certificate(file.read_bytes())
        names = certificate.extensions.get_extension_for_class(x509.SubjectAlternativeName).value
    except (OSError, ValueError, x509.ExtensionNotFound):
        return ()
    known = [str(name.value) for name in names if isinstance(name, x509.DNSName | x509.IPAddress)]
    return tuple(name for name in known if "*" not in name)
