"""The model process, as a command asks it."""

from __future__ import annotations

import threading
from collections.abc import Iterator
from contextlib import contextmanager

from protocol import queries
from protocol.messages import ModelState
from protocol.queries import Query
from services.bus.bus import Bus, Failed, Rep, Req
from services.bus.zenoh import connect
from services.certificates.credentials import credentials
from services.process.clock import Clock, SystemClock
from services.process.config import Configuration
from services.process.exceptions import CommandFailed, NoAnswer
from services.process.runner import stop_on_signals

ANSWER_S = 10.0
POLL_NS = 10_000_000
AGAIN_NS = 200_000_000


class ModelProcess:
    """The model process, asked until it answers.

    Args:
        bus: to it.
        robot: whose it is.
        clock: that patience ends by.
        stop: ends the asking.
    """

    def __init__(self, bus: Bus, robot: str, clock: Clock, stop: threading.Event) -> None:
        self._bus = bus
        self._robot = robot
        self._clock = clock
        self._stop = stop

    def state(self, within_s: float = ANSWER_S) -> ModelState:
        """What the model holds; raises as `ask`."""
        return self.ask(queries.DESCRIBE, queries.Describe(), "describe itself", within_s).state

    def ask(self, query: Query[Req, Rep], request: Req, what: str, within_s: float = ANSWER_S) -> Rep:
        """The answer. Where there is none the same request is sent again: by its number it is known, and done once.

        Args:
            query: to ask.
            request: the question.
            what: the model is to do, as an error names it.
            within_s: patience [s].

        Raises:
            CommandFailed: it refuses.
            NoAnswer: it did not answer in time.
            KeyboardInterrupt: somebody ended the command.
        """
        deadline_ns = self._clock.now_ns() + round(within_s * 1e9)
        reason = "nothing came back"
        while self._clock.now_ns() < deadline_ns:
            match self._asked(query, request):
                case queries.Refused(reason):
                    raise CommandFailed(f"the model does not {what}: {reason}")
                case Failed(reason):
                    self._wait(AGAIN_NS)
                case reply:
                    return reply
        raise NoAnswer(query.server, self._robot, within_s, reason)

    def _asked(self, query: Query[Req, Rep], request: Req) -> Rep | queries.Refused | Failed:
        pending = self._bus.ask(query, request, ANSWER_S)
        while (outcome := pending.poll()) is None:
            self._wait(POLL_NS)
        return outcome

    def _wait(self, ns: int) -> None:
        self._clock.sleep_until(self._clock.now_ns() + ns, self._stop)
        if self._stop.is_set():
            raise KeyboardInterrupt


@contextmanager
def model_process(configuration: Configuration, command: str) -> Iterator[ModelProcess]:
    """The running model of a robot.

    Args:
        configuration: whose.
        command: that asks, as the network knows it.

    Raises:
        ServiceError: there is no such network.
    """
    clock = SystemClock()
    shown = credentials(configuration, configuration.connect, command)
    name = shown.process(command) if shown is not None else command
    bus = connect(configuration.connect, configuration.name, name, clock, credentials=shown)
    try:
        yield ModelProcess(bus, configuration.name, clock, stop_on_signals())
    finally:
        bus.close()
