"""`retouch echo`: whatever passes on a key expression, decoded without any schema."""

from __future__ import annotations

import logging
import queue
import sys
import time
from argparse import ArgumentParser, Namespace
from typing import Any

import msgpack

from services.bus.zenoh import Passing, open_session, watch
from services.certificates.credentials import credentials
from services.commands.arguments import add_network, whole
from services.commands.settings import configuration
from services.process.config import Configuration
from services.process.ending import end_within
from services.process.runner import stop_on_signals

log = logging.getLogger(__name__)

POLL_S = 0.2

KEPT = 10_000
"""Messages that wait to be printed at most."""

LONG = 64
"""Bytes and lists longer than this are shown by their length."""


def add_arguments(parser: ArgumentParser) -> None:
    """See `Action`."""
    add_network(parser)
    parser.add_argument("key", metavar="KEY", help="such as 'retouch/@v1/robot1/state/**'")
    parser.add_argument("--count", type=whole(1), metavar="N", help="end after N messages")


def run(arguments: Namespace) -> int:
    """See `Action`."""
    echo(configuration(arguments), arguments.key, arguments.count)
    return 0


def decoded(payload: bytes) -> Any:
    """The payload by the plain msgpack package; what is no msgpack is shown as its bytes."""
    try:
        return msgpack.unpackb(payload, strict_map_key=False)
    except (ValueError, msgpack.UnpackException, RecursionError):
        return payload


def shown(value: Any) -> str:
    """A decoded value in one line."""
    match value:
        case bytes() if len(value) > LONG:
            return f"<{len(value)} bytes>"
        case dict():
            return "{" + ", ".join(f"{k}: {shown(v)}" for k, v in value.items()) + "}"
        case list() if len(value) > LONG:
            return f"<{len(value)} items>"
        case list():
            return "[" + ", ".join(shown(v) for v in value) + "]"
        case float():
            return f"{value:.6g}"
        case _:
            return repr(value)


class Heard:
    """What passes, until it is printed: whoever reads slowly misses some of it, and the network waits for nobody.

    Args:
        kept: how many messages wait at most.
    """

    def __init__(self, kept: int = KEPT) -> None:
        self._waiting: queue.Queue[Passing] = queue.Queue(maxsize=kept)
        self._missed = 0

    def keep(self, message: Passing) -> None:
        """Keep it to be printed, where there is room; called on the network's threads."""
        try:
            self._waiting.put_nowait(message)
        except queue.Full:
            self._missed += 1

    def take(self, timeout_s: float) -> Passing | None:
        """The oldest; None where none came in time."""
        try:
            return self._waiting.get(timeout=timeout_s)
        except queue.Empty:
            return None

    def take_missed(self) -> int:
        """How many there was no room for since the last call."""
        missed, self._missed = self._missed, 0
        return missed


def echo(configuration: Configuration, key: str, count: int | None) -> None:
    """Print until interrupted, or `count` messages.

    Raises:
        BusError: there is no such network, or the key is no key expression.
    """
    stop = stop_on_signals()
    end_within()
    heard = Heard()
    certificate = credentials(configuration, configuration.connect)
    session = open_session(configuration.connect, 5.0, stop, credentials=certificate)
    try:
        watch(session, key, heard.keep)
        shown_count = 0
        while not stop.is_set() and shown_count != count:
            if missed := heard.take_missed():
                log.warning("%d messages are not shown: they came faster than they were read", missed)
            message = heard.take(POLL_S)
            if message is None:
                continue
            stamp = time.strftime("%H:%M:%S")
            sys.stdout.write(f"{stamp} {message.key} [{message.schema or '?'}] {shown(decoded(message.payload))}\n")
            sys.stdout.flush()
            shown_count += 1
    finally:
        session.close()
