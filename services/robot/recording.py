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


class Recording:
    """Samples at the control rate; ramps and holds, in which the prediction's time stands still, leave none."""

    def __init__(self) -> None:
        self._times: list[float] = []
        self._rows: list[Array] = []  # refined, commanded and measured pose, each as position and orientation

    def add(self, time: float, refined: Pose, commanded: Pose, measured: Pose) -> None:
        """Keep the poses at a time of the prediction [s], unless that time is recorded already."""
        if not self._times or time > self._times[-1]:
            poses = (refined, commanded, measured)
            self._times.append(time)
            self._rows.append(np.concatenate([part for pose in poses for part in (pose.position, pose.orientation)]))

    def motions(self, n: int, standing: Pose, period: float) -> Motions:
        """The part that was executed, at n way-points of equal time.

        Args:
            n: number of way-points.
            standing: where the arm is, for an execution that ended before it moved.
            period: duration of such a motion that is none [s].
        """
        if len(self._times) < 2:
            still = Trajectory(np.tile(standing.position, (n, 1)), np.tile(standing.orientation, (n, 1)), period)
            return Motions(still, still, still)
        poses = np.array(self._rows).reshape(-1, 3, 7)
        refined, commanded, measured = (
            from_samples(self._times, poses[:, i, :3], poses[:, i, 3:], n) for i in range(poses.shape[1])
        )
        return Motions(refined, commanded, measured)
