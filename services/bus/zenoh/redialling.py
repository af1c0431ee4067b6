"""What brings a link back that Zenoh does not find again by itself.

Zenoh dials a link that was cut for ever, but at the pace of the way as it was when the session was opened: each attempt
is given up after the same time. Over a way that has become longer, or to a router that answers later than then, none of
them comes through.
"""

from __future__ import annotations

import logging
import threading
import time
from typing import Protocol

from services.bus.reach import Silence, fits, probe
from services.bus.zenoh.dialling import Dialling, Opened
from services.bus.zenoh.transport import POLL_S
from services.process.endpoint import Endpoint
from services.process.exceptions import BadEndpoint

log = logging.getLogger(__name__)

LOOK_S = 1.0
"""Between two looks at a link that is there."""

GRACE_S = 2.0
"""How long Zenoh may take to open the link by itself once the way is there, where its pace fits the way."""

AGAIN_S = 0.2
"""Between two looks whether the way is there."""


class Redialled(Protocol):
    """Who needs the link."""

    @property
    def endpoint(self) -> Endpoint:
        """Of the router at its other end."""
        ...

    @property
    def pace_ms(self) -> int:
        """How long each attempt to open it again may take [ms]."""
        ...

    def is_linked(self) -> bool:
        """Whether it is there."""
        ...

    def take(self, opened: Opened) -> None:
        """It was not there, but a session could be opened, which is the taker's from now on."""
        ...


class Redialling(threading.Thread):
    """Looks after a link; a daemon, for it may hang in the transport.

    Args:
        link: to look after.
        end: set where it is needed no more.
    """

    def __init__(self, link: Redialled, end: threading.Event) -> None:
        super().__init__(name="redialling", daemon=True)
        self._link = link
        self._end = end

    def run(self) -> None:
        """Look once a second."""
        while not self._end.wait(LOOK_S):
            if not self._link.is_linked():
                self._redial()

    def _redial(self) -> None:
        trip = self._reach()
        if trip is None or (fits(self._link.pace_ms, trip) and self._over_within(GRACE_S)):
            return
        dialling = Dialling(self._link.endpoint)
        dialling.start()
        while dialling.is_alive() and not self._over_within(POLL_S):
            pass
        if self._over_within(0.0):
            dialling.give_up()
        elif dialling.opened is not None:
            self._link.take(dialling.opened)
        else:
            log.debug("cannot dial %s: %s", self._link.endpoint.text, dialling.error)

    def _reach(self) -> float | None:
        """The trip to the router, once the way is there [s]; None where that is not asked any more."""
        while not self._over_within(AGAIN_S):
            try:
                trip = probe(self._link.endpoint)
            except BadEndpoint:  # whoever knew the host's name is out of reach too
                continue
            if not isinstance(trip, Silence):
                return trip
        return None

    def _over_within(self, seconds: float) -> bool:
        """Whether nobody has to dial any more: the link is there, or not needed."""
        deadline = time.monotonic() + seconds
        while not (self._end.is_set() or self._link.is_linked()):
            left = deadline - time.monotonic()
            if left <= 0.0:
                return False
            self._end.wait(min(POLL_S, left))
        return True
