"""What has to outlive the robot's process and its computer: the latched stop, and which epochs were given out."""

from __future__ import annotations

import logging
from concurrent.futures import Executor, Future, ThreadPoolExecutor
from pathlib import Path
from typing import Protocol

import msgspec

from protocol.messages import Count, Name, Text
from protocol.names import checked_name
from services.process.files import make_folder, state_folder, write_whole
from services.robot.latch import Latch

log = logging.getLogger(__name__)

RESERVED = 1024
"""Epochs that are reserved at a time, so that no change of the authority waits for a disk."""

RETRY = 100
"""After how many calls a file that could not be written is tried again; the robot calls in every control period."""

FILE = "safety.json"


class SafetyRecord(msgspec.Struct, frozen=True, forbid_unknown_fields=True):
    """The stop, see `Latch`, and a bound above every epoch that was given out; a file has to say all of it."""

    epoch_bound: Count
    latched: bool
    by: Name
    reason: Text
    at: Name
    released_by: Name

    @classmethod
    def of(cls, latch: Latch, epoch_bound: int = 0) -> SafetyRecord:
        """The record of a stop and a bound."""
        return cls(epoch_bound, **msgspec.structs.asdict(latch))

    @property
    def latch(self) -> Latch:
        """The stop."""
        return Latch(latched=self.latched, by=self.by, reason=self.reason, at=self.at, released_by=self.released_by)


class Memory(Protocol):
    """Where the robot keeps its stop and its epochs."""

    @property
    def settled(self) -> bool:
        """What was kept last is where it belongs, or cannot be brought there; see `fault`."""
        ...

    @property
    def fault(self) -> str:
        """Why what was kept last would not outlive the process; empty where it would."""
        ...

    def recall(self, at: str) -> SafetyRecord:
        """What was kept last, a latched stop where that cannot be told.

        Args:
            at: the time now, UTC, ISO 8601.
        """
        ...

    def keep(self, latch: Latch, epoch: int) -> None:
        """Keep the stop, and that epochs up to this one were given out; returns at once."""
        ...

    def close(self) -> None:
        """Finish what is being kept."""
        ...


class Volatile:
    """Remembers nothing: for robots that are simulated within one process. See `Memory`."""

    settled = True
    fault = ""

    def recall(self, at: str) -> SafetyRecord:
        """There was nothing before."""
        del at
        return SafetyRecord.of(Latch())

    def keep(self, latch: Latch, epoch: int) -> None:
        """Forget it."""

    def close(self) -> None:
        """Nothing is being kept."""


class SafetyFile:
    """Keeps them in a file, written whole and flushed to the disk by a thread that nobody waits for. See `Memory`.

    Args:
        path: of the file; its folder is made.
        executor: that writes, one file after another.
    """

    def __init__(self, path: Path, executor: Executor) -> None:
        self._path = path
        self._executor = executor
        self._record: SafetyRecord | None = None
        self._writing: Future[None] | None = None
        self._settled = True
        self._fault = ""
        self._calls = 0

    @property
    def settled(self) -> bool:
        """See `Memory.settled`."""
        self._look()
        return self._settled

    @property
    def fault(self) -> str:
        """See `Memory.fault`."""
        self._look()
        return self._fault

    def recall(self, at: str) -> SafetyRecord:
        """See `Memory.recall`."""
        try:
            self._record = msgspec.json.decode(self._path.read_bytes(), type=SafetyRecord)
        except FileNotFoundError:
            return SafetyRecord.of(Latch())
        except (OSError, ValueError, RecursionError) as error:  # no UTF-8, and what is nested too deeply, among them
            # Nobody knows whether a stop was latched: the safe answer is that it was.
            cause = (error.strerror or str(error)) if isinstance(error, OSError) else str(error)
            reason = f"{self._path} cannot be read ({cause}): look at the robot, then release the stop"
            log.error("the emergency stop is latched: %s", reason)
            return SafetyRecord.of(Latch().pressed("robot", reason, at))
        return self._record

    def keep(self, latch: Latch, epoch: int) -> None:
        """See `Memory.keep`."""
        bound = self._record.epoch_bound if self._record is not None else 0
        if epoch > bound - RESERVED // 2:
            bound = epoch + RESERVED
        record = SafetyRecord.of(latch, bound)
        self._calls += 1
        if record != self._record:
            self._record, self._settled = record, False
            self._write(record)
        elif self._fault and self._calls % RETRY == 0 and self._writing is None:
            self._write(record)

    def close(self) -> None:
        """See `Memory.close`."""
        self._executor.shutdown()

    def _write(self, record: SafetyRecord) -> None:
        self._writing = self._executor.submit(_write, self._path, record)

    def _look(self) -> None:
        """See whether the newest record has been written."""
        if self._writing is None or not self._writing.done():
            return
        error = self._writing.exception()
        self._writing, self._settled = None, True
        cause = (error.strerror or str(error)) if isinstance(error, OSError) else str(error)
        fault = f"the stop would not outlive this process: {self._path} cannot be written ({cause})" if error else ""
        if fault and fault != self._fault:
            log.error("%s", fault)
        self._fault = fault


def safety_file(robot: str) -> SafetyFile:
    """The file of a robot, in the user's state folder.

    Raises:
        InvalidName: the robot's name cannot be one.
        FolderUnusable: there is no such folder.
    """
    return SafetyFile(state_folder() / checked_name(robot) / FILE, ThreadPoolExecutor(1, "safety-file"))


def _write(path: Path, record: SafetyRecord) -> None:
    make_folder(path.parent)
    write_whole(path, msgspec.json.format(msgspec.json.encode(record)))
