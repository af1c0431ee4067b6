"""A child that does not outlive whoever started it."""

from __future__ import annotations

import ctypes
import os
import signal

_PR_SET_PDEATHSIG = 1


def die_with_parent(supervisor: int, by: signal.Signals = signal.SIGTERM) -> None:
    """Ask the kernel (Linux) for a signal when the supervisor dies, so that no process is left behind.

    Args:
        supervisor: its process id; where it has died already, nobody would send the signal.
        by: the signal; SIGKILL for a process that blocks all others, and has nothing to finish.
    """
    ctypes.CDLL(None).prctl(_PR_SET_PDEATHSIG, by)
    if os.getppid() != supervisor:
        os.kill(os.getpid(), by)
