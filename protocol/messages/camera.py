"""Pictures: the class `cam`."""

from __future__ import annotations

from typing import Annotated

import msgspec

from protocol.messages.values import Count, Message, Name, Pose, Real


class PictureQueue(Message, frozen=True, kw_only=True):
    """How long pictures queue on their way to one who looks at them.

    Attributes:
        late: than the fastest samples of the same machine the newest pictures came, as a rule [s].
    """

    late: Annotated[float, msgspec.Meta(ge=0.0, le=1e6)] = 0.0


class CameraImage(Message, frozen=True, kw_only=True):
    """One picture as JPEG.

    Attributes:
        camera: "head" or "wrist".
        width: [pixel].
        height: [pixel].
        data: the JPEG file.
        intrinsics: of the pinhole: fx, fy, cx, cy [pixel].
        pose: of the optical frame (x right, y down, z forward) in the base frame.
        captured_ns: stamp of the state that the picture shows, in the robot's monotonic clock [ns].
        object_pose: in simulation the true pose of the object in this picture, else none.
    """

    camera: Name
    width: Count
    height: Count
    data: Annotated[bytes, msgspec.Meta(max_length=1_000_000)]
    intrinsics: tuple[Real, Real, Real, Real]
    pose: Pose
    captured_ns: Count = 0
    object_pose: Pose | None = None


MOST_POINTS = 8_000
"""Of a cloud."""

POINT_BYTES = 9
"""A point of a cloud takes: three coordinates of two bytes, three colours of one."""


class PointCloud(Message, frozen=True, kw_only=True):
    """Points on the surfaces that a camera sees.

    Attributes:
        camera: that sees them.
        data: the coordinates of all points, then the colours of all of them, little endian. A coordinate is an int16 in
            the base frame [mm], a colour red, green and blue as uint8. What is left of the bytes when every point has
            had its `POINT_BYTES` means nothing.
        captured_ns: stamp of the state that it shows, in the robot's monotonic clock [ns].
    """

    camera: Name
    data: Annotated[bytes, msgspec.Meta(max_length=MOST_POINTS * POINT_BYTES)]
    captured_ns: Count = 0
