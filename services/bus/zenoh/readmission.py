"""Who is let in follows the register: what is issued or revoked while a router runs counts within seconds.

Zenoh reads its rules once, when a session is opened. So the router is opened again where they change; whoever is
connected dials it again, with what its own certificate still allows.
"""

from __future__ import annotations

import logging
import threading
from typing import Protocol

from services.certificates.credentials import Credentials
from services.certificates.exceptions import CertificateError

log = logging.getLogger(__name__)

LOOK_S = 1.0
"""Between two looks at the register."""


class Reopened(Protocol):
    """The router."""

    end: threading.Event
    pace_ms: int

    def open_again(self, pace_ms: int) -> None:
        """Leave the network and come back."""
        ...


class Readmission(threading.Thread):
    """Looks at the register and at the router's own certificate; a daemon, for it may hang in the transport.

    Args:
        router: that lets in whom the register names.
        credentials: of the router.
    """

    def __init__(self, router: Reopened, credentials: Credentials) -> None:
        super().__init__(name="readmission", daemon=True)
        self._router = router
        self._credentials = credentials
        self._names = self._read()

    def run(self) -> None:
        """Look, again and again."""
        while not self._router.end.wait(LOOK_S):
            names = self._read()
            if names is None or names == self._names:
                continue
            come, gone = sorted(names - (self._names or set())), sorted((self._names or set()) - names)
            self._names = names
            log.warning(
                "the register of certificates has changed (%s): this router is opened again, whoever is connected here"
                " is cut off for a moment",
                ", ".join([*(f"{name} may come in" for name in come), *(f"{name} may not" for name in gone)]),
            )
            self._router.open_again(self._router.pace_ms)

    def _read(self) -> set[str] | None:
        """Whom it lets in; None where that cannot be read now, and what was read last counts."""
        try:
            return {one.common_name for one in self._credentials.register().admitted()}
        except (CertificateError, OSError) as error:
            log.warning("%s; whom this router lets in stays as it was", error)
            return None
