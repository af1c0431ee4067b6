"""A router: where the processes of a site meet, and which can join another site's."""

from __future__ import annotations

import contextlib
import logging
import socket
import threading
from pathlib import Path
from typing import Any

import zenoh

from services.bus.reach import Silence, open_timeout_ms, probe
from services.bus.zenoh.dialling import Opened
from services.bus.zenoh.readmission import Readmission
from services.bus.zenoh.redialling import Redialling
from services.bus.zenoh.transport import LEASE_MS, REDIAL_MS, configuration, leave, reason, settings
from services.certificates.credentials import Credentials
from services.process.endpoint import Endpoint, parse
from services.process.exceptions import BusError, EndpointInUse, ServiceError

UNSENT_BYTES = 16_384
"""So much waits in the kernel at most, beyond what is on its way."""

_NOTSENT_LOWAT = getattr(socket, "TCP_NOTSENT_LOWAT", 25)
"""Linux' number; Python has a name for it from 3.12 on."""

log = logging.getLogger(__name__)


class Router:
    """A Zenoh router: listens, and passes on what its clients and other routers send.

    Args:
        listen: the endpoint to listen on, such as "tcp/127.0.0.1:7447".
        connect: another router's endpoint, where there is one.
        opened: Zenoh's session, as it was opened first.
        credentials: to show to whoever comes, and which name whom to let in; None where everybody may.

    Attributes:
        credentials: to show to whoever comes, and to the other router.
        pace_ms: how long each attempt to open the link to the other router may take [ms].
        end: set once the router is closed.
    """

    def __init__(
        self, listen: str, connect: str | None, opened: Opened, credentials: Credentials | None = None
    ) -> None:
        self.credentials = credentials
        self.pace_ms = opened.pace_ms
        self.end = threading.Event()
        self._listen = listen
        self._connect = connect
        self._session = opened.session
        self._exchange = threading.Lock()  # never held while Zenoh is called: that may hang

    def joined(self) -> list[zenoh.ZenohId]:
        """The other routers that this one has links with, whoever dialled."""
        return self._session.info.routers_zid()

    def open_again(self, pace_ms: int) -> None:
        """Leave the network and come back, with so long for each attempt to open the link to the other router [ms]."""
        leave(self._session)
        told = ""
        while not self.end.is_set():
            try:
                session = _opened(self._listen, self._connect, pace_ms, self.credentials)
            except ServiceError as error:  # what hangs in the old one still holds the port
                if str(error) != told:
                    told = str(error)
                    log.warning("trying again: %s", told)
                self.end.wait(REDIAL_MS / 1e3)
                continue
            with self._exchange:
                if not self.end.is_set():
                    self._session, self.pace_ms = session, pace_ms
                    return
            leave(session)

    def close(self) -> None:
        """Leave the network."""
        with self._exchange:
            self.end.set()
        leave(self._session)


class Uplink:
    """A router's link to another one. At which pace it opens is tried by a client's session, which cuts nobody off.

    Args:
        router: that joins the other one.
        endpoint: of the other one.

    Attributes:
        endpoint: of the other one.
    """

    def __init__(self, router: Router, endpoint: Endpoint) -> None:
        self.endpoint = endpoint
        self._router = router
        self._other: zenoh.ZenohId | None = None

    @property
    def credentials(self) -> Credentials | None:
        """To show to the other router."""
        return self._router.credentials

    @property
    def pace_ms(self) -> int:
        """How long each attempt to open it again may take [ms]."""
        return self._router.pace_ms

    def is_linked(self) -> bool:
        """Whether it is there."""
        return self._other is not None and self._other in self._router.joined()

    def take(self, opened: Opened) -> bool:
        """Learn who the other router is; dial it at this pace, where its own is too quick for the router."""
        self._other = opened.router
        leave(opened.session)
        if self.is_linked() or opened.pace_ms <= self.pace_ms:
            return self.is_linked()
        log.warning(
            "the router at %s answers later than before: this one is opened again to dial it more slowly;"
            " whoever is connected here is cut off for a moment",
            self.endpoint.text,
        )
        self._router.open_again(opened.pace_ms)
        return False


def router_settings(listen: str, connect: str | None = None, credentials: Credentials | None = None) -> dict[str, Any]:
    """What such a router is opened with, as the official zenohd reads it in a file; raises as `open_router`."""
    parse(listen)
    return _settings(listen, connect, _pace_ms(parse(connect) if connect else None), credentials)


def open_router(listen: str, connect: str | None = None, credentials: Credentials | None = None) -> Router:
    """A router, which finds the other one however long the way there has become.

    Args:
        listen: the endpoint to listen on, such as "tcp/127.0.0.1:7447".
        connect: another router's endpoint, where there is one.
        credentials: to show to whoever comes, and which name whom to let in; None where everybody may.

    Raises:
        BadEndpoint: one of them is none.
        EndpointInUse: nothing can listen there.
        BusError: the transport cannot use them.
        Unreadable: the register of certificates is none.
    """
    parse(listen)
    other = parse(connect) if connect else None
    pace_ms = _pace_ms(other)
    router = Router(listen, connect, Opened(_opened(listen, connect, pace_ms, credentials), pace_ms), credentials)
    if other is not None:
        Redialling(Uplink(router, other), router.end).start()
    if credentials is not None:
        Readmission(router, credentials).start()
    return router


def _pace_ms(other: Endpoint | None) -> int:
    """At which the other router is dialled, as far as the way there is known now."""
    trip = probe(other) if other is not None else 0.0
    return open_timeout_ms(0.0 if isinstance(trip, Silence) else trip)


def _settings(listen: str, connect: str | None, pace_ms: int, credentials: Credentials | None) -> dict[str, Any]:
    return settings("router", connect, listen, pace_ms, credentials=credentials)


def _opened(listen: str, connect: str | None, pace_ms: int, credentials: Credentials | None) -> zenoh.Session:
    try:
        session = zenoh.open(configuration(_settings(listen, connect, pace_ms, credentials)))
    except zenoh.ZError as error:
        if "listener bound to" in str(error):
            raise EndpointInUse(listen) from None
        raise BusError(f"cannot open a router on {listen}: {reason(error)}") from None
    _let_little_wait()
    return session


def _let_little_wait() -> None:
    """Let the kernel give up what cannot be delivered over an accepted link as soon as the lease does.

    Zenoh closes a link with SO_LINGER, which holds up one of its few threads, and with it other links, until TCP has
    sent the rest once more: up to seconds after a link that was cut is back. And let it take no more than it can send
    soon: what waits in the kernel is never dropped, and by priority only what waits in Zenoh goes first. Accepted
    sockets inherit both.
    """
    # What is no socket must not be taken for one: Python makes a copy of it, and forgets that where it fails.
    for file in [file for file in Path("/proc/self/fd").iterdir() if file.is_socket()]:
        with (
            contextlib.suppress(OSError),  # it was closed meanwhile, or is no TCP socket
            socket.fromfd(int(file.name), socket.AF_INET, socket.SOCK_STREAM) as listener,
        ):
            if listener.getsockopt(socket.SOL_SOCKET, socket.SO_ACCEPTCONN):
                listener.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, LEASE_MS)
                listener.setsockopt(socket.IPPROTO_TCP, _NOTSENT_LOWAT, UNSENT_BYTES)
