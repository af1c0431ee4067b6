"""What the live view draws that changes now and then, and what moves all the time."""

from __future__ import annotations

import math
import struct
from collections.abc import Mapping
from typing import Any

import msgspec

from protocol.messages import Box, ObjectPose, Origin, Pose, RobotState, Vector3
from sim.robots.gripper import Gripper

Point = tuple[float, ...]

STILL = 1e-4
"""What moves by less stands, to whoever looks on [m, rad]."""

_SEEN = 3
"""Digits of the object's pose: cameras see no more."""

_NOWHERE = Pose((math.nan,) * 3, (math.nan,) * 4)


class Curve(msgspec.Struct, frozen=True):
    """A motion that is predicted, or that was shown and is to be followed.

    Attributes:
        points: base frame [m].
        spread: two standard deviations along each base axis at each point [m]; empty where they are not known.
        orientations: at each point, quaternions with the scalar first; empty where they are not known.
        origin: where it comes from.
    """

    points: tuple[Point, ...]
    spread: tuple[Point, ...] = ()
    orientations: tuple[Point, ...] = ()
    origin: Origin = Origin.MODEL


class Going(msgspec.Struct, frozen=True):
    """The motion under way, as far as one can tell from it how it goes on.

    Attributes:
        fading: how many look-aheads the whole motion takes: where nobody corrects it any more, the correction is
            exp(-fading * share) of itself after a share of the motion; 0 where it is gone at once.
        first: share of the motion from which on corrections count.
        last: until which.
        corrected: the operator shapes it.
    """

    fading: float = 0.0
    first: float = 0.0
    last: float = 1.0
    corrected: bool = False


class Criteria(msgspec.Struct, frozen=True):
    """By what the motion is judged.

    Attributes:
        radii: of the ellipsoid about the grasping frame that the object has to come into [m].
        reached: it has.
        collision: where the robot first touched something [m]; None where it did not.
        force: how hard [N].
    """

    radii: Vector3 = (0.0, 0.0, 0.0)
    reached: bool = False
    collision: Vector3 | None = None
    force: float = 0.0


class Kick(msgspec.Struct, frozen=True):
    """How far the object may be moved before it counts as kicked over.

    Attributes:
        stood: where its centre was at first, base frame [m]; None where that is not known.
        limits: the largest displacement along each base axis [m].
        kicked: it has been kicked over.
    """

    stood: Vector3 | None = None
    limits: Vector3 = (0.0, 0.0, 0.0)
    kicked: bool = False


class Drawing(msgspec.Struct, frozen=True):
    """What changes now and then.

    Attributes:
        boxes: what stands around the robot.
        size: of the object, full edge lengths [m]; zero where there is none.
        prediction: the motion that is or would be executed; None where there is none.
        going: the motion under way; None where there is none.
        way: where the episode's motion has led so far, the correction in it, base frame [m].
        criteria: by what it is judged.
        kick: how far the object may be moved.
        waypoints: that are stored, base frame [m].
        yaw: by which the axes of the operator's device are turned to the left of the base's [rad].
    """

    boxes: tuple[Box, ...] = ()
    size: Vector3 = (0.0, 0.0, 0.0)
    prediction: Curve | None = None
    going: Going | None = None
    way: tuple[Point, ...] = ()
    criteria: Criteria = Criteria()
    kick: Kick = Kick()
    waypoints: tuple[Point, ...] = ()
    yaw: float = 0.0

    def parts(self) -> Mapping[str, Any]:
        """By name."""
        return {name: getattr(self, name) for name in self.__struct_fields__}


def moment(
    robot: RobotState | None,
    seen: ObjectPose | None,
    force: Vector3,
    joints: tuple[str, ...],
    gripper: Gripper | None = None,
) -> Point:
    """What moves; not a number where nothing is known.

    In order: position and orientation (scalar first) of the grasping frame and of the object as it is seen, the applied
    correction as an offset [m] and a turn [rad], how far the motion is, from 0 to 1, the force that the operator feels
    [N], the joints' positions [rad, m].

    Args:
        robot: as measured.
        seen: the object.
        force: that the master renders [N].
        joints: names of those that are told, in order.
        gripper: whose fingers are among them; None where nothing is known of it.
    """
    measured = _NOWHERE if robot is None else robot.measured
    thing = _NOWHERE if seen is None else seen.pose
    positions = {} if robot is None else dict(zip(robot.joint_names, robot.q, strict=False))
    if robot is not None and gripper is not None:
        positions |= gripper.positions(robot.opening)
    return (
        *measured.position,
        *measured.orientation,
        *(round(value, _SEEN) for value in (*thing.position, *thing.orientation)),
        *(_NOWHERE.position if robot is None else robot.offset),
        *(_NOWHERE.position if robot is None else robot.turn),
        math.nan if robot is None else robot.progress,
        *force,
        *(positions.get(joint, math.nan) for joint in joints),
    )


def has_moved(now: Point, before: Point) -> bool:
    """Whether a moment shows another picture than one that was told before."""
    return len(now) != len(before) or any(
        abs(a - b) > STILL or math.isnan(a) is not math.isnan(b) for a, b in zip(now, before, strict=True)
    )


def packed(values: Point) -> bytes:
    """A moment as 32-bit floats, little endian."""
    return struct.pack(f"<{len(values)}f", *values)
