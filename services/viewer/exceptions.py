"""The viewer's failures.

ViewerError
├── WebFilesMissing  the Rerun SDK did not give its web viewer's files (an EnvironmentFault too)
└── CannotReplay     a recording that cannot be opened
"""

from __future__ import annotations

from pathlib import Path

from services.process.exceptions import EnvironmentFault, ServiceError


class ViewerError(ServiceError):
    """Base of what the viewer raises for a person to read."""


class WebFilesMissing(ViewerError, EnvironmentFault):
    """The Rerun SDK's web viewer could not be taken from it."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(f"the web viewer's files cannot be taken from the Rerun SDK ({reason}): reinstall rerun-sdk")


class CannotReplay(ViewerError):
    """The recording cannot be shown."""

    def __init__(self, path: Path, reason: str) -> None:
        self.path = path
        self.reason = reason
        super().__init__(f"cannot replay {path}: {reason}")
