"""Whether somebody listens at an endpoint, and how far away that is."""

from __future__ import annotations

import socket
import time
from dataclasses import dataclass

from services.bus.endpoint import OVER_TCP, Endpoint
from services.process.exceptions import BadEndpoint

PROBES = 2
"""Of which the faster one tells the distance: one may have lost a packet."""

PROBE_S = 1.0

OPEN_LEAST_MS = 200
OPEN_MOST_MS = 10_000
OPEN_TRIPS = 8
"""Three round trips open a link; the rest is for jitter and for a packet that is sent again."""


@dataclass(frozen=True)
class Silence:
    """Nobody was reached.

    Attributes:
        reason: as the system says.
    """

    reason: str


def probe(endpoint: Endpoint) -> float | Silence:
    """The round trip to whoever listens at the endpoint [s], or why there is nobody.

    Where nothing can be learnt without the transport itself (no TCP below it) the trip counts as nought.

    Raises:
        BadEndpoint: no such host is known.
    """
    try:
        places = socket.getaddrinfo(endpoint.host, endpoint.port, type=socket.SOCK_STREAM)
    except (socket.gaierror, UnicodeError) as error:
        if isinstance(error, socket.gaierror) and error.errno == socket.EAI_AGAIN:
            return Silence("no name server answers")
        right = f"{endpoint.protocol}/192.0.2.1:{endpoint.port}"
        raise BadEndpoint(endpoint.text, f"the host {endpoint.host!r} is not known here", right) from None
    if endpoint.protocol not in OVER_TCP:
        return 0.0
    try:
        return min(_trip(places[0]) for _ in range(PROBES))
    except OSError as error:
        return Silence((error.strerror or "no answer").lower())


def _trip(place: tuple[int, int, int, str, tuple[str, int] | tuple[str, int, int, int] | tuple[int, bytes]]) -> float:
    family, kind, protocol, _, address = place
    with socket.socket(family, kind, protocol) as probe_:
        probe_.settimeout(PROBE_S)
        began = time.monotonic()
        probe_.connect(address)
        return time.monotonic() - began


def open_timeout_ms(trip_s: float) -> int:
    """How long opening a link may take over such a round trip.

    Short where the way is short: a link that was cut is dialled again as soon as the dialling under way is given up.

    Args:
        trip_s: there and back [s].
    """
    return round(min(OPEN_MOST_MS, OPEN_LEAST_MS + 1e3 * OPEN_TRIPS * trip_s))
