"""Whoever started this process and watches over it: systemd, where it says so in the environment (sd_notify(3))."""

from __future__ import annotations

import contextlib
import os
import socket

SOCKET = "NOTIFY_SOCKET"
PATIENCE = "WATCHDOG_USEC"
"""After so many microseconds without a sign of life it is started again."""

OFTEN = 3
"""Signs of life in that time."""


class Manager:
    """Tells it how this process is; nobody where nobody asked.

    A manager that does not listen is no reason to fail.
    """

    def __init__(self) -> None:
        # Taken out: what is started from here does not speak for it.
        address = os.environ.pop(SOCKET, "")
        patience = os.environ.pop(PATIENCE, "")
        self._address = f"\0{address[1:]}" if address.startswith("@") else address
        self._period_ns = int(patience) * 1000 // OFTEN if patience.isdecimal() else None
        self._told_ns: int | None = None
        self._ready = False

    def ready(self) -> None:
        """Everything has been started, and is there."""
        if not self._ready:
            self._ready = True
            self._tell("READY=1")

    def alive(self, now_ns: int) -> None:
        """A sign of life, as often as it is wanted.

        Args:
            now_ns: the time, monotonic [ns].
        """
        if self._period_ns is None:
            return
        if self._told_ns is None or now_ns - self._told_ns >= self._period_ns:
            self._told_ns = now_ns
            self._tell("WATCHDOG=1")

    def stopping(self) -> None:
        """It ends because it was asked to, or because it has to."""
        self._tell("STOPPING=1")

    def _tell(self, state: str) -> None:
        if not self._address:
            return
        with contextlib.suppress(OSError), socket.socket(socket.AF_UNIX, socket.SOCK_DGRAM) as way:
            way.setblocking(False)
            way.sendto(state.encode(), self._address)
