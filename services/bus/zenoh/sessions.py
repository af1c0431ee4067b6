"""Sessions of Zenoh: a client's, which dials until its router is there, and a router's."""

from __future__ import annotations

import json
import re
import threading
from typing import Any

import zenoh

from services.process.exceptions import BusError, EndpointInUse, RouterUnreachable


def _configuration(mode: str, connect: str | None, listen: str | None) -> zenoh.Config:
    """No discovery: a network is what was named. Links that die are noticed and dialled again within a second."""
    config: dict[str, Any] = {
        "mode": mode,
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "listen": {"endpoints": [listen] if listen else []},
        "connect": {
            "endpoints": [connect] if connect else [],
            "timeout_ms": -1,
            "exit_on_failure": False,
            "retry": {"period_init_ms": 100, "period_max_ms": 500, "period_increase_factor": 1.5},
        },
        "transport": {"unicast": {"open_timeout": 1000}, "link": {"tx": {"lease": 2000}}},
    }
    return zenoh.Config.from_json5(json.dumps(config))


def open_router(listen: str, connect: str | None = None) -> zenoh.Session:
    """A Zenoh router: listens, and passes on what its clients and other routers send.

    Args:
        listen: the endpoint to listen on, such as "tcp/127.0.0.1:7447".
        connect: another router's endpoint, where there is one.

    Raises:
        EndpointInUse: nothing can listen there.
        BusError: the endpoints are no endpoints.
    """
    try:
        return zenoh.open(_configuration("router", connect, listen))
    except zenoh.ZError as error:
        if "listener bound to" in str(error):
            raise EndpointInUse(listen) from None
        raise BusError(f"cannot open a router on {listen}: {reason(error)}") from None


def open_session(connect: str, timeout_s: float) -> zenoh.Session:
    """A client's session; waits until the router is there.

    Raises:
        BusError: no router answered in time, or the endpoint is none.
    """
    opened: list[zenoh.Session | zenoh.ZError] = []

    def dial() -> None:
        try:
            opened.append(zenoh.open(_configuration("client", connect, None)))
        except zenoh.ZError as error:
            opened.append(error)

    thread = threading.Thread(target=dial, daemon=True)
    thread.start()
    thread.join(timeout_s)
    if not opened:
        raise RouterUnreachable(connect, timeout_s)
    if isinstance(opened[0], zenoh.ZError):
        raise BusError(f"cannot connect to {connect}: {reason(opened[0])}")
    return opened[0]


def close_session(session: zenoh.Session) -> None:
    """Leave the network; without it a process with a subscriber never ends."""
    session.close()  # type: ignore[no-untyped-call]  # Zenoh's stub leaves it bare


def reason(error: zenoh.ZError) -> str:
    """The error without the place in Zenoh's source."""
    return re.sub(r" at \S+\.rs:\d+\.?", "", str(error).splitlines()[0])
