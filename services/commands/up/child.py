"""A process of its own, under supervision: started by spawn, restarted with back-off, its log prefixed."""

from __future__ import annotations

import os
import subprocess
import sys
import threading
from collections.abc import Callable
from dataclasses import dataclass

EXIT_BAD_INPUT = 2
"""A process that ends with this code said why in its last line; starting it again would not help."""

BACK_OFF_S = (0.2, 0.5, 1.0, 2.0, 5.0)
STEADY_AFTER_S = 10.0

_ONE_THREAD = dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1")
"""Several processes share few cores: the linear algebra in each gets one."""


@dataclass(frozen=True)
class Job:
    """What to run.

    Attributes:
        name: prefix of its log lines.
        arguments: of the `retouch` command.
        restart: whether it should live as long as the supervisor; otherwise it is done when it ends with 0.
    """

    name: str
    arguments: tuple[str, ...]
    restart: bool = True


class Child:
    """A job's process, and the next one where it dies.

    Args:
        job: what to run.
        say: called with (name, line) for every line that it logs, on a thread of its own.
    """

    def __init__(self, job: Job, say: Callable[[str, str], None]) -> None:
        self.job = job
        self.restarts = 0
        self.last_line = ""
        self._say = say
        self._process: subprocess.Popen[str] | None = None
        self._reader: threading.Thread | None = None
        self._started_ns = 0
        self._due_ns: int | None = 0
        self._failures = 0
        self.exit_code: int | None = None

    @property
    def pid(self) -> int | None:
        """Of the living process."""
        return self._process.pid if self._process is not None else None

    @property
    def alive(self) -> bool:
        """Whether a process of the job lives now."""
        return self._process is not None

    @property
    def gave_up(self) -> bool:
        """It ended for a reason that a restart does not cure."""
        return self.exit_code == EXIT_BAD_INPUT

    def poll(self, now_ns: int) -> None:
        """Start what is due, notice what has died."""
        if self._process is None:
            if self._due_ns is not None and now_ns >= self._due_ns:
                self._start(now_ns)
            return
        code = self._process.poll()
        if code is None:
            return
        if self._reader is not None:
            self._reader.join(timeout=1.0)
        self._process, self.exit_code, self._due_ns = None, code, None
        if code == EXIT_BAD_INPUT or (code == 0 and not self.job.restart):
            return
        steady = now_ns - self._started_ns > STEADY_AFTER_S * 1e9
        self._failures = 1 if steady else self._failures + 1
        delay = BACK_OFF_S[min(self._failures, len(BACK_OFF_S)) - 1]
        self._due_ns = now_ns + int(delay * 1e9)
        self.restarts += 1
        ending = f"was killed by signal {-code}" if code < 0 else f"ended with code {code}"
        self._say(self.job.name, f"{ending}; starts again in {delay:g} s")

    def terminate(self) -> None:
        """Ask it to stop."""
        self._due_ns = None
        if self._process is not None:
            self._process.terminate()

    def wait(self, timeout_s: float) -> None:
        """Wait for its end; kill it where it does not come."""
        if self._process is None:
            return
        try:
            self._process.wait(timeout_s)
        except subprocess.TimeoutExpired:
            self._say(self.job.name, "did not stop in time and was killed")
            self._process.kill()
            self._process.wait()
        self._process = None

    def _start(self, now_ns: int) -> None:
        self._started_ns, self.exit_code = now_ns, None
        self._process = subprocess.Popen(
            [sys.executable, "-m", "services", "--supervised", str(os.getpid()), *self.job.arguments],
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            text=True,
            errors="replace",
            env={**os.environ, **_ONE_THREAD, "PYTHONUNBUFFERED": "1"},
        )
        self._reader = threading.Thread(target=self._forward, args=(self._process,), daemon=True)
        self._reader.start()

    def _forward(self, process: subprocess.Popen[str]) -> None:
        assert process.stdout is not None
        with process.stdout as lines:
            for line in lines:
                text = line.rstrip()
                if text:
                    self.last_line = text
                    self._say(self.job.name, text)
