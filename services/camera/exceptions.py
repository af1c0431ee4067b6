"""The camera process' failures.

CameraUnusable  a camera's device that is not there, or gives no pictures
"""

from __future__ import annotations

from services.process.exceptions import ServiceError


class CameraUnusable(ServiceError):
    """A camera's device is not there, or gives no pictures."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)
