"""The certificate under which the page is served over HTTPS, judged before anybody waits for the page."""

from __future__ import annotations

import ssl
from pathlib import Path

from services.process.config import StationSection
from services.process.exceptions import UnusableSetting

CERTIFICATE, KEY = "[station] certificate", "[station] key"


def check(station: StationSection) -> None:
    """Whether certificate and key can be used together; nothing where there are none.

    Raises:
        UnusableSetting: a file cannot be read, is none of its kind, or the two do not belong together.
    """
    if not station.certificate:
        if station.key:
            raise UnusableSetting(KEY, f"{station.key} is of no use alone: name its certificate with {CERTIFICATE}")
        return
    for setting, name in ((CERTIFICATE, station.certificate), (KEY, station.key)):
        if name:
            _check_readable(setting, Path(name))
    try:
        ssl.SSLContext(ssl.PROTOCOL_TLS_SERVER).load_cert_chain(station.certificate, station.key or None, password="")
    except ssl.SSLError as error:
        where = station.key or station.certificate
        raise UnusableSetting(CERTIFICATE, f"{station.certificate} and the key in {where}: {_fault(error)}") from None


def _check_readable(setting: str, file: Path) -> None:
    try:
        file.read_bytes()
    except OSError as error:
        raise UnusableSetting(setting, f"{file}: {(error.strerror or str(error)).lower()}") from None


def _fault(error: ssl.SSLError) -> str:
    if error.reason == "KEY_VALUES_MISMATCH":
        return "they do not belong together"
    return "one of them is no PEM file of its kind, or the key has a passphrase"
