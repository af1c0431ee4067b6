"""Time, passed in: the clock of the machine since its start, or one that a test moves by hand."""

import threading
import time
from typing import Protocol


class Clock(Protocol):
    """A clock that never goes back."""

    def now_ns(self) -> int:
        """Nanoseconds since some fixed moment."""
        ...

    def sleep_until(self, deadline_ns: int, stop: threading.Event) -> None:
        """Return at the deadline, or earlier where `stop` is set."""
        ...

    def wait_until(self, deadline_ns: int, call: threading.Event) -> bool:
        """Return as soon as `call` is set, or at the deadline; whether it was set."""
        ...


CLOCK = getattr(time, "CLOCK_BOOTTIME", time.CLOCK_MONOTONIC)
"""The one that goes on while the machine sleeps: after it, other machines' stamps compare as before. Linux has it."""


def utc_ms() -> int:
    """The time of day by this machine, since 1970 [ms]: for people and certificates; no age is judged by it."""
    return time.clock_gettime_ns(time.CLOCK_REALTIME) // 1_000_000


class SystemClock:
    """The machine's clock since its start, its sleep included; all processes of a machine share it."""

    def now_ns(self) -> int:
        """Nanoseconds since the machine started."""
        return time.clock_gettime_ns(CLOCK)

    def sleep_until(self, deadline_ns: int, stop: threading.Event) -> None:
        """Sleep, in one piece where the wait is short: waiting on an event costs precision at 1 kHz."""
        remaining = deadline_ns - self.now_ns()
        if remaining > 50_000_000:
            stop.wait(remaining / 1e9)
        elif remaining > 0:
            time.sleep(remaining / 1e9)

    def wait_until(self, deadline_ns: int, call: threading.Event) -> bool:
        """Wait for the event no longer than until then."""
        return call.wait(max(0, deadline_ns - self.now_ns()) / 1e9)


class ManualClock:
    """A clock that stands still until it is moved."""

    def __init__(self, start_ns: int = 1_000_000_000) -> None:
        self._now_ns = start_ns

    def now_ns(self) -> int:
        """Where the clock was moved to."""
        return self._now_ns

    def sleep_until(self, deadline_ns: int, stop: threading.Event) -> None:
        """Jump to the deadline."""
        self._now_ns = max(self._now_ns, deadline_ns)

    def wait_until(self, deadline_ns: int, call: threading.Event) -> bool:
        """Jump to the deadline, where nothing calls."""
        if call.is_set():
            return True
        self._now_ns = max(self._now_ns, deadline_ns)
        return False

    def advance(self, seconds: float) -> None:
        """Move forward.

        Args:
            seconds: by how much, at least 0 [s].
        """
        self._now_ns += round(seconds * 1e9)
