"""A certificate's end is told in time: what is connected goes on, but nobody comes back with one that has ended."""

from __future__ import annotations

import logging
import threading
from datetime import datetime, timedelta
from pathlib import Path

from services.certificates.credentials import Credentials
from services.certificates.register import now

log = logging.getLogger(__name__)

NOTICE = timedelta(days=1)
LOOK_S = 600.0


class Expiry(threading.Thread):
    """Looks at a certificate's file until its process ends; a daemon.

    Args:
        credentials: that are looked at.
    """

    def __init__(self, credentials: Credentials) -> None:
        super().__init__(name="expiry", daemon=True)
        self._credentials = credentials

    def run(self) -> None:
        """Tell, and look again."""
        waiting = threading.Event()
        while True:
            self.tell()
            waiting.wait(LOOK_S)

    def tell(self) -> None:
        """Log what there is to say now."""
        line = notice(str(self._credentials.subject), self._credentials.file, now())
        if line:
            log.warning("%s", line)


def ends(file: Path) -> datetime:
    """When the certificate in a file ends, UTC.

    Raises:
        OSError: it cannot be read.
        ValueError: it holds none.
    """
    # Imported here: it takes a while, and a control loop's process does other things first.
    from cryptography import x509  # noqa: PLC0415

    return x509.load_pem_x509_certificate(file.read_bytes()).not_valid_after_utc


def notice(name: str, file: Path, at: datetime) -> str:
    """What there is to say about a certificate; empty where it lasts long enough, or cannot be read now."""
    try:
        left = ends(file) - at
    except (OSError, ValueError):
        return ""
    if left > NOTICE:
        return ""
    remedy = f"'retouch certs renew {name}' makes a new one; what is connected stays connected"
    if left <= timedelta():
        return f"the certificate {name} has ended: nothing connects with it any more; {remedy}"
    return f"the certificate {name} ends in {left / timedelta(hours=1):.0f} h: {remedy}"
