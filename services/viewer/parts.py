"""A run's files: one, and another after each time when the disk did not take it.

A disk fills up, a folder is removed, a quota ends, a file system is remounted read-only: the recording breaks off, is
said to have done so, and goes on in a new file when there is room again.
"""

from __future__ import annotations

import contextlib
import logging
import threading
from collections.abc import Callable
from datetime import UTC, datetime
from pathlib import Path

import rerun as rr

from services.process.config import FOLDER_SETTING
from services.process.exceptions import FolderUnusable
from services.viewer.part import Part, refusal

log = logging.getLogger(__name__)

Painter = Callable[[rr.RecordingStream], None]
"""Draws what stays for the whole run."""

CHECK_S = 1.0
"""What was logged is on the disk within this time, or as soon as it was asked for; a disk that does not take it is
noticed then."""

_CLOSE_S = 1.0


class Parts:
    """The files of one run, and a thread of its own that watches over them: a disk may take its time.

    Args:
        folder: for them.
        robot: the robot's name, with which the files' begin.
        identity: of the recording.
        check_s: how often the thread looks [s]; 0 for no thread, `check` is called by hand.

    Attributes:
        path: of the first file.
        number: of files so far.
        fault: why nothing is recorded now, for people; empty where it is.
        size: of all files together when the thread looked last [byte]: whoever says so waits for no disk.

    Raises:
        FolderUnusable: the folder cannot be written to.
    """

    def __init__(self, folder: Path, robot: str, identity: str, check_s: float = CHECK_S) -> None:
        self.path = folder.absolute() / f"{robot}-{datetime.now(UTC):%Y%m%dT%H%M%SZ}.rrd"
        self.number = 1
        self.fault = ""
        self.size = 0
        self._identity = identity
        self._painters: dict[str, Painter] = {}
        self._lock = threading.Lock()
        self._finished = 0
        try:
            folder.mkdir(parents=True, exist_ok=True)
            self._part: Part | None = Part(self.path, identity)
        except OSError as error:
            raise FolderUnusable(folder, FOLDER_SETTING, error.strerror or str(error)) from None
        self._stop = threading.Event()
        self._asked = threading.Event()
        self._thread = threading.Thread(target=self._watch, args=(check_s,), name="recording", daemon=True)
        if check_s > 0.0:
            self._thread.start()

    @property
    def stream(self) -> rr.RecordingStream | None:
        """Of the file that is written now; None while there is none."""
        part = self._part
        return None if part is None else part.stream

    def paint(self, name: str, painter: Painter) -> None:
        """Draw what stays, in this file and in each later one; it replaces what had this name."""
        with self._lock:
            self._painters[name] = painter
            if self._part is not None:
                painter(self._part.stream)

    def ask(self) -> None:
        """Let the thread bring what was logged to the disk now."""
        self._asked.set()

    def check(self) -> None:
        """Bring what was logged to the disk, notice where it is not taken, and try again."""
        part = self._part
        if part is None:
            self._go_on()
            return
        cause = part.refusal()
        if cause:
            self._break_off(part, cause)
        else:
            self.size = self._finished + part.size

    def close(self, within_s: float) -> None:
        """Finish the file; a disk that does not answer is left to itself after this time [s]."""
        self._stop.set()
        self._asked.set()
        if self._thread.is_alive():
            self._thread.join(within_s)
        else:
            self._finish()

    def _watch(self, check_s: float) -> None:
        while not self._stop.is_set():
            self._asked.wait(check_s)
            self._asked.clear()
            self.check()
        self._finish()

    def _finish(self) -> None:
        part, self._part = self._part, None
        if part is not None:
            self._close(part)

    def _close(self, part: Part) -> None:
        part.close(_CLOSE_S)
        self._finished += part.size
        self.size = self._finished

    def _break_off(self, part: Part, cause: str) -> None:
        with self._lock:
            self._part = None
        self.fault = f"Nothing is recorded: {cause} ({part.path}). It goes on in a new file when there is room."
        log.error("%s", self.fault)
        self._close(part)

    def _go_on(self) -> None:
        """Open the next file, where it takes all that stays."""
        with contextlib.suppress(OSError):
            self.path.parent.mkdir(exist_ok=True)
        if refusal(self.path.parent):
            return
        path = self.path.with_name(f"{self.path.stem}-{self.number + 1}.rrd")
        try:
            part = Part(path, self._identity)
        except OSError:
            return
        with self._lock:
            painted = dict(self._painters)
        for painter in painted.values():
            painter(part.stream)
        if part.refusal():
            part.close(_CLOSE_S)
            path.unlink(missing_ok=True)
            return
        with self._lock:
            for name, painter in self._painters.items():
                if painted.get(name) is not painter:
                    painter(part.stream)
            self._part = part
        self.number += 1
        self.fault = ""
        log.warning("recording goes on in %s", path)
