"""Whether somebody listens at an endpoint, and how far away that is."""

from __future__ import annotations

import contextlib
import errno
import os
import selectors
import socket
import time
from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass, field
from typing import cast

from services.process.endpoint import OVER_TCP, Endpoint
from services.process.exceptions import BadEndpoint

_Place = tuple[int, int, int, str, tuple[str, int] | tuple[str, int, int, int] | tuple[int, bytes]]

PROBE_S = 2.0
"""Longer than any way there and back."""

AGAIN_S = 0.1
"""Between two attempts that run side by side: a cut link is found again as soon as it is back, and none is lost."""

TRIPS = 5
"""How often the way is measured; the shortest is its length, for a busy machine makes single ones ten times as long."""

MEASURE_S = 0.2
"""After so long no further trip is begun."""

UNMEASURED_S = 0.17
"""The way to a listener with TLS. One that is dialled and shown no certificate takes nobody else for 0.1 s."""

OPEN_LEAST_MS = 150
OPEN_MOST_MS = 10_000
OPEN_TRIPS = 5
"""Those of a handshake; the rest is for jitter. Whatever takes longer is sooner there by dialling again."""

HANDSHAKE_TRIPS = 3
"""Open a link."""

LEISURE = 2
"""Times as long as it need be: a pace at which a link that was cut is found again too late."""


@dataclass(frozen=True)
class Silence:
    """Nobody was reached.

    Attributes:
        reason: as the system says.
        code: the same as a number of `errno`; 0 where it has none.
    """

    reason: str
    code: int = field(default=0, compare=False)


def probe(endpoint: Endpoint) -> float | Silence:
    """The round trip to whoever listens at the endpoint [s], or why there is nobody.

    Where nothing can be learnt without the transport itself (no TCP below it) the trip counts as nought; where asking
    would do harm it counts as `UNMEASURED_S`.

    Raises:
        BadEndpoint: no such host is known.
    """
    found = places(endpoint)
    if isinstance(found, Silence):
        return found
    if endpoint.protocol == "tls":
        return UNMEASURED_S
    return _nearest(found, _shortest) if endpoint.protocol in OVER_TCP else 0.0


def knock(endpoint: Endpoint) -> float | Silence:
    """As `probe`, asked once of a listener with TLS too, which takes nobody else for 0.1 s then: not for repetition."""
    if endpoint.protocol != "tls":
        return probe(endpoint)
    found = places(endpoint)
    return found if isinstance(found, Silence) else _nearest(found, _race)


def places(endpoint: Endpoint) -> Sequence[_Place] | Silence:
    """Where its host is, or why nobody can be asked that.

    Raises:
        BadEndpoint: no such host is known.
    """
    try:
        return socket.getaddrinfo(endpoint.host, endpoint.port, type=socket.SOCK_STREAM)
    except (socket.gaierror, UnicodeError) as error:
        if isinstance(error, socket.gaierror) and error.errno == socket.EAI_AGAIN:
            return Silence("no name server answers")
        right = f"{endpoint.protocol}/192.0.2.1:{endpoint.port}"
        raise BadEndpoint(endpoint.text, f"the host {endpoint.host!r} is not known here", right) from None


def _nearest(found: Iterable[_Place], measured: Callable[[_Place], float]) -> float | Silence:
    """The trip to the first place where somebody listens [s]."""
    silence = Silence("")
    for place in found:
        try:
            return measured(place)
        except OSError as error:
            silence = Silence((error.strerror or "no answer").lower(), error.errno or 0)
    return silence


def _shortest(place: _Place) -> float:
    """The shortest of some trips [s]; a first one that was sent again, as after a cut, is far too long.

    Raises:
        OSError: the first failed.
    """
    shortest = _race(place)
    end = time.monotonic() + MEASURE_S
    for _ in range(TRIPS - 1):
        if time.monotonic() > end:
            break
        with contextlib.suppress(OSError):
            shortest = min(shortest, _race(place))
    return shortest


def _race(place: _Place) -> float:
    """The trip of the attempt that connects first [s]; raises OSError where one fails, or none came through."""
    family, kind, protocol, _, address = place
    end = time.monotonic() + PROBE_S
    with contextlib.ExitStack() as sockets, selectors.DefaultSelector() as waiting:
        while time.monotonic() < end:
            attempt = sockets.enter_context(socket.socket(family, kind, protocol))
            attempt.setblocking(False)
            began = time.monotonic()
            code = attempt.connect_ex(address)
            if code not in (0, errno.EINPROGRESS):
                raise OSError(code, os.strerror(code))
            waiting.register(attempt, selectors.EVENT_WRITE, began)
            for key, _ in waiting.select(AGAIN_S):
                failed = cast(socket.socket, key.fileobj).getsockopt(socket.SOL_SOCKET, socket.SO_ERROR)
                if failed:
                    raise OSError(failed, os.strerror(failed))
                return time.monotonic() - cast(float, key.data)
    raise TimeoutError(errno.ETIMEDOUT, "no answer")


def open_timeout_ms(trip_s: float) -> int:
    """How long opening a link may take over such a round trip.

    Short where the way is short: a link that was cut is dialled again as soon as the dialling under way is given up.

    Args:
        trip_s: there and back [s].
    """
    return round(min(OPEN_MOST_MS, OPEN_LEAST_MS + 1e3 * OPEN_TRIPS * trip_s))


def fits(pace_ms: int, trip_s: float) -> bool:
    """Whether links open over such a round trip at this pace, and not much later than they could.

    Args:
        pace_ms: how long each attempt to open one may take [ms].
        trip_s: there and back [s].
    """
    return 1e3 * HANDSHAKE_TRIPS * trip_s < pace_ms <= LEISURE * open_timeout_ms(trip_s)
