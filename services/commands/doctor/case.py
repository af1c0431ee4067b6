"""What is examined, and what the checks have learnt of it so far."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Iterator
from dataclasses import dataclass, field

from protocol.messages import Probe
from protocol.topic import Topic
from services.bus.subscription import Subscription
from services.bus.zenoh import Session, ZenohBus, open_session
from services.certificates.credentials import Credentials
from services.commands.doctor.hearing import Hearing
from services.process.clock import Clock
from services.process.config import Configuration
from services.process.endpoint import Endpoint, parse
from services.process.load import Loads, load_now

TRIPS = 20
"""Round trips that whatever is waited for may take besides."""

OPEN_S = 3.0
"""A router on a busy machine answers late."""

BACK_S = 1.0

AGAIN_S = 0.02


@dataclass
class Case:
    """One examination.

    Attributes:
        configuration: of this machine's side; its `connect` is the endpoint that is examined.
        clock: of this machine.
        stop: ends it before its time.
        trip_s: to whoever listens and back [s]; 0 where that cannot be measured, None where nobody was reached.
        shown: the certificate of this machine that is shown; None where none is.
        speaker: a process of the doctor's own, which sends.
        hearer: another one, which hears it.
        heard: what the hearer hears of the speaker.
        hearing: what was heard of everybody.
        open: whatever has to be closed again.
        load: says the load of this computer.
    """

    configuration: Configuration
    clock: Clock
    stop: threading.Event
    trip_s: float | None = None
    shown: Credentials | None = None
    speaker: ZenohBus | None = None
    hearer: ZenohBus | None = None
    heard: Subscription[Probe] | None = None
    hearing: Hearing = field(default_factory=Hearing)
    open: contextlib.ExitStack = field(default_factory=contextlib.ExitStack)
    load: Loads = load_now

    @property
    def endpoint(self) -> Endpoint:
        """Of the router."""
        return parse(self.configuration.connect)

    @contextlib.contextmanager
    def joined(self) -> Iterator[Session]:
        """A session with the router; raises as `open_session`."""
        within_s = OPEN_S + TRIPS * (self.trip_s or 0.0)
        session = open_session(self.endpoint.text, within_s, self.stop, lambda line: None, self.shown)
        try:
            yield session
        finally:
            session.close()

    def comes_back(self, topic: Topic[Probe], heard: Subscription[Probe]) -> bool:
        """Whether anything comes back that the speaker says; tried until it does, or long enough."""
        assert self.speaker is not None
        ends_ns = self.clock.now_ns() + round(1e9 * (BACK_S + TRIPS * (self.trip_s or 0.0)))
        while not any(one.message.publisher == self.speaker.identity for one in heard.take()):
            if self.clock.now_ns() > ends_ns:
                return False
            self.speaker.publish(topic, Probe())
            self.wait(AGAIN_S)
        return True

    def wait(self, seconds: float) -> None:
        """Wait.

        Raises:
            KeyboardInterrupt: somebody ended the command.
        """
        if self.stop.wait(seconds):
            raise KeyboardInterrupt
