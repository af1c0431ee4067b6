"""Runs a service: absolute ticks, late ones counted, a heartbeat twice a second, a clean stop."""

from __future__ import annotations

import contextlib
import gc
import logging
import os
import platform
import resource
import signal
import sys
import threading
import time
from collections import deque
from collections.abc import Callable, Iterator
from types import FrameType
from typing import Protocol, runtime_checkable

from protocol.messages import Figure, Heartbeat
from protocol.topics import HEARTBEAT
from services.bus.bus import Bus
from services.process.clock import Clock, utc_ms
from services.process.ending import ENDING, end_within
from services.process.exit_codes import Exit
from services.process.release import release

log = logging.getLogger(__name__)

SWITCH_INTERVAL_S = 5e-4
"""Python's threads hand over within this time; the default of 5 ms delays reception under load by seconds."""


class Service(Protocol):
    """A thin shell around a pure step."""

    @property
    def rate_hz(self) -> float:
        """At which `step` is called."""
        ...

    def step(self, now_ns: int) -> None:
        """Read the latest inputs, call pure code, publish. Must not wait."""
        ...

    def figures(self) -> tuple[Figure, ...]:
        """What the service measured since the last call, for the heartbeat."""
        ...

    def close(self) -> None:
        """Give back what is not the bus'."""
        ...


@runtime_checkable
class Paced(Protocol):
    """A service that moves its ticks to where its input comes."""

    def take_slew_ns(self) -> int:
        """By how much the next tick is to begin later, or earlier where negative."""
        ...


@runtime_checkable
class Prompt(Protocol):
    """A service that may be stepped between its ticks, where what came should not wait for the next one."""

    @property
    def call(self) -> threading.Event:
        """Set where something came, on whichever thread it came."""
        ...

    def step_early(self, now_ns: int) -> None:
        """As `step`, or nothing where what came can wait."""
        ...


class TickStatistics:
    """How regular the ticks are.

    Args:
        rate_hz: at which they should come.
    """

    def __init__(self, rate_hz: float) -> None:
        self.period_ns = round(1e9 / rate_hz)
        self.ticks = 0
        self.late = 0
        self._periods: deque[int] = deque(maxlen=4096)
        self._steps: deque[int] = deque(maxlen=4096)
        self._previous_ns: int | None = None

    def tick(self, due_ns: int, started_ns: int, ended_ns: int) -> None:
        """Count one tick: when it was due, began and ended."""
        self.ticks += 1
        self.late += started_ns - due_ns > self.period_ns // 2
        if self._previous_ns is not None:
            self._periods.append(started_ns - self._previous_ns)
        self._previous_ns = started_ns
        self._steps.append(ended_ns - started_ns)

    def take_quantiles(self) -> tuple[float, float, float]:
        """Period p50 and p99 and step p99 since the last call [s]."""
        result = (_quantile(self._periods, 0.5), _quantile(self._periods, 0.99), _quantile(self._steps, 0.99))
        self._periods.clear()
        self._steps.clear()
        return result


def _quantile(samples_ns: deque[int], q: float) -> float:
    if not samples_ns:
        return 0.0
    ordered = sorted(samples_ns)
    return ordered[min(len(ordered) - 1, int(q * len(ordered)))] / 1e9


def leave_on_signals() -> None:
    """Let SIGTERM, SIGINT and SIGHUP end the program where it stands: nothing runs yet that has to be stopped."""

    def leave(number: int, frame: FrameType | None) -> None:
        del number, frame
        raise SystemExit(0)

    _on_signals(leave)


def stop_on_signals() -> threading.Event:
    """An event that SIGTERM and SIGINT set, and SIGHUP: the terminal is gone (unless started to outlive it)."""
    stop = threading.Event()

    def set_stop(number: int, frame: FrameType | None) -> None:
        del number, frame
        stop.set()

    _on_signals(set_stop)
    return stop


