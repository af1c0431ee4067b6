"""The camera process' failures.

CameraUnusable         a camera's device that is not there, or gives no pictures
CalibrationImpossible  pictures and poses from which a camera cannot be calibrated
"""

from __future__ import annotations

from services.process.exceptions import ServiceError


class CameraUnusable(ServiceError):
    """A camera's device is not there, or gives no pictures."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)


class CalibrationImpossible(ServiceError):
    """Pictures and poses from which a camera cannot be calibrated; says what to add."""

    def __init__(self, reason: str) -> None:
        self.reason = reason
        super().__init__(reason)
