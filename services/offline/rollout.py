"""Episodes without bus and clock, as fast as they go: to give first demonstrations, and to map success."""

from collections.abc import Callable
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.motion.trajectory import Trajectory
from protocol.messages import Cut
from services.robot.arm import Arm
from services.robot.backends.backend import CONTROL_PERIOD
from services.robot.correction import UNCORRECTED, Correction
from services.robot.episode import EpisodeOutcome
from services.robot.execution import look_ahead
from services.robot.tick import Tick
from sim.pose import Pose

Array = NDArray[np.float64]


@dataclass(frozen=True, eq=False)
class RolloutView:
    """What an operator, or a script in its place, goes by.

    Attributes:
        time: since the rollout began [s].
        progress: of the prediction, from 0 to 1.
        nominal: what the prediction alone says now.
        correction: as it is applied now.
        tick: the last control period.
    """

    time: float
    progress: float
    nominal: Pose
    correction: Correction
    tick: Tick


Operator = Callable[[RolloutView], Correction]
"""From what is seen to the correction that is asked for."""


def rollout(
    arm: Arm,
    prediction: Trajectory,
    place: Array,
    *,
    variant: str | None = None,
    start: Pose | None = None,
    operator: Operator | None = None,
    after: float | None = None,
    to_collision: bool = False,
) -> EpisodeOutcome:
    """Reset the arm and execute a prediction to the end.

    Args:
        arm: on a simulated backend, as `simulated_arm` makes it.
        prediction: in the base frame.
        place: of the target: centre of the object, shape (3,) [m], or y of the via-points, shape (2,) [m].
        variant: of the scene; as it is by default.
        start: of the grasping frame; as it was by default.
        operator: who corrects it; nobody by default.
        after: look-ahead of the correction [s]; one way-point interval by default, 0 moves the current way-point.
        to_collision: end at the first touch, for whoever wants to know no more.

    Raises:
        StartImpossible: no motion can start there.
    """
    arm.reset(place, arm.variant if variant is None else variant, start)
    arm.begin(prediction, look_ahead(prediction) if after is None else after)
    tick = arm.tick(UNCORRECTED)
    time = CONTROL_PERIOD
    while tick.outcome is None:
        wanted = UNCORRECTED
        if operator is not None and arm.episode is not None:
            execution = arm.episode.execution
            wanted = operator(RolloutView(time, execution.progress, execution.nominal, execution.correction, tick))
        if to_collision and tick.verdict.collision is not None:
            arm.finish(Cut.STOPPED, "it collided")
        tick = arm.tick(wanted)
        time += CONTROL_PERIOD
    return tick.outcome
