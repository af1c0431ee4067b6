"""The router process: a Zenoh session in router mode, where the processes of a site meet."""

from __future__ import annotations

import json
import logging
import sys
from argparse import ArgumentParser, Namespace

from services.bus.zenoh import open_router, router_settings
from services.certificates.credentials import Credentials, credentials
from services.certificates.expiry import Expiry
from services.commands.arguments import add_network
from services.commands.settings import configuration as configured
from services.process.config import Configuration
from services.process.ending import end_within
from services.process.runner import stop_on_signals

log = logging.getLogger(__name__)

ROUTER = "router"

_ABOUT = """\
Where the processes of a site meet, and the one to which desks connect. With --connect
it joins another router. The official zenohd can take its place:

  retouch router --robot kitchen --listen tls/0.0.0.0:7447 --print > zenohd.json5
  zenohd --config zenohd.json5

It has to be started again where certificates were renewed, issued or revoked.
"""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    add_network(parser)
    parser.description = _ABOUT
    parser.add_argument("--listen", metavar="ENDPOINT", help="default: tcp/127.0.0.1:7447; for others tls/0.0.0.0:7447")
    parser.add_argument("--print", action="store_true", help="print its settings for the official zenohd, and end")


def run(arguments: Namespace) -> int:
    """See `Action`."""
    if arguments.print:
        print_settings(configured(arguments), arguments.connect)
    else:
        run_router(configured(arguments), arguments.connect)
    return 0


def print_settings(configuration: Configuration, upstream: str | None = None) -> None:
    """Tell how the official zenohd takes this router's place; raises as `run_router`."""
    made = router_settings(configuration.listen, upstream, _credentials(configuration, upstream))
    sys.stdout.write(f"{json.dumps(made, indent=2)}\n")


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
    shown = _credentials(configuration, upstream)
    router = open_router(configuration.listen, upstream, shown)
    if shown is not None:
        Expiry(shown).start()
    try:
        log.info("listening on %s", configuration.listen)
        stop.wait()
    finally:
        router.close()


def _credentials(configuration: Configuration, upstream: str | None) -> Credentials | None:
    shown = credentials(configuration, configuration.listen, ROUTER)
    return (credentials(configuration, upstream, ROUTER) or shown) if upstream is not None else shown
