"""Pictures: the class `cam`."""

from __future__ import annotations

from enum import Enum
from typing import Annotated

import msgspec

from protocol.messages.values import Count, Message, Name, Pose, Real


class Coding(Enum):
    """How a picture is coded.

    JPEG: a file that needs no other picture.
    H264: an access unit of H.264 in Annex B, constrained baseline: a key picture, which begins with its parameters and
        needs no other, or one that needs all since the key picture before it.
    """

    JPEG = "jpeg"
    H264 = "h264"


MOST_AFTER_KEY = 255
"""As many pictures may follow upon a key picture before the next one."""


class PictureQueue(Message, frozen=True, kw_only=True):
    """How long pictures queue on their way to one who looks at them, and what s/he needs of the cameras.

    Attributes:
        late: than the fastest samples of the same machine the newest pictures came, at least [s].
        waits: a picture is missing that others need: a key picture would help.
        jpeg_only: pictures of another coding cannot be shown.
    """

    late: Annotated[float, msgspec.Meta(ge=0.0, le=1e6)] = 0.0
    waits: bool = False
    jpeg_only: bool = False


class CameraImage(Message, frozen=True, kw_only=True):
    """One picture.

    Attributes:
        camera: its name.
        width: [pixel].
        height: [pixel].
        data: as `coding` says.
        intrinsics: of the pinhole: fx, fy, cx, cy [pixel].
        pose: of the optical frame (x right, y down, z forward) in the base frame.
        captured_ns: stamp of the state that the picture shows, in the robot's monotonic clock [ns].
        object_pose: in simulation the true pose of the object in this picture, else none.
        coding: of the data.
        after_key: how many pictures, sent one by one, it comes after the key picture; 0 where it needs no other.
    """

    camera: Name
    width: Count
    height: Count
    data: Annotated[bytes, msgspec.Meta(max_length=1_000_000)]
    intrinsics: tuple[Real, Real, Real, Real]
    pose: Pose
    captured_ns: Count = 0
    object_pose: Pose | None = None
    coding: Coding = Coding.JPEG
    after_key: Annotated[int, msgspec.Meta(ge=0, le=MOST_AFTER_KEY)] = 0


MOST_POINTS = 8_000
"""Of a cloud."""

POINT_BYTES = 9
"""A point of a cloud takes: three coordinates of two bytes, three colours of one."""


MOST_PACKING = 256
"""By so many bytes at most a stream is longer than what is packed into it."""


class PointCloud(Message, frozen=True, kw_only=True):
    """Points on the surfaces that a camera sees.

    Attributes:
        camera: that sees them.
        data: a zlib stream of the coordinates of all points, then the colours of all of them, little endian. A
            coordinate is an int16 in the base frame [mm], a colour red, green and blue as uint8. What is left of the
            bytes when every point has had its `POINT_BYTES` means nothing.
        captured_ns: stamp of the state that it shows, in the robot's monotonic clock [ns].
    """

    camera: Name
    data: Annotated[bytes, msgspec.Meta(max_length=MOST_POINTS * POINT_BYTES + MOST_PACKING)]
    captured_ns: Count = 0


class DepthPicture(Message, frozen=True, kw_only=True):
    """How far away is what a camera sees.

    Attributes:
        camera: that sees it.
        width: [pixel].
        height: [pixel].
        data: a PNG file of one channel of 16 bits: along the optical axis [mm]; 0 where it is not known or too far.
        intrinsics: of the pinhole: fx, fy, cx, cy [pixel].
        pose: of the optical frame (x right, y down, z forward) in the base frame.
        captured_ns: stamp of the state that it shows, in the robot's monotonic clock [ns].
    """

    camera: Name
    width: Count
    height: Count
    data: Annotated[bytes, msgspec.Meta(max_length=1_000_000)]
    intrinsics: tuple[Real, Real, Real, Real]
    pose: Pose
    captured_ns: Count = 0
