"""The force loop of a haptic device: eq. 14 at the device's own rate, whatever the network does."""

from __future__ import annotations

import os
import threading
from typing import NamedTuple, Protocol

from protocol.messages import Figure, Vector3
from services.master.devices.device import ZERO
from services.master.feedback import Feedback
from services.process.clock import Clock
from services.process.runner import TickStatistics
from sim.person.stylus import RATE_HZ, StylusState

_PERIOD_NS = round(1e9 / RATE_HZ)
_CAUGHT_UP = 100
"""Steps that are made up for after a late wake-up; a longer gap is skipped."""

_SHORTEST_NS, _LONGEST_NS = _PERIOD_NS // 10, 10 * _PERIOD_NS
"""What a frame may last: a thread that was late does not make up for it."""

_PRIORITY = 10
"""Above all that is not real-time, below what a real-time kernel does itself."""


class HapticDevice(Protocol):
    """A stylus that renders a force, simulated or real."""

    @property
    def state(self) -> StylusState:
        """Where it was seen last, relative to its neutral pose, in base axes."""
        ...

    def exchange(self, force: Vector3, dt: float) -> StylusState:
        """Render the force [N] for dt [s]; where the stylus is then."""
        ...


class Rendered(NamedTuple):
    """The newest state of the device and the feedback that it renders [N]."""

    stylus: StylusState
    feedback: Vector3


class HapticLoop:
    """Feel and move, one millisecond after the other.

    `step` is the loop's body; `advance_to` makes as many steps as the time asks for. One thread advances, any
    may read `newest` and say that the robot was heard.

    Args:
        device: the stylus.
        feedback: what it renders.
        start_ns: the time of the stylus' state [ns].
    """

    def __init__(self, device: HapticDevice, feedback: Feedback, start_ns: int) -> None:
        self._device = device
        self._feedback = feedback
        self._time_ns = self._heard_ns = start_ns
        self._dt = 1.0 / RATE_HZ
        self.newest = Rendered(device.state, ZERO)

    def hear(self, now_ns: int) -> None:
        """The robot was heard just now [ns]: without that for a moment there is no force."""
        self._heard_ns = now_ns

    def step(self, dt: float) -> Rendered:
        """Feel, and move [s]."""
        age_s = max(0, self._time_ns - self._heard_ns) / 1e9
        force = self._feedback.force(self._device.state, age_s, dt)
        self.newest = Rendered(self._device.exchange(force, dt), force)
        return self.newest

    def frame(self, now_ns: int) -> Rendered:
        """One step by the time that has passed [ns], where the device itself keeps the time."""
        dt = min(max(now_ns - self._time_ns, _SHORTEST_NS), _LONGEST_NS) / 1e9
        self._time_ns = now_ns
        return self.step(dt)

    def advance_to(self, now_ns: int) -> Rendered:
        """Bring the device up to the given time [ns]."""
        due = (now_ns - self._time_ns) // _PERIOD_NS
        if due > _CAUGHT_UP:
            self._time_ns += (due - _CAUGHT_UP) * _PERIOD_NS
        while self._time_ns + _PERIOD_NS <= now_ns:
            self._time_ns += _PERIOD_NS
            self.step(self._dt)
        return self.newest


class HapticThread:
    """Runs a loop at `RATE_HZ` on absolute ticks and measures how regular they are.

    It asks for real-time priority, since a hand feels a millisecond that another program takes; where the system
    does not grant it (`ulimit -r`), it runs as everybody else and says so in its figures.

    Args:
        loop: what to run.
        clock: what the ticks are counted on.
    """

    def __init__(self, loop: HapticLoop, clock: Clock) -> None:
        self._loop = loop
        self._clock = clock
        self._stop = threading.Event()
        self._lock = threading.Lock()
        self._ticks = TickStatistics(RATE_HZ)
        self._realtime = False
        self._thread = threading.Thread(target=self._run, name="haptics", daemon=True)
        self._thread.start()

    def figures(self) -> tuple[Figure, ...]:
        """How regular the ticks were since the last call, and how many came late so far."""
        with self._lock:
            figures = regularity(self._ticks)
        return (*figures, Figure("haptic_realtime", float(self._realtime), "granted"))

    def close(self) -> None:
        """Stop, and wait until it has."""
        self._stop.set()
        self._thread.join(timeout=1.0)

    def _run(self) -> None:
        self._realtime = _take_realtime_priority()
        due = self._clock.now_ns()
        while not self._stop.is_set():
            started = self._clock.now_ns()
            self._loop.advance_to(started)
            ended = self._clock.now_ns()
            with self._lock:
                self._ticks.tick(due, started, ended)
            due += max(1, (ended - due) // _PERIOD_NS) * _PERIOD_NS
            self._clock.sleep_until(due, self._stop)


def regularity(ticks: TickStatistics) -> tuple[Figure, ...]:
    """How regular the ticks of a force loop were since the last call, and how many came late so far."""
    period_p50, period_p99, step_p99 = ticks.take_quantiles()
    return (
        Figure("haptic_period_p50", 1e3 * period_p50, "ms"),
        Figure("haptic_period_p99", 1e3 * period_p99, "ms"),
        Figure("haptic_step_p99", 1e3 * step_p99, "ms"),
        Figure("haptic_ticks", float(ticks.ticks), "ticks"),
        Figure("haptic_late_ticks", float(ticks.late), "ticks"),
    )


def _take_realtime_priority() -> bool:
    """For the calling thread alone; says whether it was granted."""
    try:
        os.sched_setscheduler(0, os.SCHED_RR, os.sched_param(_PRIORITY))
    except (AttributeError, OSError):  # not every system has it, not every user may
        return False
    return True
