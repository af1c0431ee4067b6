"""The cameras that a configuration can name, beside the robot's own: `[[camera.cameras]]`."""

from __future__ import annotations

import math
from typing import Annotated

import msgspec

from services.process.section import Section

MOST_CAMERAS = 16
"""That a configuration names: each has its place on the page and in the recording."""

Vector = tuple[float, float, float]
CameraName = Annotated[str, msgspec.Meta(pattern="^(?!live$)[a-z0-9][a-z0-9_-]{0,30}$")]
"""Of a camera; "live" is the page's own view."""

FieldOfView = Annotated[float, msgspec.Meta(gt=1.0, lt=170.0)]

FIELD_OF_VIEW = 48.0
"""Of a camera that says no other [deg], vertical."""


class Mounted(Section, frozen=True):
    """Where a camera is: x right, y down, z forward.

    Attributes:
        link: of the robot that carries it; empty where it stands in the scene.
        position: in the link's frame, or the base's [m].
        look_at: what it looks at, in the same frame, its picture upright [m]; else `rpy` counts.
        rpy: of its axes about the frame's [rad].
        fovy: vertical field of view [deg].
    """

    link: str = ""
    position: Vector = (0.0, 0.0, 0.0)
    look_at: Vector | None = None
    rpy: Vector = (0.0, 0.0, 0.0)
    fovy: FieldOfView = FIELD_OF_VIEW

    @property
    def turned(self) -> Vector:
        """Roll, pitch and yaw of the camera's axes about the frame's [rad]."""
        if self.look_at is None:
            return self.rpy
        x, y, z = (there - here for there, here in zip(self.look_at, self.position, strict=True))
        flat = math.hypot(x, y)
        # What looks straight down has the frame's x axis up in its picture.
        yaw = math.atan2(-x, y) if flat > 0.0 else -math.pi / 2
        return (-math.pi / 2 - math.atan2(-z, flat), 0.0, yaw)


class Simulated(Mounted, frozen=True, kw_only=True, tag_field="kind", tag="simulated"):
    """A camera that is drawn from the published state of the simulated world; see `Mounted`.

    Attributes:
        name: of the camera; that of one of the robot's own takes that one's place.
    """

    name: CameraName


class Device(Mounted, frozen=True, kw_only=True, tag_field="kind", tag="v4l2"):
    """A real camera that the kernel knows as a video device; see `Mounted`.

    Attributes:
        name: of the camera; that of one of the robot's own takes that one's place.
        device: its path, best by what does not change where others are plugged in, "/dev/v4l/by-id/...", or its number;
            a film's file or a stream's address stands in for one.
    """

    name: CameraName
    device: str


class RealSense(Mounted, frozen=True, kw_only=True, tag_field="kind", tag="realsense"):
    """The depth camera that the vendor's library finds first; see `Mounted`. It needs an OpenCV that has that library.

    Attributes:
        name: of the camera; that of one of the robot's own takes that one's place.
    """

    name: CameraName


RealCamera = Device | RealSense

CameraSource = Simulated | RealCamera
"""Whatever a camera process can look through."""
