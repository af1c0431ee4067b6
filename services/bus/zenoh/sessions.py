"""Sessions of Zenoh: a client's, which dials until its router is there, and a router's."""

from __future__ import annotations

import contextlib
import json
import logging
import re
import socket
import threading
import time
from collections.abc import Callable
from pathlib import Path
from typing import Any

import zenoh

from services.bus.reach import OPEN_MOST_MS, Silence, open_timeout_ms, probe
from services.process.endpoint import Endpoint, parse
from services.process.exceptions import BusError, EndpointInUse, RouterUnreachable, ServiceError

log = logging.getLogger(__name__)

LEASE_MS = 1000
"""A link on which nothing was heard for so long is given up; a shorter cut TCP bridges by itself."""

REDIAL_MS = 20
"""Between two attempts to open a link again."""

ATTEMPTS = 3
"""To open a session's first link, before each may take longer."""

FULL_LINK_US = 200_000
"""How long what may not be dropped (a declaration) waits for room on a full link; then the link is dialled anew."""

CLOSE_S = 0.5
"""How long a session may take to leave; where its router hangs with a full link it would take ten seconds."""

TELL_S = 1.0
"""Between two lines that say what is waited for; a router that is being started is no news."""

POLL_S = 0.02


def _configuration(
    mode: str, connect: str | None, listen: str | None, open_ms: int, within_ms: int = -1
) -> zenoh.Config:
    """No discovery: a network is what was named. Links that die are noticed and dialled again within a second.

    Args:
        mode: "client" or "router".
        connect: whom to dial.
        listen: where to listen.
        open_ms: how long one attempt to open a link may take [ms].
        within_ms: a session that has no link by then does not open [ms]; -1 to open it without.
    """
    config: dict[str, Any] = {
        "mode": mode,
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "listen": {"endpoints": [listen] if listen else []},
        "connect": {
            "endpoints": [connect] if connect else [],
            "timeout_ms": within_ms,
            "exit_on_failure": within_ms >= 0,
            "retry": {"period_init_ms": REDIAL_MS, "period_max_ms": REDIAL_MS, "period_increase_factor": 1.0},
        },
        "transport": {
            "unicast": {"open_timeout": open_ms},
            "link": {
                "tx": {
                    "lease": LEASE_MS,
                    "queue": {"congestion_control": {"block": {"wait_before_close": FULL_LINK_US}}},
                }
            },
        },
    }
    return zenoh.Config.from_json5(json.dumps(config))


def open_router(listen: str, connect: str | None = None) -> zenoh.Session:
    """A Zenoh router: listens, and passes on what its clients and other routers send.

    Args:
        listen: the endpoint to listen on, such as "tcp/127.0.0.1:7447".
        connect: another router's endpoint, where there is one.

    Raises:
        BadEndpoint: one of them is none.
        EndpointInUse: nothing can listen there.
        BusError: the transport cannot use them.
    """
    parse(listen)
    trip = probe(parse(connect)) if connect else 0.0
    open_ms = open_timeout_ms(0.0 if isinstance(trip, Silence) else trip)
    try:
        session = zenoh.open(_configuration("router", connect, listen, open_ms))
    except zenoh.ZError as error:
        if "listener bound to" in str(error):
            raise EndpointInUse(listen) from None
        raise BusError(f"cannot open a router on {listen}: {reason(error)}") from None
    _give_up_with_the_lease()
    return session


def _give_up_with_the_lease() -> None:
    """Let the kernel give up what cannot be delivered over an accepted link as soon as the lease does.

    Zenoh closes a link with SO_LINGER, which holds up one of its few threads, and with it other links, until TCP has
    sent the rest once more: up to seconds after a link that was cut is back. Accepted sockets inherit the time.
    """
    for file in list(Path("/proc/self/fd").iterdir()):
        with (
            contextlib.suppress(OSError),  # this one is no socket, or the listing's own
            socket.fromfd(int(file.name), socket.AF_INET, socket.SOCK_STREAM) as listener,
        ):
            if listener.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN):
                listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, LEASE_MS)