@contextlib.contextmanager
def interruptible() -> Iterator[None]:
    """Within it SIGTERM and SIGHUP interrupt as Ctrl-C does, and what hangs after that is ended by force.

    Once it is interrupted nothing interrupts what is tidied up, and that stays so: the process is about to end.

    Raises:
        KeyboardInterrupt: wherever the main thread is when the signal comes.
    """

    def interrupt(number: int, frame: FrameType | None) -> None:
        del number, frame
        _on_signals(lambda number, frame: None)
        raise KeyboardInterrupt

    before = {number: signal.getsignal(number) for number in ENDING}
    _on_signals(interrupt)
    patience = end_within(forced=Exit.INTERRUPTED)
    interrupted = False
    try:
        yield
    except KeyboardInterrupt:
        interrupted = True
        raise
    finally:
        if not interrupted:
            patience.dismiss()
            for number, handler in before.items():
                signal.signal(number, handler)


def _on_signals(handler: Callable[[int, FrameType | None], None]) -> None:
    signal.signal(signal.SIGTERM, handler)
    signal.signal(signal.SIGINT, handler)
    if signal.getsignal(signal.SIGHUP) is not signal.SIG_IGN:  # else it was started to outlive the terminal
        signal.signal(signal.SIGHUP, handler)


def run(service: Service, bus: Bus, clock: Clock, process: str, stop: threading.Event) -> None:
    """Step the service until `stop` is set, then close it.

    A tick that could not begin within its period is skipped, not made up for: the phase stays, no burst follows.

    Args:
        service: what to run.
        bus: where the heartbeat goes.
        clock: what the ticks are counted on.
        process: the name in the heartbeat.
        stop: ends the run.
    """
    sys.setswitchinterval(SWITCH_INTERVAL_S)
    # What was made at the start stays: looking through all of it again for garbage would take several control periods.
    gc.collect()
    gc.freeze()
    ticks, software = TickStatistics(service.rate_hz), release()
    paced = service if isinstance(service, Paced) else None
    prompt = service if isinstance(service, Prompt) else None
    due = clock.now_ns()
    heartbeat_due = due
    try:
        while not stop.is_set():
            if prompt is not None:
                prompt.call.clear()  # the step sees what called
            started = clock.now_ns()
            service.step(started)
            ended = clock.now_ns()
            ticks.tick(due, started, ended)
            if ended >= heartbeat_due:
                bus.publish(HEARTBEAT, _heartbeat(service, bus, process, ticks, software))
                for fault in bus.faults():
                    log.warning("dropped: %s", fault)
                heartbeat_due = ended + round(1e9 / HEARTBEAT.rate_hz)
            due += ticks.period_ns + (paced.take_slew_ns() if paced is not None else 0)
            behind = clock.now_ns() - due
            if behind > ticks.period_ns:
                due += behind // ticks.period_ns * ticks.period_ns
            while prompt is not None and not stop.is_set() and clock.wait_until(due, prompt.call):
                prompt.call.clear()
                prompt.step_early(clock.now_ns())
            clock.sleep_until(due, stop)
    finally:
        gc.unfreeze()
        service.close()


def _heartbeat(service: Service, bus: Bus, process: str, ticks: TickStatistics, software: str) -> Heartbeat:
    period_p50, period_p99, step_p99 = ticks.take_quantiles()
    return Heartbeat(
        process=process,
        pid=os.getpid(),
        host=platform.node()[:64],
        rate_hz=service.rate_hz,
        ticks=ticks.ticks,
        late_ticks=ticks.late,
        period_p50=period_p50,
        period_p99=period_p99,
        step_p99=step_p99,
        cpu_s=time.process_time(),
        memory=resource.getrusage(resource.RUSAGE_SELF).ru_maxrss * 1024,
        topics=bus.figures(),
        figures=service.figures(),
        utc_ms=utc_ms(),
        software=software,
    )
