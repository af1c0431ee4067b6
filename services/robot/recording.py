"""What was asked of the arm and what it did, as motions with the prediction's number of way-points."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray

from lfd.motion.resampling import from_samples
from lfd.motion.trajectory import Trajectory
from sim.pose import Pose

Array = NDArray[np.float64]
Poses = tuple[Pose, Pose, Pose]


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


class Openings(NamedTuple):
    """How far the gripper is to be open, and how far it is [m]."""

    told: float
    measured: float


NO_GRIPPER = Openings(0.0, 0.0)

DENSEST = 0.5
"""Of samples: a slow motion leaves no more of them than one at its own pace [control periods]."""


class Recording:
    """Samples at the control rate; where the prediction's time stands still, on a ramp or in a pause, there are none.

    Where the arm went back, what it had passed is forgotten: of every time the last pass counts.

    Args:
        period: of the control [s].
        grips: the gripper takes part: the motions say how far it was open.
    """

    def __init__(self, period: float, *, grips: bool = False) -> None:
        self._period = period
        self._grips = grips
        self._times: list[float] = []
        self._rows: list[Array] = []
        """Refined, commanded and measured pose, each as position, orientation and opening."""

    def add(self, time: float, poses: Poses, openings: Openings) -> None:
        """Keep what was at a time of the prediction [s], unless that time is recorded already.

        Args:
            time: of the prediction [s].
            poses: refined, commanded, measured.
            openings: of the gripper.
        """
        while self._times and self._times[-1] > time:
            self._drop()
        if self._times and time == self._times[-1]:
            return
        if len(self._times) > 1 and self._times[-1] - self._times[-2] < DENSEST * self._period:
            self._drop()
        self._times.append(time)
        self._rows.append(_row(poses, openings))

    def motions(self, n: int, standing: Pose, openings: Openings) -> Motions:
        """The part that was executed, at n way-points of equal time.

        Args:
            n: number of way-points.
            standing: where the arm is, for an execution that ended before it moved: it stands for a period then.
            openings: of its gripper there.
        """
        times, rows = self._times, self._rows
        if len(times) < 2:
            times, rows = [0.0, self._period], [_row((standing, standing, standing), openings)] * 2
        accounts = np.array(rows).reshape(-1, 3, 8)
        return Motions(*(self._motion(times, accounts[:, i], n) for i in range(accounts.shape[1])))

    def _motion(self, times: Sequence[float], samples: Array, n: int) -> Trajectory:
        opening = np.maximum(samples[:, 7], 0.0) if self._grips else None
        return from_samples(times, samples[:, :3], samples[:, 3:7], n, opening)

    def _drop(self) -> None:
        self._times.pop()
        self._rows.pop()


def _row(poses: Poses, openings: Openings) -> Array:
    told = (openings.told, openings.told, openings.measured)
    return np.concatenate(
        [(*pose.position, *pose.orientation, opening) for pose, opening in zip(poses, told, strict=True)]
    )
