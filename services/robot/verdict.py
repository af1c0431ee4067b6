"""The success criteria, and those of Appendix E: object reached, not kicked over, no collision."""

import math
from collections.abc import Iterator
from dataclasses import dataclass
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from lfd.motion.rotations import conjugate, rotate
from protocol.messages import Unmet
from services.robot.backends.backend import Observation, Touch
from sim.pose import Pose
from sim.tasks.success import Success

Array = NDArray[np.float64]

UNSEEN = 1e6
"""The ellipsoid's value of an object that nobody has seen: as far off as can be said."""


@dataclass(frozen=True, eq=False)
class Verdict:
    """The criteria and what they rest on.

    Attributes:
        reached: the target is; the object's centre lies in the ellipsoid or on its boundary.
        kicked_over: the object moved further than its threshold on some axis, or is tilted further than it stands.
        collision: the first touch of the environment in this episode, None where there was none.
        ellipsoid_value: how far off the target is: left side of the ellipsoid's equation (Fig. E.2); at most 1 inside.
        displacement: of the object since the episode began, shape (3,) [m].
        tilt: of the object's upright axis from the vertical [rad].
        missed: distance from the grasping frame to the object's centre, or the greatest one at a via-point; negative
            where nobody has seen the object [m].
        unmet: what else the task asks for and is not so.
    """

    reached: bool
    kicked_over: bool
    collision: Touch | None
    ellipsoid_value: float
    displacement: Array
    tilt: float = 0.0
    missed: float = 0.0
    unmet: tuple[Unmet, ...] = ()

    @property
    def success(self) -> bool:
        """All criteria are met; what else a task asks for is a part of reaching its target."""
        return self.reached and not self.kicked_over and self.collision is None


class Judge(Protocol):
    """Judges an episode period by period; a collision stays until the next one begins."""

    def judge(
        self,
        grasping: Pose,
        object_pose: Pose | None,
        touch: Touch | None,
        *,
        grasped: bool = False,
        time: float = 0.0,
    ) -> Verdict:
        """The verdict now.

        Args:
            grasping: pose of the grasping frame.
            object_pose: of the object's centre, its z axis upright; None where nobody has seen it yet.
            touch: of robot and environment in this period.
            grasped: the gripper holds the object.
            time: since the episode's beginning [s].
        """
        ...


class Criteria(Protocol):
    """By what episodes are judged."""

    def begin(self, seen: Observation) -> Judge:
        """The judge of an episode that begins with what is seen."""
        ...


@dataclass(frozen=True, eq=False)
class ReachingCriteria:
    """By what an episode is judged that is to reach an object.

    Attributes:
        radii: of the ellipsoid fixed to the grasping frame, along its axes, shape (3,) [m].
        thresholds: displacement along each base axis beyond which the object counts as kicked over, shape (3,) [m].
        tipping_angle: tilt beyond which it does too, wherever its centre is: it does not stand up again [rad].
        goals: what else has to be so: of a task in which the gripper takes part, and of time.
    """

    radii: Array
    thresholds: Array
    tipping_angle: float
    goals: Success | None = None

    def begin(self, seen: Observation) -> "ReachingJudge":
        """See `Criteria.begin`."""
        return ReachingJudge(self, None if seen.object_pose is None else seen.object_pose.position)


class ReachingJudge:
    """See `Judge`.

    Args:
        criteria: by what.
        object_position: where the object stands before, shape (3,) [m]; None for where it is seen first.
    """

    def __init__(self, criteria: ReachingCriteria, object_position: Array | None) -> None:
        self._criteria = criteria
        self._initial = object_position
        self._held = False
        self._collision: Touch | None = None

    def judge(
        self,
        grasping: Pose,
        object_pose: Pose | None,
        touch: Touch | None,
        *,
        grasped: bool = False,
        time: float = 0.0,
    ) -> Verdict:
        """See `Judge.judge`."""
        self._collision = self._collision or touch
        if object_pose is None:
            return Verdict(
                reached=False,
                kicked_over=False,
                collision=self._collision,
                ellipsoid_value=UNSEEN,
                displacement=np.zeros(3),
                missed=-1.0,
            )
        initial = self._initial = object_pose.position if self._initial is None else self._initial
        criteria = self._criteria
        value = ellipsoid_value(grasping, object_pose.position, criteria.radii)
        displacement, tilt = object_pose.position - initial, tilt_of(object_pose.orientation)
        goals = criteria.goals
        self._held = self._held or (grasped and goals is not None and goals.gripper)
        # What was held is where it was carried to; it may still have fallen.
        moved = not self._held and bool(np.any(np.abs(displacement) > criteria.thresholds))
        up = float(displacement[2])
        unmet = () if goals is None else tuple(self._unmet(goals, object_pose.position, up, grasped, time))
        put_down = goals is not None and goals.placed is not None
        return Verdict(
            reached=not unmet and (value <= 1.0 or put_down),
            kicked_over=moved or tilt > criteria.tipping_angle,
            collision=self._collision,
            ellipsoid_value=value,
            displacement=displacement,
            tilt=tilt,
            missed=float(np.linalg.norm(object_pose.position - grasping.position)),
            unmet=unmet,
        )

    def _unmet(self, goals: Success, position: Array, up: float, grasped: bool, time: float) -> Iterator[Unmet]:
        """What the task asks for beside reaching its object, and is not so now."""
        if goals.grasped and not grasped:
            yield Unmet.GRASPED
        if goals.placed is not None:
            if grasped or not self._held or not goals.placed.contains(position):
                yield Unmet.PLACED
        elif goals.lifted is not None and not (grasped and up >= goals.lifted):
            yield Unmet.LIFTED
        if goals.time is not None and time > goals.time:
            yield Unmet.IN_TIME


def tilt_of(orientation: Array) -> float:
    """Angle between a body's z axis and the vertical, from 0 to pi [rad].

    Args:
        orientation: of the body, shape (4,).
    """
    w, x, y, z = orientation.tolist()
    # Where the z axis points: the third column of the rotation's matrix.
    return math.atan2(math.hypot(2.0 * (w * y + x * z), 2.0 * (y * z - w * x)), 1.0 - 2.0 * (x * x + y * y))


def ellipsoid_value(grasping: Pose, object_position: Array, radii: Array) -> float:
    """(x/a)^2 + (y/b)^2 + (z/c)^2 of the object's centre in the grasping frame (Fig. E.2).

    Args:
        grasping: pose of the grasping frame, where the ellipsoid's centre is.
        object_position: shape (3,) [m].
        radii: a, b, c, shape (3,) [m].
    """
    p_object = rotate(conjugate(grasping.orientation), object_position - grasping.position)
    return float(np.sum((p_object / radii) ** 2))
