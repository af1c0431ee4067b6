"""One process from its command to its end: bus, service, runner, clean stop."""

from __future__ import annotations

import contextlib
import importlib
import logging
import os
from collections.abc import Callable
from typing import cast

from services.bus.bus import Bus
from services.bus.zenoh import connect
from services.certificates.credentials import credentials
from services.certificates.expiry import Expiry
from services.process.clock import Clock, SystemClock
from services.process.config import Configuration
from services.process.ending import WITHIN_S, end_within
from services.process.exceptions import RoomMissing
from services.process.processes import Process
from services.process.runner import Service, leave_on_signals, run, stop_on_signals

Builder = Callable[[Bus, Clock, Configuration], Service]

log = logging.getLogger(__name__)


def run_process(process: Process, configuration: Configuration) -> None:
    """Run one process until it is told to stop.

    Args:
        process: which one.
        configuration: of the whole system; the process takes its part.

    Raises:
        ServiceError: it cannot start; the message is for the person who started it.
    """
    with contextlib.suppress(PermissionError):  # not everybody may go before others
        os.nice(process.nice)
    leave_on_signals()
    # A long import lets no handler run, and nothing is begun yet that would have to be finished.
    patience = end_within(0.0)
    # Loaded before the network is joined: most of a start is this, and the router starts meanwhile.
    build = _builder(process)
    clock = SystemClock()
    name = process.named(configuration.operator)
    shown = credentials(configuration, configuration.connect, process.name)
    bus = connect(configuration.connect, configuration.name, name, clock, credentials=shown)
    if shown is not None:
        Expiry(shown).start()
    try:
        service = build(bus, clock, configuration)
        stop = stop_on_signals()
        patience.seconds = WITHIN_S
        log.info("started on %s", configuration.connect)
        run(service, bus, clock, name, stop)
    finally:
        bus.close()


def _builder(process: Process) -> Builder:
    try:
        return cast(Builder, importlib.import_module(process.module).build)
    except ModuleNotFoundError as error:
        raise RoomMissing(process.name, error.name or "?") from None