def open_session(
    connect: str,
    timeout_s: float,
    stop: threading.Event | None = None,
    tell: Callable[[str], None] | None = None,
) -> zenoh.Session:
    """A client's session; waits until the router is there, and says what it waits for.

    Args:
        connect: the router's endpoint.
        timeout_s: how long to wait at most [s].
        stop: ends the waiting too.
        tell: called once a second with what is waited for; by default it is logged when it changes.

    Raises:
        BadEndpoint: the endpoint is none, or nobody knows its host; at once.
        RouterUnreachable: no router answered in time.
        BusError: the transport cannot use the endpoint.
        KeyboardInterrupt: `stop` was set.
    """
    tell = tell or _News()
    dialling = _Dialling(parse(connect))
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
    session = dialling.session
    if session is None:
        dialling.give_up()
        raise RouterUnreachable(connect, timeout_s, dialling.silence)
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


class _Dialling(threading.Thread):
    """Waits until somebody listens, then opens the session; a daemon, for it may hang in the transport.

    Attributes:
        session: once it is open.
        error: why it never will be.
        silence: why it is not open yet.

    Args:
        endpoint: of the router.
    """

    def __init__(self, endpoint: Endpoint) -> None:
        super().__init__(name="dialling", daemon=True)
        self.session: zenoh.Session | None = None
        self.error: ServiceError | None = None
        self.silence = "it does not answer as a router"
        self._endpoint = endpoint
        self._given_up = threading.Event()

    def give_up(self) -> None:
        """A session that opens later is closed again."""
        self._given_up.set()

    def run(self) -> None:
        """Dial."""
        try:
            trip = self._reach()
            session = None if trip is None else self._open(open_timeout_ms(trip))
        except zenoh.ZError as error:
            self.error = BusError(f"cannot connect to {self._endpoint.text}: {reason(error)}")
        except ServiceError as error:
            self.error = error
        else:
            self.session = session
            if session is not None and self._given_up.is_set():
                close_session(session)

    def _reach(self) -> float | None:
        while isinstance(trip := probe(self._endpoint), Silence):
            self.silence = trip.reason
            if self._given_up.wait(REDIAL_MS / 1e3):
                return None
        self.silence = "something listens there, but does not answer as a router"
        return trip

    def _open(self, open_ms: int) -> zenoh.Session | None:
        """A session; each attempt is given twice the time, for a router on a busy machine answers late."""
        least_ms = open_ms
        while (session := self._attempt(open_ms)) is None:
            if self._given_up.is_set():
                return None
            open_ms = min(2 * open_ms, OPEN_MOST_MS)
        # It dials a cut link at the pace at which it was opened: the router may only have begun late.
        sooner = self._attempt(least_ms) if open_ms > least_ms else None
        if sooner is None:
            return session
        close_session(session)
        return sooner

    def _attempt(self, open_ms: int) -> zenoh.Session | None:
        try:
            return zenoh.open(_configuration("client", self._endpoint.text, None, open_ms, ATTEMPTS * open_ms))
        except zenoh.ZError as error:
            if "Timeout!" not in str(error):
                raise
            return None


def close_session(session: zenoh.Session) -> None:
    """Leave the network; without it a process with a subscriber never ends.

    A session that cannot leave in `CLOSE_S` is left behind: its router will notice by itself.
    """
    closing = threading.Thread(target=_close, args=(session,), name="closing", daemon=True)
    closing.start()
    closing.join(CLOSE_S)


def _close(session: zenoh.Session) -> None:
    try:
        session.close()  # type: ignore[no-untyped-call]  # Zenoh's stub leaves it bare
    except zenoh.ZError as error:
        log.debug("the session could not leave: %s", reason(error))


def reason(error: zenoh.ZError) -> str:
    """The error without the place in Zenoh's source."""
    return re.sub(r" at \S+\.rs:\d+\.?", "", str(error).splitlines()[0])
