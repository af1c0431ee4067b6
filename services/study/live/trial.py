"""One part of a session on the live robot, on a thread of its own: it tells the conductor each attempt, and the end."""

from __future__ import annotations

import contextlib
import threading
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import msgspec

from protocol.topics import MODEL_STATE, RECORDING, TEACHING_STATE
from services.bus.bus import Bus
from services.bus.zenoh import connect
from services.process.clock import Clock
from services.process.exceptions import BusError, CannotWrite, ServiceError
from services.study.events import Attempted, BrokenOff
from services.study.live.forgetting import Forgetting
from services.study.live.stack import Stack
from services.study.page.desk import Desk
from services.study.page.trials import Live
from services.study.session.course import Adapt, Train
from services.study.session.rules import adapted, trained
from services.study.session.watch import Watch

PERIOD_S = 0.02
"""Between two looks."""

DIAL_S = 1.0
"""After which it is looked whether the router is waited for at all."""

WHY_LENGTH = 1000
"""Of what is kept of why something broke off [characters]."""

NAME = "study"
"""On the robot's network."""


@dataclass(frozen=True)
class Begun:
    """A part that begins, or goes on.

    Attributes:
        number: of the participant.
        part: of their session.
        known: its attempts so far.
        demonstrations: that its model starts from.
        folder: of the study, absolute.
    """

    number: int
    part: Train | Adapt
    known: tuple[Attempted, ...]
    demonstrations: int
    folder: Path


