"""One file of a recording."""

from __future__ import annotations

import contextlib
import os
import select
import tempfile
import threading
from pathlib import Path

import rerun as rr

from services.viewer.framing import Whole, whole_length
from services.viewer.live import APPLICATION, only_our_time

# A disk that does not answer for so long does not take what is logged.
_HUNG_S = 5.0

# A chunk ends where it is brought to the disk: a clock of its own would only cut it in two.
_BATCHER = rr.ChunkBatcherConfig(flush_tick=_HUNG_S)

# As much as a file takes that holds nothing but what stays for the whole run.
_LEAST = 2**20

_PIPE = 2**16  # as much as a pipe holds
_IDLE_S = 0.1


class Part:
    """A file that is written to, by whole messages. What it has taken is readable at any time, after a kill too.

    The SDK writes into a pipe, and a thread from there to the disk: the SDK does not say why a write fails, and does
    not always come back from closing a file that could not be written.

    Args:
        path: of the file.
        identity: of the recording.

    Raises:
        OSError: the file cannot be made.
    """

    def __init__(self, path: Path, identity: str) -> None:
        self.path = path
        self._file = path.open("xb", buffering=0)
        self._cause = ""
        # Nothing is left in the pipe of what was there when this was cleared.
        self._drained = threading.Event()
        self._copied = self._enough = 0
        self._source, sink = os.pipe()
        self.stream = rr.RecordingStream(APPLICATION, recording_id=identity, batcher_config=_BATCHER)
        self.stream.set_sinks(rr.FileSink(f"/dev/fd/{sink}"))
        os.close(sink)
        only_our_time(self.stream)
        self._thread = threading.Thread(target=self._copy, name=path.name, daemon=True)
        self._thread.start()

    @property
    def size(self) -> int:
        """How much has been written [byte]; nothing of a file that is gone."""
        try:
            return self.path.stat().st_size
        except OSError:
            return 0

    def refusal(self) -> str:
        """Bring what was logged to the disk; why that fails, empty where it does not."""
        try:
            self.stream.flush(timeout_sec=_HUNG_S)
        except (RuntimeError, ValueError):
            return self._cause or "the disk does not answer"
        self._enough = self._copied + _PIPE
        self._drained.clear()
        if not self._drained.wait(_HUNG_S):
            return "the disk does not answer"
        return self._cause or ("" if self.path.exists() else "the file was removed")

    def close(self, within_s: float) -> None:
        """Finish the file, as far as it can be read; a disk that does not answer is left to itself after this time."""
        self.stream.disconnect()
        self._thread.join(within_s)

    def _copy(self) -> None:
        whole = Whole()
        while True:
            if not select.select([self._source], [], [], _IDLE_S)[0]:
                self._drained.set()
                continue
            piece = os.read(self._source, _PIPE)
            if not piece:
                break
            if not self._cause:
                self._cause = self._write(whole.add(piece))
            self._copied += len(piece)
            if self._copied >= self._enough:
                self._drained.set()
        if not self._cause:
            self._cause = self._write(whole.rest())
        os.close(self._source)
        self._file.close()

    def _write(self, piece: bytes) -> str:
        left = memoryview(piece)
        try:
            while left:
                left = left[self._file.write(left) :]
        except OSError as error:
            # The last message is there by half.
            with contextlib.suppress(OSError):
                os.truncate(self.path, whole_length(self.path))
            return reason(error)
        return ""


def refusal(folder: Path) -> str:
    """Why no file can be written in the folder; empty where one can."""
    try:
        with tempfile.TemporaryFile(dir=folder) as probe:
            probe.write(bytes(_LEAST))
            probe.flush()
    except OSError as error:
        return reason(error)
    return ""


def reason(error: OSError) -> str:
    """Why the system refused, in its own words."""
    return (error.strerror or str(error)).lower()
