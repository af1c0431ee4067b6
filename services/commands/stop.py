"""`retouch stop`: the emergency stop from the command line."""

from __future__ import annotations

import logging
import os
import time
from argparse import ArgumentParser, Namespace

from protocol import queries, topics
from protocol.messages import EmergencyStop, SafetyState
from services.bus.zenoh import ZenohBus, open_session
from services.commands.arguments import add_network
from services.commands.settings import configuration as configured
from services.process.clock import SystemClock
from services.process.config import Configuration
from services.process.exceptions import CommandFailed

log = logging.getLogger(__name__)

ANSWER_S = 3.0
REPEAT_S = 1.0 / topics.EMERGENCY_STOP.rate_hz


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    add_network(parser)
    parser.add_argument("--release", action="store_true", help="release the stop instead")


def run(arguments: Namespace) -> int:
    """See `Action`."""
    (release if arguments.release else stop)(configured(arguments))
    return 0


def _bus(configuration: Configuration) -> ZenohBus:
    session = open_session(configuration.connect, timeout_s=5.0)
    return ZenohBus(session, configuration.name, f"cli-{os.getpid()}", SystemClock())


def stop(configuration: Configuration) -> None:
    """Press until the robot says that it has latched.

    Raises:
        BusError: there is no such network.
        CommandFailed: the robot did not say so.
    """
    bus = _bus(configuration)
    try:
        safety = bus.subscribe(topics.SAFETY_STATE)
        pressed = EmergencyStop(pressed=True, by="command line", reason="retouch stop")
        deadline = time.monotonic() + ANSWER_S
        while time.monotonic() < deadline:
            bus.publish(topics.EMERGENCY_STOP, pressed)
            time.sleep(REPEAT_S)
            state: SafetyState | None = received.message if (received := safety.latest()) else None
            if state is not None and state.emergency_stop:
                log.info("robot %s has stopped", configuration.name)
                return
        raise CommandFailed(
            f"robot {configuration.name!r} did not confirm the stop in {ANSWER_S:g} s: use its own emergency stop"
        )
    finally:
        bus.close()


def release(configuration: Configuration) -> None:
    """Release the latched stop; whoever wants to move the robot has to ask for the authority again.

    Raises:
        BusError: there is no such network.
        CommandFailed: nobody answered, or the robot refused.
    """
    bus = _bus(configuration)
    try:
        pending = bus.ask(queries.RELEASE_STOP, queries.ReleaseStop("command line"), timeout_s=ANSWER_S)
        deadline = time.monotonic() + ANSWER_S + 1.0
        while (outcome := pending.poll()) is None and time.monotonic() < deadline:
            time.sleep(0.01)
        if not isinstance(outcome, queries.Accepted):
            raise CommandFailed(f"the stop was not released: {outcome.reason if outcome else 'no answer'}")
        log.info("robot %s is released", configuration.name)
    finally:
        bus.close()
