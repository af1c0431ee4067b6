"""The certificate under which the page is served over HTTPS: judged before it is, renewed while it is."""

from __future__ import annotations

import logging
import ssl
from pathlib import Path

from services.process.config import StationSection
from services.process.exceptions import UnusableSetting
from services.process.files import signature

CERTIFICATE, KEY = "[station] certificate", "[station] key"

log = logging.getLogger(__name__)


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


class Renewal:
    """Shows browsers a certificate that was renewed on the disk, from the next connection on.

    Args:
        station: names its files.
        context: under which the page is served.
    """

    def __init__(self, station: StationSection, context: ssl.SSLContext) -> None:
        self._station = station
        self._context = context
        self._files = [Path(name) for name in (station.certificate, station.key) if name]
        self._known = self._stamps()

    def look(self) -> None:
        """Where the files have changed, and can be used, use them."""
        stamps = self._stamps()
        if stamps == self._known:
            return
        self._known = stamps
        try:
            check(self._station)
        except UnusableSetting as error:
            log.warning("%s; the page goes on with the certificate that it had", error)
            return
        self._context.load_cert_chain(self._station.certificate, self._station.key or None)
        log.info("the page's certificate was renewed")

    def _stamps(self) -> list[tuple[int, int, int] | None]:
        return [signature(file) for file in self._files]


def _check_readable(setting: str, file: Path) -> None:
    try:
        file.read_bytes()
    except OSError as error:
        raise UnusableSetting(setting, f"{file}: {(error.strerror or str(error)).lower()}") from None


def _fault(error: ssl.SSLError) -> str:
    if error.reason == "KEY_VALUES_MISMATCH":
        return "they do not belong together"
    return "one of them is no PEM file of its kind, or the key has a passphrase"
