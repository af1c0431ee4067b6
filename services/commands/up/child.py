"""A process of its own, under supervision: started by spawn, restarted with back-off, its log prefixed."""

from __future__ import annotations

import os
import subprocess
import threading
from collections.abc import Callable
from dataclasses import dataclass

from services.commands.up.retries import End, Retries
from services.process.exit_codes import Exit
from services.process.isolation import retouch_command

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
        say: called with (name, line) for every line that it logs, on a thread of its own; must not wait.

    Attributes:
        over: why it is not started again, where that is so; the run ends with it.
    """

    def __init__(self, job: Job, say: Callable[[str, str], None]) -> None:
        self.job = job
        self.restarts = 0
        self.last_line = ""
        self.exit_code: int | None = None
        self.over: End | None = None
        self._say = say
        self._retries = Retries(job.name, lives=job.restart)
        self._told: set[str] = set()
        self._process: subprocess.Popen[str] | None = None
        self._reader: threading.Thread | None = None
        self._started_ns = 0
        self._due_ns: int | None = 0

    @property
    def pid(self) -> int | None:
        """Of the living process."""
        return self._process.pid if self._process is not None else None

    @property
    def alive(self) -> bool:
        """Whether a process of the job lives now."""
        return self._process is not None

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
        if code == Exit.DONE and not self.job.restart:
            return
        judged = self._retries.ended(code, (now_ns - self._started_ns) / 1e9, self.last_line)
        if isinstance(judged, End):
            self.over = judged
            return
        self._due_ns = now_ns + round(judged.delay_s * 1e9)
        self.restarts += 1
        self._tell(judged.line)

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
            retouch_command(("--supervised", str(os.getpid()), *self.job.arguments)),
            stdin=subprocess.DEVNULL,
            stdout=subprocess.PIPE,
            stderr=subprocess.STDOUT,
            encoding="utf-8",
            errors="replace",
            env={**os.environ, **_ONE_THREAD},
            # What a terminal sends to its foreground reaches the supervisor alone, which stops them in order. A group,
            # not a session of its own: Linux shares the processor out among sessions, so that between two of them
            # niceness means nothing, and drawing would weigh as much as control.
            process_group=0,
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
                    self._tell(text)

    def _tell(self, line: str) -> None:
        """Say a line; what it fails by, each time that it is tried again, is said once."""
        if line.startswith(("retouch: ", "tries again")):
            if line in self._told:
                return
            self._told.add(line)
        self._say(self.job.name, line)
