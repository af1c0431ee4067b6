"""Where the endpoint is: its host resolves, and somebody listens there."""

from __future__ import annotations

import errno
from collections.abc import Iterator

from services.bus.reach import Silence, knock, places
from services.commands.doctor.case import Case
from services.commands.doctor.finding import Finding, look, ok, wrong
from services.process.endpoint import OVER_TCP, Endpoint
from services.process.exceptions import BadEndpoint

NAME, PORT = "name", "port"

_NO_WAY = frozenset((errno.EHOSTUNREACH, errno.ENETUNREACH, errno.ENETDOWN, errno.EHOSTDOWN, errno.EADDRNOTAVAIL))


def check_name(case: Case) -> Iterator[Finding]:
    """The host's addresses."""
    host = case.endpoint.host
    try:
        found = places(case.endpoint)
    except BadEndpoint:
        yield wrong(NAME, f"nobody here knows the host {host!r}", "mistyped? Give its address instead")
        return
    if isinstance(found, Silence):
        yield wrong(NAME, f"{host}: {found.reason}", "is this machine on a network? Give the host's address instead")
    elif case.endpoint.is_address:
        yield ok(NAME, f"{host} is an address, and no name is looked up")
    else:
        yield ok(NAME, f"{host} is {', '.join(dict.fromkeys(str(place[4][0]) for place in found))}")


def check_port(case: Case) -> Iterator[Finding]:
    """Whether somebody listens, and how far away."""
    endpoint = case.endpoint
    if endpoint.protocol not in OVER_TCP:
        case.trip_s = 0.0
        yield ok(PORT, f"{endpoint.protocol} tells nobody whether somebody listens: the router is asked itself")
        return
    where = f"port {endpoint.port} of {endpoint.host}"
    trip = knock(endpoint)
    if isinstance(trip, Silence):
        yield _silent(where, trip, endpoint)
        return
    case.trip_s = trip
    far = f"somebody listens at {where}, {1e3 * trip:.1f} ms there and back"
    if trip > SLOW_S:
        yield look(PORT, far, "a hand feels that: is there a nearer way, or a VPN that leads round?")
    else:
        yield ok(PORT, far)


SLOW_S = 0.1
"""Round trips beyond this are felt when a robot is led by the pictures that it sends [s]."""


def _silent(where: str, silence: Silence, endpoint: Endpoint) -> Finding:
    if silence.code == errno.ECONNREFUSED:
        remedy = (
            f"start a router there, for others too ('retouch up --listen {endpoint.protocol}/0.0.0.0:{endpoint.port}')"
        )
        if endpoint.is_loopback:
            remedy = "start one ('retouch up', 'retouch router'); or is it another port?"
        return wrong(PORT, f"nobody listens at {where}: the machine refuses", remedy)
    if silence.code in _NO_WAY:
        return wrong(PORT, f"no way leads to {where}: {silence.reason}", "the same network? A VPN that is down?")
    remedy = f"is the machine on, at this address? Let its firewall pass port {endpoint.port}, TCP and UDP"
    return wrong(PORT, f"no answer from {where}: {silence.reason}", remedy)