class Trial:
    """See the module. All but `run` is called by whoever holds the desk's lock.

    Attributes:
        over: nothing is told any more.
        live: as the pages show it.

    Args:
        desk: where it is told.
        clock: of this process.
        begun: what begins.
        stack: its processes.
        before: thread of the trial before, whose processes may still be ending; None for none.
    """

    def __init__(self, desk: Desk, clock: Clock, begun: Begun, stack: Stack, before: threading.Thread | None) -> None:
        self.over = False
        self.live = self._live(begun, begun.known)
        self.thread = threading.Thread(target=self.run, name=f"trial {begun.part.name}", daemon=True)
        self._desk = desk
        self._clock = clock
        self._begun = begun
        self._stack = stack
        self._before = before
        self._attempts = list(begun.known)
        self._untold: list[Attempted] = []
        self._stop = threading.Event()
        self._watch: Watch | None = None

    def run(self) -> None:
        """From the start of its processes to their end."""
        if self._before is not None:
            self._before.join()
        try:
            self._start()
            bus = self._joined()
            if bus is not None:
                try:
                    self._attend(bus)
                finally:
                    bus.close()
        except ServiceError as error:
            self._broken(str(error))
        finally:
            self._stack.stop()
            with self._desk.lock:
                self.over = True

    def stop(self, why: str) -> None:
        """Tell what came to no end, and nothing more; the processes have ended when this returns.

        Args:
            why: it is stopped.
        """
        if not self.over and self._watch is not None and self._watch.unfinished["acting"]:
            self._broke_off(why)
        self.over = True
        self._stop.set()
        self._stack.stop()

    def _start(self) -> None:
        with self._desk.lock:
            if not self.over:
                self._stack.start()

    def _joined(self) -> Bus | None:
        """This process' way to the robot; None where it has ended before."""
        endpoint = self._stack.configuration.connect
        while self._runs():
            try:
                return connect(endpoint, self._stack.configuration.name, NAME, self._clock, timeout_s=DIAL_S)
            except BusError:
                self._wait()
        return None

    def _attend(self, bus: Bus) -> None:
        """Wait until the robot is ready, then watch."""
        model, station = bus.subscribe(MODEL_STATE), bus.subscribe(TEACHING_STATE)
        while station.latest() is None or (
            (known := model.latest()) is None or known.message.demonstrations < self._begun.demonstrations
        ):
            if not self._runs():
                return
            self._wait()
        begun = self._begun
        self._watch = watch = Watch(
            bus,
            begun.number,
            begun.part.name,
            self._desk.conductor.protocol.method(begun.part.method).teaching,
            known=len(begun.known),
            lasted=begun.known[-1].ended if begun.known else 0.0,
        )
        forgetting = Forgetting(bus, NAME) if isinstance(begun.part, Train) else None
        recording = bus.subscribe(RECORDING)
        while self._runs():
            if forgetting is not None:
                forgetting.step()
            received = recording.latest()
            with self._desk.lock:
                if self.over:
                    return
                self._step(watch, received.message.path if received is not None else "")
            self._wait()

    def _step(self, watch: Watch, recording: str) -> None:
        """Look, tell what has ended, and whether it is over."""
        ended = watch.step(self._clock.now_ns())
        place = self._in_study(recording)
        self._untold += [msgspec.structs.replace(attempt, recording=place) for attempt in ended]
        fault = self._tell()
        self.live = self._live(self._begun, self._attempts, fault, watch)
        finished = watch.told is not None and watch.told.finished
        passed = self._passed(watch.lasted, finished=finished)
        if passed is None or self._untold:
            return
        seconds = round(sum(attempt.active for attempt in self._attempts), 3)
        try:
            self._desk.conductor.end(self._begun.number, self._begun.part, passed=passed, seconds=seconds)
        except CannotWrite as error:
            self.live = self._live(self._begun, self._attempts, str(error), watch)
            return
        self.over = True
        self._desk.settle(self._begun.number)

    def _tell(self) -> str:
        """Tell the conductor each attempt, in their order; why one could not be told, and is told again."""
        while self._untold:
            try:
                self._desk.conductor.attempted(self._untold[0])
            except CannotWrite as error:
                return str(error)
            self._attempts.append(self._untold.pop(0))
        return ""

    def _passed(self, lasted: float, *, finished: bool) -> bool | None:
        """Whether the part is passed; None while it goes on."""
        protocol = self._desk.conductor.protocol
        if isinstance(self._begun.part, Train):
            return trained(self._attempts, protocol.training, lasted)
        passed = adapted(self._attempts, protocol.task)
        return False if passed is None and finished else passed

    def _runs(self) -> bool:
        """Whether it goes on; where its processes have ended by themselves, that is written down."""
        why = None if self.over else self._stack.why_ended
        if why is not None:
            self._broken(why)
        return not self.over

    def _broken(self, why: str) -> None:
        with self._desk.lock:
            if self.over:
                return
            self.over = True
            self._broke_off(why)

    def _broke_off(self, why: str) -> None:
        begun, raw = self._begun, self._watch.unfinished if self._watch is not None else {}
        event = BrokenOff(participant=begun.number, part=begun.part.name, why=why[:WHY_LENGTH], raw=raw)
        # A disk that is full says so at the next thing that somebody does; the robot is stopped all the same.
        with contextlib.suppress(CannotWrite):
            self._desk.conductor.broke_off(event)

    def _wait(self) -> None:
        self._stop.wait(PERIOD_S)

    def _in_study(self, recording: str) -> str:
        """A recording's place in the study's folder; empty where it is not there."""
        path = Path(recording)
        return str(path.relative_to(self._begun.folder)) if path.is_relative_to(self._begun.folder) else ""

    @staticmethod
    def _live(begun: Begun, attempts: Sequence[Attempted], fault: str = "", watch: Watch | None = None) -> Live:
        known = sum(attempt.active for attempt in begun.known)
        before = begun.known[-1].ended if begun.known else 0.0
        return Live(
            number=begun.number,
            part=begun.part.name,
            acting=watch is not None and watch.acting,
            active=round(known + (watch.active if watch is not None else 0.0), 1),
            attempts=len(attempts),
            updates=watch.updates if watch is not None else 0,
            lasted=int(watch.lasted if watch is not None else before),
            fault=fault,
            ready=watch is not None,
        )
