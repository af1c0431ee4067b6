"""What a model is learnt for, and which demonstrations and questions belong to it."""

from __future__ import annotations

import numpy as np

from lfd.exceptions import OutOfRange
from lfd.motion.demonstration import Demonstration, Situation, check_dimension
from lfd.motion.trajectory import Trajectory
from lfd.store.stored import Binding
from services.process.exceptions import ServiceError
from sim.tasks import AnyScene

SHORTEST_S, LONGEST_S = 0.1, 3600.0
"""Of a robot's motion: no arm is faster, and no message carries a longer one."""

_CONDITION_WITHIN = 5.0  # [m] no object is farther from where a motion starts, no via-point from the origin


class OpeningUnfit(ServiceError):
    """A motion and a task differ in whether the gripper takes part."""

    def __init__(self, scene: str, *, takes_part: bool) -> None:
        self.takes_part = takes_part
        super().__init__(
            f"the gripper takes part in {scene}, and the motion does not say how far it is open: give its opening"
            if takes_part
            else f"the gripper takes no part in {scene}, and the motion says how far it is open: leave that out"
        )


def binding_of(scene: AnyScene) -> Binding:
    """What is learnt in a scene is good for it and for the robot that moves in it."""
    return Binding(scene.name, scene.robot.kind)


def check_demonstration(scene: AnyScene, demonstration: Demonstration) -> None:
    """Let pass a motion that the scene's robot can have made: a model learns from anything else for ever.

    Args:
        scene: that the skill is for.
        demonstration: to be learnt.

    Raises:
        OutOfRange: it is too fast or too slow for a robot.
        OutOfReach: the motion or its target is beyond the robot's reach.
        OpeningUnfit: it does not say how far the gripper is open where that takes part, or says it where it does not.
    """
    check_duration("the motion's duration", demonstration.trajectory)
    check_opening(scene, demonstration.trajectory)
    scene.robot.check("the motion passes", demonstration.trajectory.positions)
    check_situation(scene, demonstration.situation)


def check_situation(scene: AnyScene, situation: Situation) -> None:
    """Let pass what the robot can be asked for in a scene; see `check_demonstration`.

    Raises:
        OutOfReach: the start or the target is beyond the robot's reach.
        WrongShape: the condition has not as many numbers as the scene's.
        OutOfRange: it is larger than any that the scene has.
    """
    scene.robot.check("the motion starts at", situation.start_position[None])
    scene.robot.check("the target at", situation.origin[None])
    check_dimension(situation.condition, len(scene.region.lower))
    furthest = float(np.max(np.abs(situation.condition)))
    if furthest > _CONDITION_WITHIN:
        raise OutOfRange("the condition's largest number", furthest, f"at most {_CONDITION_WITHIN:g} m")


def check_opening(scene: AnyScene, motion: Trajectory) -> None:
    """Let pass a motion that says how far the gripper is open where that takes part in the task, and only there.

    Raises:
        OpeningUnfit: it is not so.
    """
    takes_part = scene.wide_open > 0.0
    if (motion.opening is not None) is not takes_part:
        raise OpeningUnfit(scene.name, takes_part=takes_part)


def check_duration(what: str, motion: Trajectory) -> None:
    """Let pass a motion that takes as long as a robot's can.

    Args:
        what: its duration is called in an error.
        motion: taught or predicted.

    Raises:
        OutOfRange: it takes less or more.
    """
    if not SHORTEST_S <= motion.duration <= LONGEST_S:
        raise OutOfRange(what, motion.duration, f"from {SHORTEST_S:g} to {LONGEST_S:g} s")
