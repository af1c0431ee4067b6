"""The log of a process: written by a thread of its own, so that a reader who takes no more holds nobody up."""

from __future__ import annotations

import logging
import os
import queue
import sys
import threading
from typing import TextIO

WAITING = 2000
"""Lines that wait for a reader; what comes then is counted, and the count is written once there is room."""

END_S = 0.5
"""How long the last lines may take."""


def own_stderr() -> TextIO:
    """Standard error with a buffer of its own: while a line waits there, nobody else's does."""
    return os.fdopen(os.dup(sys.stderr.fileno()), "w", 1, sys.stderr.encoding, "replace")


class Unhurried(logging.Handler):
    """Hands lines to a thread that writes them; whoever logs never waits.

    A terminal that was stopped by Ctrl-S, and a pipe whose reader sleeps, would else stop a robot at its next warning.

    Args:
        stream: to write them to.
        waiting: lines that wait at most.
    """

    def __init__(self, stream: TextIO, waiting: int = WAITING) -> None:
        super().__init__()
        self._stream = stream
        self._lines: queue.Queue[str | threading.Event] = queue.Queue(waiting)
        self._left_out = 0
        threading.Thread(target=self._write, name="log", daemon=True).start()

    def emit(self, record: logging.LogRecord) -> None:
        """Keep the line until it can be written."""
        try:
            self._lines.put_nowait(self.format(record))
        except queue.Full:
            self._left_out += 1

    def flush(self) -> None:
        """Wait until what was said is written, where somebody takes it."""
        written = threading.Event()
        try:
            self._lines.put(written, timeout=END_S)
        except queue.Full:
            return
        written.wait(END_S)

    def _write(self) -> None:
        while True:
            line = self._lines.get()
            if isinstance(line, threading.Event):
                line.set()
                continue
            if left_out := self._left_out:
                self._left_out -= left_out
                line = f"WARNING {left_out} lines were left out: nobody took them\n{line}"
            try:
                self._stream.write(f"{line}\n")
                self._stream.flush()
            except (OSError, ValueError):  # a log that cannot be written is no reason for anything
                continue
