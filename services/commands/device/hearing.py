"""The devices that can be heard from here: those that a browser reads for a station, and those at this computer."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from protocol.codec import decode
from protocol.exceptions import ProtocolError
from protocol.messages import Controller, OperatorInput
from protocol.topic import VERSION
from protocol.topics import OPERATOR_INPUT
from services.bus.zenoh import Passing, open_session, watch
from services.certificates.credentials import credentials
from services.master.devices.profiles import Profiles
from services.master.devices.spacemouse import SpaceMouse, vendor
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.exceptions import BusError, RoomMissing

OPEN_WITHIN_S = 1.0

GONE_NS = 500_000_000
"""Silence after which a station's devices are there no more."""


class Hearing:
    """The newest that was heard.

    Args:
        clock: by which it ages.
        operator: whose station's.

    Attributes:
        missing: why there is nothing to be heard of somewhere, a line each.
    """

    def __init__(self, clock: Clock, operator: str) -> None:
        self.missing: list[str] = []
        self._clock = clock
        self._operator = operator
        self._lock = threading.Lock()
        self._page: tuple[OperatorInput, int] | None = None
        self._mouse: SpaceMouse | None = None

    def hear(self, passing: Passing) -> None:
        """Keep what a station of this operator says; what is nothing of that kind is passed over."""
        try:
            said = decode(OPERATOR_INPUT, passing.payload, passing.schema)
        except ProtocolError:
            return
        if said.operator == self._operator:
            with self._lock:
                self._page = said, self._clock.now_ns()

    def read_here(self, mouse: SpaceMouse) -> None:
        """Read a 3-D mouse at this computer, too."""
        self._mouse = mouse

    @property
    def page(self) -> OperatorInput | None:
        """What the page says; None where no station of the operator is heard."""
        with self._lock:
            heard = self._page
        return heard[0] if heard is not None and self._clock.now_ns() - heard[1] <= GONE_NS else None

    def controllers(self) -> tuple[tuple[str, Controller], ...]:
        """Where each device is, and what it says."""
        page = self.page
        there = [("the page", one) for one in page.controllers] if page is not None else []
        here = self._mouse.controller if self._mouse is not None else None
        return (*there, *([("this computer", here)] if here is not None else []))


@contextmanager
def hearing(configuration: Configuration, clock: Clock, stop: threading.Event) -> Iterator[Hearing]:
    """Hear everything that can be heard, for as long as the context lasts."""
    heard = Hearing(clock, configuration.operator)
    session = mouse = None
    try:
        shown = credentials(configuration, configuration.connect)
        session = open_session(configuration.connect, OPEN_WITHIN_S, stop, credentials=shown)
        watch(session, f"retouch/{VERSION}/{configuration.name}/{OPERATOR_INPUT.name}/*", heard.hear)
    except BusError:
        heard.missing.append(
            f"no station at {configuration.connect}: what a browser reads is heard while `retouch up` runs"
        )
    try:
        mouse = SpaceMouse(vendor(), Profiles())
        mouse.start()
        heard.read_here(mouse)
    except RoomMissing as missing:
        heard.missing.append(f"3-D mice at this computer are not looked for: {missing}")
    try:
        yield heard
    finally:
        if mouse is not None:
            mouse.close()
        if session is not None:
            session.close()
