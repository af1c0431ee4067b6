"""Dialling: a client's session is opened however late its router answers, at the quickest pace that opens it."""

from __future__ import annotations

import threading
from dataclasses import dataclass, field

import zenoh

from services.bus.reach import OPEN_MOST_MS, Silence, open_timeout_ms, probe
from services.bus.zenoh.transport import REDIAL_MS, configuration, leave, reason, settings
from services.certificates.credentials import Credentials
from services.process.endpoint import Endpoint
from services.process.exceptions import BusError, ServiceError

ATTEMPTS = 3
"""To open a session's first link, before each may take longer."""


@dataclass(frozen=True)
class Opened:
    """A session with a link.

    Attributes:
        session: the session.
        pace_ms: how long each of its attempts to open the link again may take [ms].
        router: at the other end of the link; none where that was lost at once.
        lost: set once the link was lost, whether or not Zenoh has found it again since.
        publishers: that were declared on it, by their keys; empty at first.
        declared: whatever else was; some of it lasts only as long as it is kept.
    """

    session: zenoh.Session
    pace_ms: int
    router: zenoh.ZenohId | None = None
    lost: threading.Event = field(default_factory=threading.Event, compare=False)
    publishers: dict[str, zenoh.Publisher] = field(default_factory=dict)
    declared: list[object] = field(default_factory=list)


class Dialling(threading.Thread):
    """Waits until somebody listens, then opens the session; a daemon, for it may hang in the transport.

    Attributes:
        opened: the session, once it is open.
        error: why it never will be.
        silence: why it is not open yet.

    Args:
        endpoint: of the router.
        credentials: to show to it; None where it asks for none.
    """

    def __init__(self, endpoint: Endpoint, credentials: Credentials | None = None) -> None:
        super().__init__(name="dialling", daemon=True)
        self.opened: Opened | None = None
        self.error: ServiceError | None = None
        self.silence = "it does not answer as a router"
        self._endpoint = endpoint
        self._credentials = credentials
        self._given_up = threading.Event()
        self._handing_over = threading.Lock()

    def give_up(self) -> None:
        """A session that has opened, or opens later, is closed again."""
        with self._handing_over:
            self._given_up.set()
            opened, self.opened = self.opened, None
        if opened is not None:
            leave(opened.session)

    def run(self) -> None:
        """Dial."""
        try:
            trip = self._reach()
            opened = None if trip is None else self._open(open_timeout_ms(trip))
        except zenoh.ZError as error:
            self.error = BusError(f"cannot connect to {self._endpoint.text}: {reason(error)}")
        except ServiceError as error:
            self.error = error
        else:
            if opened is not None:
                self._hand_over(opened)

    def _hand_over(self, opened: Opened) -> None:
        with self._handing_over:
            if not self._given_up.is_set():
                self.opened = opened
                return
        leave(opened.session)

    def _reach(self) -> float | None:
        while isinstance(trip := probe(self._endpoint), Silence):
            self.silence = trip.reason
            if self._given_up.wait(REDIAL_MS / 1e3):
                return None
        self.silence = "something listens there, but does not answer as a router"
        if self._credentials is not None:
            who = self._credentials.subject
            self.silence = f"there is none, or it does not let {who} in ('retouch certs list' says whether it ended)"
        return trip

    def _open(self, least_ms: int) -> Opened | None:
        """A session; each attempt is given twice the time, for a router on a busy machine answers late."""
        pace_ms = least_ms
        while (session := self._attempt(pace_ms)) is None:
            if self._given_up.is_set():
                return None
            pace_ms = min(2 * pace_ms, OPEN_MOST_MS)
        # It dials a cut link at the pace at which it was opened: the router may only have begun late.
        sooner = self._attempt(least_ms) if pace_ms > least_ms else None
        if sooner is None:
            return linked(session, pace_ms)
        leave(session)
        return linked(sooner, least_ms)

    def _attempt(self, pace_ms: int) -> zenoh.Session | None:
        try:
            within_ms = ATTEMPTS * pace_ms
            made = settings(
                "client", self._endpoint.text, None, pace_ms, within_ms=within_ms, credentials=self._credentials
            )
            return zenoh.open(configuration(made))
        except zenoh.ZError as error:
            if "Timeout!" not in str(error):
                raise
            return None


def linked(session: zenoh.Session, pace_ms: int) -> Opened:
    """The session, which has just been opened, and whether its link is lost later."""
    lost = threading.Event()

    def note(event: zenoh.TransportEvent) -> None:
        if event.kind == zenoh.SampleKind.DELETE:
            lost.set()

    # What has a callback lasts as long as the session. The router is asked for afterwards: no loss falls between.
    session.info.declare_transport_events_listener(note)
    router = next(iter(session.info.routers_zid()), None)
    if router is None:
        lost.set()
    return Opened(session, pace_ms, router, lost)
