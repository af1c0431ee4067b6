"""The router process: a Zenoh session in router mode, where the processes of a site meet."""

from __future__ import annotations

import logging

from services.bus.zenoh import close_session, open_router
from services.process.config import Configuration
from services.process.runner import stop_on_signals

log = logging.getLogger(__name__)


def run_router(configuration: Configuration, upstream: str | None = None) -> None:
    """Route until told to stop.

    Args:
        configuration: says where to listen.
        upstream: endpoint of another router to join, where there is one.

    Raises:
        BusError: nothing can listen there.
    """
    stop = stop_on_signals()
    session = open_router(configuration.listen, upstream)
    try:
        log.info("listening on %s", configuration.listen)
        stop.wait()
    finally:
        close_session(session)
