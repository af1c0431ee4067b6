"""What brings a link back as it was before.

Zenoh dials a link that was cut for ever, but at the pace of the way as it was when the session was opened: each attempt
is given up after the same time. Over a way that has become longer, or to a router that answers later than then, none of
them comes through. And where the first attempts came too late for the router, a link that it does find again may be
deaf: nothing arrives on it, because the router has not heard what is subscribed to. So Zenoh's own link serves until a
session that is opened anew takes its place.
"""

from __future__ import annotations

import logging
import threading
from typing import Protocol

from services.bus.reach import Silence, fits, probe
from services.bus.zenoh.dialling import Dialling, Opened
from services.bus.zenoh.transport import POLL_S, redial_ms
from services.certificates.credentials import Credentials
from services.process.endpoint import Endpoint
from services.process.exceptions import BadEndpoint

log = logging.getLogger(__name__)

LOOK_S = 0.25
"""Between two looks whether the link was lost meanwhile."""

OWN_ATTEMPTS = 2
"""Of Zenoh's own, which nobody else dials beside once the way is there, where its pace fits it: a stop that waits comes
first. One began too early to find the way, the next finds it."""

AGAIN_S = 0.2
"""Between two looks whether the way is there."""


def grace_s(pace_ms: int, credentials: Credentials | None) -> float:
    """How long a link is left to Zenoh once the way is there [s].

    Args:
        pace_ms: how long each attempt to open it again may take [ms].
        credentials: that are shown; None where there are none.
    """
    return OWN_ATTEMPTS * (pace_ms + redial_ms(credentials)) / 1e3


class Redialled(Protocol):
    """Who needs the link."""

    @property
    def endpoint(self) -> Endpoint:
        """Of the router at its other end."""
        ...

    @property
    def credentials(self) -> Credentials | None:
        """To show to it."""
        ...

    @property
    def pace_ms(self) -> int:
        """How long each attempt to open it again may take [ms]."""
        ...

    def is_linked(self) -> bool:
        """Whether it is there, and was all the time."""
        ...

    def take(self, opened: Opened) -> bool:
        """Take over a session that was opened since it was lost; whether all is as before now."""
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
        """Look, again and again."""
        lost = False
        while not self._end.wait(LOOK_S):
            lost = lost or not self._link.is_linked()
            if lost:
                lost = not self._restored()

    def _restored(self) -> bool:
        trip = self._reach()
        if trip is None:
            return False
        if fits(self._link.pace_ms, trip):
            self._end.wait(grace_s(self._link.pace_ms, self._link.credentials))
        dialling = Dialling(self._link.endpoint, self._link.credentials)
        dialling.start()
        while dialling.is_alive() and not self._end.wait(POLL_S):
            pass
        if self._end.is_set():
            dialling.give_up()
        elif dialling.opened is not None:
            return self._link.take(dialling.opened)
        else:
            log.debug("cannot dial %s: %s", self._link.endpoint.text, dialling.error)
        return False

    def _reach(self) -> float | None:
        """The trip to the router, once the way is there [s]; None where that is not asked any more."""
        while not self._end.wait(AGAIN_S):
            try:
                trip = probe(self._link.endpoint)
            except BadEndpoint:  # whoever knew the host's name is out of reach too
                continue
            if not isinstance(trip, Silence):
                return trip
        return None
