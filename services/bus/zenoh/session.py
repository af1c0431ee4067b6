"""A client's session: waits until its router is there, and finds it again when the way to it has become another."""

from __future__ import annotations

import logging
import threading
import time
from collections.abc import Callable
from typing import TypeVar

import zenoh

from services.bus.zenoh.dialling import Dialling, Opened
from services.bus.zenoh.redialling import Redialling
from services.bus.zenoh.transport import POLL_S, leave, reason
from services.certificates.credentials import Credentials
from services.process.endpoint import Endpoint, parse
from services.process.exceptions import RouterUnreachable

T = TypeVar("T")

log = logging.getLogger(__name__)

TELL_S = 1.0
"""Between two lines that say what is waited for; a router that is being started is no news."""


class Session:
    """A client's session with the network, which outlives Zenoh's. Safe to use from several threads.

    Args:
        endpoint: of the router.
        opened: Zenoh's session, as it was opened first.
        credentials: that are shown to the router; None where it asks for none.

    Attributes:
        endpoint: of the router.
        credentials: that are shown to it.
    """

    def __init__(self, endpoint: Endpoint, opened: Opened, credentials: Credentials | None = None) -> None:
        self.endpoint = endpoint
        self.credentials = credentials
        self._opened = opened
        self._declarations: list[Callable[[zenoh.Session], object]] = []
        self._end = threading.Event()
        self._exchange = threading.Lock()  # never held while Zenoh is called: that may hang
        self._redialling = Redialling(self, self._end)

    @property
    def current(self) -> zenoh.Session:
        """Zenoh's session, as long as it lasts."""
        return self._opened.session

    @property
    def pace_ms(self) -> int:
        """How long each attempt to open the link again may take [ms]."""
        return self._opened.pace_ms

    def is_linked(self) -> bool:
        """Whether there is a link to the router, and was all the time since this session took its place."""
        return not self._opened.lost.is_set()

    def use(self, act: Callable[[Opened], T]) -> T:
        """What the act returns, with Zenoh's session as it is now; once more where that was exchanged meanwhile."""
        while True:
            opened = self._opened
            try:
                return act(opened)
            except zenoh.ZError:
                if opened is self._opened:
                    raise

    def declare(self, declaration: Callable[[zenoh.Session], object]) -> None:
        """Declare something now, and on every session that takes the place of this one."""
        with self._exchange:
            self._declarations.append(declaration)
            opened = self._opened
        try:
            opened.declared.append(declaration(opened.session))
        except zenoh.ZError:
            if opened is self._opened:
                raise

    def look_after(self) -> None:
        """Find the router again from now on, however long the way has become."""
        self._redialling.start()

    def take(self, opened: Opened) -> bool:
        """Put a session in the place of one that had lost its router; whether it is there now."""
        try:
            old = self._exchanged(opened)
        except zenoh.ZError as error:
            log.debug("the new session was lost at once: %s", reason(error))
            leave(opened.session)
            return False
        if old is opened:
            leave(opened.session)
            return False
        log.debug("the router at %s is linked again, over a session that was opened anew", self.endpoint.text)
        # A session is never freed whose publishers outlive it. Each ends once nobody holds it: undeclaring one with
        # which another thread publishes right now is an error.
        old.publishers.clear()
        leave(old.session)
        return True

    def _exchanged(self, opened: Opened) -> Opened:
        """Declare everything on the session, and use it from then on; whichever is used no more."""
        while True:
            with self._exchange:
                missing = self._declarations[len(opened.declared) :]
                if self._end.is_set():
                    return opened
                if not missing:
                    old, self._opened = self._opened, opened
                    return old
            opened.declared.extend(declaration(opened.session) for declaration in missing)

    def close(self) -> None:
        """Leave the network."""
        with self._exchange:
            self._end.set()
        leave(self.current)


def open_session(
    connect: str,
    timeout_s: float,
    stop: threading.Event | None = None,
    tell: Callable[[str], None] | None = None,
    credentials: Credentials | None = None,
) -> Session:
    """A client's session; waits until the router is there, and says what it waits for.

    Args:
        connect: the router's endpoint.
        timeout_s: how long to wait at most [s].
        stop: ends the waiting too.
        tell: called once a second with what is waited for; by default it is logged when it changes.
        credentials: to show to the router; None where it asks for none.

    Raises:
        BadEndpoint: the endpoint is none, or nobody knows its host; at once.
        RouterUnreachable: no router answered in time.
        BusError: the transport cannot use the endpoint.
        KeyboardInterrupt: `stop` was set.
    """
    tell = tell or _News()
    endpoint = parse(connect)
    dialling = Dialling(endpoint, credentials)
    dialling.start()
    now = time.monotonic()
    deadline, due = now + timeout_s, now + TELL_S
    while dialling.is_alive() and now < deadline:
        if stop is not None and stop.is_set():
            dialling.give_up()
            raise KeyboardInterrupt
        if now >= due:
            tell(f"waiting for a router at {connect}: {dialling.silence}")
            due += TELL_S
        dialling.join(POLL_S)
        now = time.monotonic()
    if dialling.error is not None:
        raise dialling.error
    opened = dialling.opened
    if opened is None:
        dialling.give_up()
        raise RouterUnreachable(connect, timeout_s, dialling.silence)
    session = Session(endpoint, opened, credentials)
    session.look_after()
    return session


class _News:
    """Logs a line where it is another one than before."""

    def __init__(self) -> None:
        self._told = ""

    def __call__(self, line: str) -> None:
        """Tell."""
        if line != self._told:
            self._told = line
            log.info("%s", line)
