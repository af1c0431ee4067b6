"""What was asked of the arm and what it did, as motions with the prediction's number of way-points."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from lfd.motion.resampling import from_samples
from lfd.motion.trajectory import Trajectory
from sim.pose import Pose

Array = NDArray[np.float64]


@dataclass(frozen=True)
class Motions:
    """The three accounts of one execution.

    Attributes:
        refined: the reference, the operator's correction included.
        commanded: what the joints were told, as poses of the grasping frame.
        measured: what the arm did.
    """

    refined: Trajectory
    commanded: Trajectory
    measured: Trajectory


DENSEST = 0.5
"""Of samples: a slow motion leaves no more of them than one at its own pace [control periods]."""


class Recording:
    """Samples at the control rate; where the prediction's time stands still, on a ramp or in a pause, there are none.

    Where the arm went back, what it had passed is forgotten: of every time the last pass counts.

    Args:
        period: of the control [s].
    """

    def __init__(self, period: float) -> None:
        self._period = period
        self._times: list[float] = []
        self._rows: list[Array] = []  # refined, commanded and measured pose, each as position and orientation

    def add(self, time: float, refined: Pose, commanded: Pose, measured: Pose) -> None:
        """Keep the poses at a time of the prediction [s], unless that time is recorded already."""
        while self._times and self._times[-1] > time:
            self._drop()
        if self._times and time == self._times[-1]:
            return
        if len(self._times) > 1 and self._times[-1] - self._times[-2] < DENSEST * self._period:
            self._drop()
        poses = (refined, commanded, measured)
        self._times.append(time)
        self._rows.append(np.concatenate([part for pose in poses for part in (pose.position, pose.orientation)]))

    def motions(self, n: int, standing: Pose) -> Motions:
        """The part that was executed, at n way-points of equal time.

        Args:
            n: number of way-points.
            standing: where the arm is, for an execution that ended before it moved: it stands for a period then.
        """
        if len(self._times) < 2:
            positions, orientations = np.tile(standing.position, (n, 1)), np.tile(standing.orientation, (n, 1))
            still = Trajectory(positions, orientations, self._period)
            return Motions(still, still, still)
        poses = np.array(self._rows).reshape(-1, 3, 7)
        refined, commanded, measured = (
            from_samples(self._times, poses[:, i, :3], poses[:, i, 3:], n) for i in range(poses.shape[1])
        )
        return Motions(refined, commanded, measured)

    def _drop(self) -> None:
        self._times.pop()
        self._rows.pop()
