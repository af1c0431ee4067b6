"""Zenoh as all sessions have it: how one is configured and left, and what its errors say."""

from __future__ import annotations

import json
import logging
import re
import threading
from typing import Any

import zenoh

from services.bus.zenoh.access import access_control, quotas
from services.certificates.credentials import Credentials
from services.process.endpoint import parse

log = logging.getLogger(__name__)

LEASE_MS = 1000
"""A link on which nothing was heard for so long is given up; a shorter cut TCP bridges by itself."""

REDIAL_MS = 20
"""Between two attempts to open a link again."""

SECURE_REDIAL_MS = 200
"""The same, where certificates are shown: a listener that refused one takes nobody else for 0.1 s."""

FULL_LINK_US = 200_000
"""How long what may not be dropped (a declaration) waits for room on a full link; then the link is dialled anew."""

CLOSE_S = 0.5
"""How long a session may take to leave; where its router hangs with a full link it would take ten seconds."""

MOST_LINKS = 3
"""Between two routers."""

POLL_S = 0.02


def configuration(made: dict[str, Any]) -> zenoh.Config:
    """Settings, as a session takes them."""
    return zenoh.Config.from_json5(json.dumps(made))


def redial_ms(credentials: Credentials | None) -> int:
    """Between two attempts of Zenoh's to open a link again [ms].

    Args:
        credentials: that are shown; None where there are none.
    """
    return REDIAL_MS if credentials is None else SECURE_REDIAL_MS


def settings(
    mode: str,
    connect: str | None,
    listen: str | None,
    pace_ms: int,
    *,
    within_ms: int = -1,
    credentials: Credentials | None = None,
) -> dict[str, Any]:
    """No discovery: a network is what was named. Links that die are noticed and dialled again within a second.

    Args:
        mode: "client" or "router".
        connect: whom to dial.
        listen: where to listen.
        pace_ms: how long one attempt to open a link may take, now and after each cut [ms].
        within_ms: a session that has no link by then does not open [ms]; -1 to open it without.
        credentials: which both ends show; a router lets in whom its register names, and denies what is not granted.
    """
    again_ms = redial_ms(credentials)
    config: dict[str, Any] = {
        "mode": mode,
        "scouting": {"multicast": {"enabled": False}, "gossip": {"enabled": False}},
        "listen": {"endpoints": [end for end in (listen, parse(listen).datagrams) if end] if listen else []},
        "connect": {
            "endpoints": _lanes(mode, connect) if connect else [],
            "timeout_ms": within_ms,
            "exit_on_failure": within_ms >= 0,
            "retry": {"period_init_ms": again_ms, "period_max_ms": again_ms, "period_increase_factor": 1.0},
        },
        "transport": {
            "unicast": {"open_timeout": pace_ms, "max_links": MOST_LINKS if mode == "router" else 1},
            "link": {
                "tx": {
                    "lease": LEASE_MS,
                    "queue": {"congestion_control": {"block": {"wait_before_close": FULL_LINK_US}}},
                }
            },
        },
    }
    if credentials is not None:
        config["transport"]["link"]["tls"] = _mutual(credentials)
    if credentials is not None and listen and parse(listen).secure:
        subjects = [(one.common_name, one.subject) for one in credentials.register().admitted()]
        config |= {"access_control": access_control(subjects), **quotas(subjects)}
    return config


def _lanes(mode: str, connect: str) -> list[str]:
    """What to dial: between routers a link for each lane."""
    datagrams = parse(connect).datagrams
    if mode != "router" or not datagrams:
        return [connect]
    return [f"{connect}?rel=1;prio=1-4", f"{connect}?rel=1;prio=5-7", f"{datagrams}?rel=0;prio=1-4"]


def _mutual(credentials: Credentials) -> dict[str, Any]:
    """Read anew with every session that is opened: what was renewed on the disk is used from then on."""
    file = str(credentials.file)
    return {
        "root_ca_certificate": str(credentials.root),
        "enable_mtls": True,
        "verify_name_on_connect": True,
        "listen_private_key": file,
        "listen_certificate": file,
        "connect_private_key": file,
        "connect_certificate": file,
        # What runs goes on; whoever renews nothing is told in time, and cannot come back.
        "close_link_on_expiration": False,
    }


def leave(session: zenoh.Session) -> None:
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
