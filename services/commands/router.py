"""The router process: a Zenoh session in router mode, where the processes of a site meet."""

from __future__ import annotations

import logging
from argparse import ArgumentParser, Namespace

from services.bus.zenoh import open_router
from services.certificates.credentials import credentials
from services.certificates.expiry import Expiry
from services.commands.arguments import add_network
from services.commands.settings import configuration as configured
from services.process.config import Configuration
from services.process.ending import end_within
from services.process.runner import stop_on_signals

log = logging.getLogger(__name__)

ROUTER = "router"


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    add_network(parser)
    parser.add_argument("--listen", metavar="ENDPOINT", help="default: tcp/127.0.0.1:7447; for others tls/0.0.0.0:7447")


def run(arguments: Namespace) -> int:
    """See `Action`."""
    run_router(configured(arguments), arguments.connect)
    return 0


def run_router(configuration: Configuration, upstream: str | None = None) -> None:
    """Route until told to stop.

    Args:
        configuration: says where to listen.
        upstream: endpoint of another router to join, where there is one.

    Raises:
        BusError: nothing can listen there.
        CertificateError: it has no certificate for that.
    """
    stop = stop_on_signals()
    end_within()
    shown = credentials(configuration, configuration.listen, ROUTER)
    if upstream is not None:
        shown = credentials(configuration, upstream, ROUTER) or shown
    router = open_router(configuration.listen, upstream, shown)
    if shown is not None:
        Expiry(shown).start()
    try:
        log.info("listening on %s", configuration.listen)
        stop.wait()
    finally:
        router.close()
