"""What a camera has seen, wherever it looks."""

from __future__ import annotations

from collections.abc import Callable
from typing import NamedTuple, Protocol

from protocol.messages import Pose
from services.bus.arrays import Colours, Floats


class Seen(NamedTuple):
    """A picture, and what is known of it.

    Attributes:
        image: RGB, shape (height, width, 3).
        intrinsics: of the pinhole, shape (3, 3) [pixel].
        pose: of the optical frame (x right, y down, z forward) in the base frame.
        captured_ns: when it was so, in this machine's monotonic clock [ns].
        object_pose: in simulation the true pose of the object in this picture, else None.
        depth: gives how far along the optical axis each pixel's point is, shape (height, width) [m], until the camera
            looks again; None where the camera has no depth.
    """

    image: Colours
    intrinsics: Floats
    pose: Pose
    captured_ns: int
    object_pose: Pose | None = None
    depth: Callable[[], Floats] | None = None


class Source(Protocol):
    """Where a camera's pictures come from."""

    def look(self, now_ns: int) -> Seen | None:
        """The newest picture; None where there is none that was not seen yet."""
        ...
