"""The log's failures, each one line."""

from __future__ import annotations

from pathlib import Path

from services.process.exceptions import ServiceError


class NoLog(ServiceError):
    """A log that is not there, or cannot be read."""

    def __init__(self, path: Path, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"there is no evidence log to read: {path}: {reason}; --robot names another robot's")
