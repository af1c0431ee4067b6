"""A maker's calls that wait for an answer, made on a thread of their own: the newest one counts."""

from collections.abc import Callable
from threading import Event, Thread

Call = Callable[[], None]


class Sender:
    """Makes one call after the other; one that was not begun before the next was given is not made.

    Args:
        name: of the thread.
    """

    def __init__(self, name: str) -> None:
        self._next: Call | None = None
        self._given = Event()
        self._made = Event()
        self._made.set()
        self._ended = False
        self._error: Exception | None = None
        self._thread = Thread(target=self._run, name=name, daemon=True)
        self._thread.start()

    def give(self, call: Call) -> None:
        """Let it be made; returns at once."""
        self._made.clear()
        self._next = call
        self._given.set()

    def wait(self, seconds: float) -> bool:
        """Wait until what was given last has been made; whether it was."""
        return self._made.wait(seconds)

    def check(self) -> None:
        """Raise what a call since the last check raised."""
        error, self._error = self._error, None
        if error is not None:
            raise error

    def close(self, last: Call | None = None) -> None:
        """Make one last call, and no more; waits for it, but not for long."""
        self._next = last
        self._ended = True
        self._given.set()
        self._thread.join(1.0)

    def _run(self) -> None:
        while True:
            self._given.wait()
            self._given.clear()
            call, self._next = self._next, None
            if call is not None:
                try:
                    call()
                except Exception as error:  # noqa: BLE001 (whatever a maker's library raises is told by `check`)
                    self._error = error
            if not self._given.is_set():
                self._made.set()
            if self._ended and self._next is None:
                return
