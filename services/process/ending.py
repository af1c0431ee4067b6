"""How a process ends: within two seconds of being told to, whatever it is doing then.

Three things kept processes alive. Python takes apart every module before it ends, which took up to three seconds for
a drawing library on a busy machine; a session that leaves while its router hangs with a full link waits ten seconds
for room; and a signal is seen by Python only between two of its own instructions, not during a long import.
"""

from __future__ import annotations

import atexit
import contextlib
import os
import select
import signal
import socket
import threading
import time
from dataclasses import dataclass
from typing import NoReturn

from services.process.exit_codes import Exit

WITHIN_S = 1.5
"""From the signal to the end by force; the rest of the two seconds is the kernel's, which frees the memory."""

_STDERR = 2
ENDING = (signal.SIGTERM, signal.SIGINT, signal.SIGHUP)
"""Signals that tell a process to end."""


@dataclass
class Patience:
    """How long a process that was told to end may take.

    Attributes:
        seconds: from the signal; at 0 it ends at once, as one does that has nothing to finish yet [s].
    """

    seconds: float
    _told: socket.socket

    def dismiss(self) -> None:
        """Guard the end no longer."""
        signal.set_wakeup_fd(-1)
        self._told.shutdown(socket.SHUT_WR)


def end_within(seconds: float = WITHIN_S, forced: Exit = Exit.CRASHED) -> Patience:
    """From now on a signal that ends this process does so within the time, even where something hangs.

    Args:
        seconds: from the signal; a process that ends by itself is left alone [s].
        forced: the exit code where it does not.

    Returns:
        The time, to be changed when there is more or less to finish.
    """
    heard, told = socket.socketpair()
    patience = Patience(seconds, told)
    told.setblocking(False)
    # Written by the signal's handler in C, so that it does not depend on what Python's main thread is doing.
    signal.set_wakeup_fd(told.fileno(), warn_on_full_buffer=False)
    threading.Thread(target=_guard, args=(heard, told, patience, forced), name="end", daemon=True).start()
    return patience


def _guard(heard: socket.socket, told: socket.socket, patience: Patience, forced: Exit) -> None:
    with heard, told:
        while not set(ENDING).intersection(signals := heard.recv(64)):
            if not signals:
                return
        if patience.seconds <= 0.0:
            os._exit(Exit.DONE)
        time.sleep(patience.seconds)
        with contextlib.suppress(OSError, ValueError):
            if select.select([], [_STDERR], [], 0.0)[1]:  # a stopped terminal would hold this up too
                os.write(_STDERR, b"retouch: did not end in time: ended by force\n")
        os._exit(forced)


def leave(code: int) -> NoReturn:
    """End this process at once; everything of its own is closed and written, and the rest belongs to nobody.

    Args:
        code: that its parent reads.
    """
    atexit._run_exitfuncs()
    os._exit(code)
