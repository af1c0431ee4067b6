"""Devices that OpenCV reads: a video device of the kernel, a depth camera, or a film in the place of either."""

from __future__ import annotations

from collections.abc import Callable
from pathlib import Path
from typing import NamedTuple, Protocol

import cv2
import numpy as np

from services.bus.arrays import Colours, Floats
from services.camera.exceptions import CameraUnusable
from services.process.cameras import RealCamera, RealSense

DEVICES = "/dev/"
"""What begins so is a video device of the kernel."""


class Shot(NamedTuple):
    """What a device gave.

    Attributes:
        image: RGB, shape (height, width, 3).
        depth: along the optical axis, zero where it is not known, of the same size [m]; None where there is none.
    """

    image: Colours
    depth: Floats | None = None


class Frames(Protocol):
    """A device that is open.

    Attributes:
        period_s: of a film, which does not wait for its next picture by itself; 0 for a device [s].
    """

    period_s: float

    def read(self) -> Shot | None:
        """Wait for the next picture; None where none comes any more."""
        ...

    def close(self) -> None:
        """Give the device back."""
        ...


Open = Callable[[RealCamera, int, int], Frames]
"""Opens a camera's device for pictures of a width and height, or of what comes nearest; raises CameraUnusable."""


def open_device(camera: RealCamera, width: int, height: int) -> Frames:
    """See `Open`."""
    cv2.utils.logging.setLogLevel(cv2.utils.logging.LOG_LEVEL_SILENT)  # what it would say is said in a line of ours
    return _DepthCamera() if isinstance(camera, RealSense) else _VideoDevice(camera.device, width, height)


class _VideoDevice:
    """See `Frames`."""

    def __init__(self, device: str, width: int, height: int) -> None:
        if device.startswith(DEVICES) and not Path(device).exists():
            raise CameraUnusable(f"there is no {device}: plug it in, or name another one")
        self._capture = _opened(device)
        if not self._capture.isOpened():
            raise CameraUnusable(f"{device} gives no pictures: another program may have it, or it is no camera's")
        rate_hz = self._capture.get(cv2.CAP_PROP_FPS)
        self.period_s = 1.0 / rate_hz if Path(device).is_file() and rate_hz > 0.0 else 0.0
        self._capture.set(cv2.CAP_PROP_FRAME_WIDTH, width)
        self._capture.set(cv2.CAP_PROP_FRAME_HEIGHT, height)

    def read(self) -> Shot | None:
        """See `Frames.read`."""
        there, picture = self._capture.read()
        return Shot(_rgb(picture)) if there else None

    def close(self) -> None:
        """See `Frames.close`."""
        self._capture.release()


class _DepthCamera:
    """See `Frames`. OpenCV takes the first one that the vendor's library finds, its depth laid over the colours."""

    def __init__(self) -> None:
        if not cv2.videoio_registry.hasBackend(cv2.CAP_REALSENSE):
            raise CameraUnusable(
                "this OpenCV reads no RealSense camera: build it with WITH_LIBREALSENSE, "
                'or take the colours alone, kind = "v4l2"'
            )
        self._capture = cv2.VideoCapture(0, cv2.CAP_REALSENSE)
        if not self._capture.isOpened():
            raise CameraUnusable("no RealSense camera is found: plug it in")
        self.period_s = 0.0
        self._unit = self._capture.get(cv2.CAP_PROP_INTELPERC_DEPTH_SATURATION_VALUE)

    def read(self) -> Shot | None:
        """See `Frames.read`."""
        if not self._capture.grab():
            return None
        there, picture = self._capture.retrieve(flag=cv2.CAP_INTELPERC_IMAGE)
        measured, depth = self._capture.retrieve(flag=cv2.CAP_INTELPERC_DEPTH_MAP)
        if not there:
            return None
        return Shot(_rgb(picture), self._unit * np.asarray(depth, dtype=np.float64) if measured else None)

    def close(self) -> None:
        """See `Frames.close`."""
        self._capture.release()


def _opened(device: str) -> cv2.VideoCapture:
    if device.isdecimal():
        return cv2.VideoCapture(int(device), cv2.CAP_V4L2)
    return cv2.VideoCapture(device, cv2.CAP_V4L2 if device.startswith(DEVICES) else cv2.CAP_ANY)


def _rgb(picture: cv2.typing.MatLike) -> Colours:
    code = cv2.COLOR_BGR2RGB if picture.ndim == len("hwc") else cv2.COLOR_GRAY2RGB
    return np.asarray(cv2.cvtColor(picture, code), dtype=np.uint8)
