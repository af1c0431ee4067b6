"""One at a time changes which files a folder of skills holds, and none of them is half-written."""

from __future__ import annotations

import fcntl
import os
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path

from services.process.exceptions import CannotWrite

_LOCK = ".skills.lock"
_PART = ".skill-"
"""Begins the name of a file that is not whole yet."""


@contextmanager
def alone(folder: Path) -> Iterator[None]:
    """Nobody else changes which files there are; what one that was killed has left is swept away.

    Raises:
        CannotWrite: the folder cannot be used.
    """
    lock = -1
    try:
        lock = os.open(folder / _LOCK, os.O_RDWR | os.O_CREAT | os.O_CLOEXEC, 0o644)
        fcntl.flock(lock, fcntl.LOCK_EX)
        _sweep(folder)
        yield
    except OSError as error:
        raise CannotWrite(error.filename or folder, error.strerror or str(error)) from None
    finally:
        if lock >= 0:
            os.close(lock)


@contextmanager
def unfinished(folder: Path, name: str) -> Iterator[Path]:
    """Where a file is written before it has its name; nothing is left there."""
    try:
        yield folder / f"{_PART}{name}"
    finally:
        _sweep(folder)


def _sweep(folder: Path) -> None:
    for left in [*folder.glob(f"{_PART}*"), *folder.glob(f".{_PART}*")]:
        left.unlink(missing_ok=True)
