"""One process from its command to its end: bus, service, runner, clean stop."""

from __future__ import annotations

import importlib
import logging
import os
from typing import cast

from services.bus.bus import Bus
from services.bus.zenoh import connect
from services.process.clock import Clock, SystemClock
from services.process.config import Configuration
from services.process.ending import end_within
from services.process.exceptions import RoomMissing
from services.process.processes import Process
from services.process.runner import Service, run, stop_on_signals

log = logging.getLogger(__name__)


def run_process(process: Process, configuration: Configuration) -> None:
    """Run one process until it is told to stop.

    Args:
        process: which one.
        configuration: of the whole system; the process takes its part.

    Raises:
        ServiceError: it cannot start; the message is for the person who started it.
    """
    os.nice(process.nice)
    stop = stop_on_signals()
    end_within()
    clock = SystemClock()
    bus = connect(configuration.connect, configuration.name, process.name, clock, stop=stop)
    try:
        service = _build(process, bus, clock, configuration)
        log.info("started on %s", configuration.connect)
        run(service, bus, clock, process.name, stop)
    finally:
        bus.close()


def _build(process: Process, bus: Bus, clock: Clock, configuration: Configuration) -> Service:
    try:
        module = importlib.import_module(process.module)
    except ModuleNotFoundError as error:
        raise RoomMissing(process.name, error.name or "?") from None
    return cast(Service, module.build(bus, clock, configuration))
