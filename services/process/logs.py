"""The log of a process: written by a thread of its own, so that a reader who takes no more holds nobody up."""

from __future__ import annotations

import logging
import os
import queue
import sys
import threading
import time
from typing import TextIO

from services.process.repeats import Repeats

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
    What is said again and again is counted, so that it buries nothing.

    Args:
        stream: to write them to.
        waiting: lines that wait at most.
    """

    def __init__(self, stream: TextIO, waiting: int = WAITING) -> None:
        super().__init__()
        self._stream = stream
        self._lines: queue.Queue[str | threading.Event] = queue.Queue(waiting)
        self._left_out = 0
        self._repeats = Repeats()
        threading.Thread(target=self._write, name="log", daemon=True).start()

    def emit(self, record: logging.LogRecord) -> None:
        """Keep the line until it can be written."""
        line = self.format(record)
        if record.levelno < logging.INFO:  # whoever looks for a fault wants them all
            self._keep(line)
            return
        for told in self._repeats.told(line, time.monotonic()):
            self._keep(told)

    def flush(self) -> None:
        """Wait until what was said is written, where somebody takes it."""
        self.acquire()
        try:
            for line in self._repeats.rest():
                self._keep(line)
        finally:
            self.release()
        written = threading.Event()
        try:
            self._lines.put(written, timeout=END_S)
        except queue.Full:
            return
        written.wait(END_S)

    def _keep(self, line: str) -> None:
        try:
            self._lines.put_nowait(line)
        except queue.Full:
            self._left_out += 1

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
