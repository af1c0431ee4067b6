"""Whether something failed because the machine, or a limit of this user's, gave no more."""

from __future__ import annotations

import errno

from services.process.exceptions import LimitReached

_MEMORY = ("memory", "end other programs, or raise the limit (ulimit -v)")
_FILES = ("open files", "raise the limit (ulimit -n)")
_PROCESSES = ("processes or threads", "end other programs, or raise the limit (ulimit -u)")

_BY_ERRNO = {
    errno.ENOMEM: _MEMORY,
    errno.EMFILE: _FILES,
    errno.ENFILE: _FILES,
    errno.EAGAIN: _PROCESSES,
}

_SAID = {
    "cannot allocate memory": _MEMORY,
    "failed to map segment": _MEMORY,
    "unable to allocate": _MEMORY,
    "too many open files": _FILES,
    "can't start new thread": _PROCESSES,
}
"""By libraries that pass on the system's words and not its number."""


def limit_reached(error: BaseException) -> LimitReached | None:
    """Which limit an error tells of; None for one of another kind."""
    if isinstance(error, MemoryError):
        return LimitReached(*_MEMORY)
    if isinstance(error, OSError) and error.errno in _BY_ERRNO:
        return LimitReached(*_BY_ERRNO[error.errno])
    if not isinstance(error, OSError | RuntimeError | ImportError):
        return None
    said = str(error).lower()
    return next((LimitReached(*limit) for words, limit in _SAID.items() if words in said), None)
