"""Datagrams beside a session: a sample that is lost delays none that comes after it, as it would on a stream.

They go to the router's port over UDP, and carry what comes again within a moment. Where none come through, the
session's own link carries that as well: it is decided all the time, for each subscription by what comes.
"""

from __future__ import annotations

import contextlib
import logging
import threading
import time
from collections.abc import Callable

import zenoh

from services.bus.zenoh.dialling import Opened, linked
from services.bus.zenoh.session import Session
from services.bus.zenoh.transport import configuration, leave, settings

log = logging.getLogger(__name__)

LOOK_S = 0.05
"""Between two looks at what has come."""

SILENT_S = 0.3
"""Without a datagram for so long, what is subscribed to comes over the stream too."""

AGAIN_S, AGAIN_MOST_S = 0.3, 2.0
"""A declaration may be lost as well, and is repeated until something comes: at first after so long, then ever later."""

DIAL_S, DIAL_MOST_S = 0.05, 0.2
"""The same, of opening the way."""

Declare = Callable[[zenoh.Session, Callable[[zenoh.Sample], None]], "zenoh.Subscriber[None]"]


class _Stream:
    """A subscription over the session's own link, which is there while it is needed.

    Args:
        session: that it is declared on, and on whichever takes its place.
        declare: declares it.
    """

    def __init__(self, session: Session, declare: Callable[[zenoh.Session], zenoh.Subscriber[None]]) -> None:
        self._session = session
        self._declare = declare
        self._needed = True
        self._subscribers: list[zenoh.Subscriber[None]] = []
        session.declare(self._declared)

    def _declared(self, current: zenoh.Session) -> None:
        if self._needed:
            self._subscribers.append(self._declare(current))

    def keep(self, *, needed: bool) -> None:
        """Have it where it is needed, and only there."""
        self._needed = needed
        if needed and not self._subscribers:
            self._session.use(lambda opened: self._declared(opened.session))
        while self._subscribers and not needed:
            with contextlib.suppress(zenoh.ZError):  # it went with its session
                self._subscribers.pop().undeclare()  # type: ignore[no-untyped-call]  # Zenoh's stub leaves it bare


class _Subscription:
    """What is to come as datagrams.

    Args:
        session: whose link serves where none come.
        declare: declares a subscription.
        store: called with each sample, whichever way it came.
    """

    def __init__(self, session: Session, declare: Declare, store: Callable[[zenoh.Sample], None]) -> None:
        self._declare = declare
        self._store = store
        self._heard_s = -1.0
        self._due_s = 0.0
        self._again_s = AGAIN_S
        self._subscriber: zenoh.Subscriber[None] | None = None
        self._stream = _Stream(session, lambda current: declare(current, store))

    def _hear(self, sample: zenoh.Sample) -> None:
        self._heard_s = time.monotonic()
        self._store(sample)

    def begin(self) -> None:
        """There is another way, on which nothing is declared."""
        self._subscriber = None
        self._due_s, self._again_s = 0.0, AGAIN_S

    def look(self, session: zenoh.Session | None) -> None:
        """Declare it until it is heard; the stream serves as long as it is not."""
        now = time.monotonic()
        heard = session is not None and now - self._heard_s < SILENT_S
        if session is not None and not heard and now >= self._due_s:
            if self._subscriber is not None:
                self._subscriber.undeclare()  # type: ignore[no-untyped-call]  # as above
            self._subscriber = self._declare(session, self._hear)
            self._due_s, self._again_s = now + self._again_s, min(2.0 * self._again_s, AGAIN_MOST_S)
        if heard:
            self._again_s = AGAIN_S
        self._stream.keep(needed=not heard)


class Datagrams(threading.Thread):
    """The way of a session's datagrams; a daemon, for it may hang in the transport.

    Args:
        session: that they go beside.
        router: the endpoint to which they go.
    """

    def __init__(self, session: Session, router: str) -> None:
        super().__init__(name="datagrams", daemon=True)
        self._session = session
        self._router = router
        self._subscriptions: list[_Subscription] = []
        self._opened: Opened | None = None
        self._end = threading.Event()

    def put(self, send: Callable[[zenoh.Session], None]) -> bool:
        """Send, by the function, where there is a way; whether there was."""
        opened = self._opened
        if opened is None or opened.lost.is_set():
            return False
        try:
            send(opened.session)
        except zenoh.ZError:  # it was lost in this moment
            return False
        return True

    def subscribe(self, declare: Declare, store: Callable[[zenoh.Sample], None]) -> None:
        """Receive as datagrams what the function declares, and over the session's link where none come."""
        self._subscriptions.append(_Subscription(self._session, declare, store))

    def run(self) -> None:
        """Keep the way open."""
        wait_s = DIAL_S
        while not self._end.wait(wait_s):
            opened = self._open()
            if opened is None:
                wait_s = min(2.0 * wait_s, DIAL_MOST_S)
                continue
            wait_s = DIAL_S
            self._opened = opened
            self._carry(opened)
            self._opened = None
            leave(opened.session)

    def close(self) -> None:
        """Leave the network."""
        self._end.set()
        if self._opened is not None:
            leave(self._opened.session)

    def _open(self) -> Opened | None:
        pace_ms = self._session.pace_ms
        try:
            session = zenoh.open(configuration(settings("client", self._router, None, pace_ms, within_ms=pace_ms)))
        except zenoh.ZError:
            return None
        return linked(session, pace_ms)

    def _carry(self, opened: Opened) -> None:
        for subscription in list(self._subscriptions):
            subscription.begin()
        while not self._end.is_set() and not opened.lost.wait(LOOK_S):
            self._look(opened.session)
        self._look(None)

    def _look(self, session: zenoh.Session | None) -> None:
        for subscription in list(self._subscriptions):
            with contextlib.suppress(zenoh.ZError):  # one of the two was lost in this moment; there is another look
                subscription.look(session)
