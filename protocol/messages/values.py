"""What messages are made of: bounded numbers and names, arrays, poses, motions, and what every message carries."""

from __future__ import annotations

import math
from typing import Annotated

import msgspec

Real = Annotated[float, msgspec.Meta(ge=-1e9, le=1e9)]
Vector3 = tuple[Real, Real, Real]
Quaternion = tuple[Real, Real, Real, Real]
Text = Annotated[str, msgspec.Meta(max_length=4096)]
Name = Annotated[str, msgspec.Meta(max_length=64)]
LONGEST_REASON = 200
"""Characters of a reason, at most."""

Reason = Annotated[str, msgspec.Meta(max_length=LONGEST_REASON)]
Count = Annotated[int, msgspec.Meta(ge=0, le=2**53)]
Fraction = Annotated[float, msgspec.Meta(ge=0.0, le=1.0)]
Opening = Annotated[float, msgspec.Meta(ge=-1.0, le=1.0)]
"""Between a gripper's fingers [m]; a measured one may be a little under nothing."""

Duration = Annotated[float, msgspec.Meta(gt=0.0, le=3600.0)]
Joints = Annotated[tuple[Real, ...], msgspec.Meta(max_length=64)]
Condition = Annotated[tuple[Real, ...], msgspec.Meta(max_length=64)]

ITEM_SIZES = {"<f8": 8, "<f4": 4, "|u1": 1}
"""The array element types that may cross the wire: NumPy's names, little endian, to bytes an element."""


class Array(msgspec.Struct, frozen=True):
    """An n-dimensional array: element type, shape and raw bytes in C order.

    Raises:
        ValueError: on construction, where type, shape and length do not fit together.
    """

    dtype: Name
    shape: Annotated[tuple[Count, ...], msgspec.Meta(max_length=4)]
    data: bytes

    def __post_init__(self) -> None:
        item = ITEM_SIZES.get(self.dtype)
        if item is None:
            raise ValueError(f"dtype {self.dtype!r} is not one of {sorted(ITEM_SIZES)}")
        expected = math.prod(self.shape) * item
        if len(self.data) != expected:
            raise ValueError(f"{len(self.data)} bytes for shape {self.shape} of {self.dtype}, not {expected}")


class Pose(msgspec.Struct, frozen=True):
    """A position [m] and a unit quaternion."""

    position: Vector3
    orientation: Quaternion

    def __post_init__(self) -> None:
        norm = math.hypot(*self.orientation)
        if abs(norm - 1.0) > 1e-3:
            raise ValueError(f"orientation has norm {norm:.6g}, not 1")


class Waypoint(Pose, frozen=True):
    """A pose that a motion is to pass, and what the gripper does from there on.

    Attributes:
        opening: between the gripper's fingers [m]; None where it takes no part.
    """

    opening: Annotated[float, msgspec.Meta(ge=0.0, le=1.0)] | None = None


class Motion(msgspec.Struct, frozen=True):
    """A trajectory of the grasping frame in the base frame, uniform in time.

    Attributes:
        positions: shape (n, 3) [m].
        orientations: shape (n, 4), unit quaternions.
        duration: from the first sample to the last [s].
        opening: distance between the gripper's fingers, shape (n,) [m]; None where the gripper takes no part.
    """

    positions: Array
    orientations: Array
    duration: Duration
    opening: Array | None = None

    def __post_init__(self) -> None:
        n = self.positions.shape[0] if self.positions.shape else 0
        if not 2 <= n <= 10_000 or self.positions.shape != (n, 3) or self.orientations.shape != (n, 4):
            raise ValueError(
                f"positions {self.positions.shape} and orientations {self.orientations.shape} are not (n, 3) and (n, 4)"
            )
        if self.opening is not None and self.opening.shape != (n,):
            raise ValueError(f"opening {self.opening.shape} is not ({n},), as there are positions")
        if any(
            array is not None and array.dtype != "<f8" for array in (self.positions, self.orientations, self.opening)
        ):
            raise ValueError("a motion's arrays are '<f8'")


class Part(msgspec.Struct, frozen=True):
    """A part of a motion: its first and last phase, each from 0 to 1; the whole one by default."""

    first: Fraction = 0.0
    last: Fraction = 1.0

    def __post_init__(self) -> None:
        if not self.first < self.last:
            raise ValueError(f"the part from phase {self.first:g} to {self.last:g} is empty")


class Message(msgspec.Struct, frozen=True, kw_only=True):
    """What every message on a topic carries; the bus fills it in.

    A message names where it belongs, because a transport was seen to deliver samples under another key: the receiver
    checks robot, topic and process against what it subscribed to.

    Attributes:
        robot: whose topic it was published on.
        topic: its name.
        process: that published it.
        publisher: the sender's incarnation: the upper 16 bits name its machine since boot, the rest is random.
        sequence: counts the publisher's messages on this topic, from 1.
        stamp_ns: the sender's monotonic clock [ns].
    """

    robot: Name = ""
    topic: Name = ""
    process: Name = ""
    publisher: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
    sequence: Count = 0
    stamp_ns: Annotated[int, msgspec.Meta(ge=0, le=2**63 - 1)] = 0
