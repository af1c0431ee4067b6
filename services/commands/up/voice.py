"""What a run says: on the terminal, and in the run's log; neither can hold the run up, or end it."""

from __future__ import annotations

import logging
import queue
import threading
from datetime import UTC, datetime
from pathlib import Path
from typing import TextIO

from rich.console import Console, RenderableType
from rich.live import Live

WAITING = 2000
"""Lines that wait for a terminal which does not take them; what comes then is in the log only."""

END_S = 0.5
"""How long the last lines may take."""


class Spoken(logging.Handler):
    """What the supervisor itself logs, said as what its processes log.

    Args:
        voice: says it.
    """

    def __init__(self, voice: Voice) -> None:
        super().__init__()
        self._voice = voice

    def emit(self, record: logging.LogRecord) -> None:
        """Say it."""
        self._voice.say("retouch", f"{record.levelname} {record.getMessage()}")


class Voice:
    """Prints the processes' lines with their name in front, and keeps them in the run's log.

    A terminal that is stopped, closed or a pipe that nobody reads holds up a thread of its own and nothing else.

    Args:
        console: the terminal, or what stands for it.
        log: the file.
        live: whether a table stands below the lines.

    Raises:
        OSError: the log cannot be opened.
    """

    def __init__(self, console: Console, log: Path, *, live: bool) -> None:
        self._console = console
        self._log: TextIO | None = log.open("a", encoding="utf-8")
        self._live = Live(console=console, auto_refresh=False, redirect_stdout=False, redirect_stderr=False)
        self._is_live = live
        self._lock = threading.Lock()
        self._lines: queue.Queue[tuple[str, str] | RenderableType | None] = queue.Queue(WAITING)
        self._printer = threading.Thread(target=self._print, daemon=True)
        self._printer.start()

    def say(self, name: str, line: str) -> None:
        """One line of a process; never waits."""
        with self._lock:
            self._keep(f"{datetime.now(UTC):%H:%M:%S.%f} {name}: {line}\n")
        self._show((name, line))

    def table(self, table: RenderableType) -> None:
        """What stands below the lines from now on, where there is a place for it."""
        if self._is_live:
            self._show(table)

    def close(self) -> None:
        """Print what is left, where it is taken, and close the log."""
        self._show(None)
        self._printer.join(END_S)
        with self._lock:
            if self._log is not None:
                self._close_log()

    def _keep(self, line: str) -> None:
        if self._log is None:
            return
        try:
            self._log.write(line)
            self._log.flush()
        except OSError as error:
            self._show(("retouch", f"the log {self._log.name} ends here: {error.strerror}; the run goes on without"))
            self._close_log()

    def _close_log(self) -> None:
        log, self._log = self._log, None
        try:
            if log is not None:
                log.close()
        except OSError:
            return  # what it still held has no place on the disk

    def _show(self, what: tuple[str, str] | RenderableType | None) -> None:
        try:
            self._lines.put_nowait(what)
        except queue.Full:
            return

    def _print(self) -> None:
        """Until nothing more comes, or nobody is there to read."""
        try:
            if self._is_live:
                self._live.start()
            while (what := self._lines.get()) is not None:
                self._print_one(what)
            self._live.stop()
        except (OSError, ValueError):
            self._console.quiet = True

    def _print_one(self, what: tuple[str, str] | RenderableType) -> None:
        match what:
            case (str(name), str(line)):
                self._console.print(f"{name:>10} | {line}", markup=False, highlight=False, soft_wrap=True)
            case table:
                self._live.update(table, refresh=True)
