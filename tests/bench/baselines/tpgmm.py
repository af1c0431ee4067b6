"""A task-parameterised Gaussian mixture (Calinon, Intelligent Service Robotics 9, 2016), driven by time.

Two frames, at the start of the motion and at the object, both along the base's axes: nothing says how the object is
turned. The mixture is learnt in both at once; for a new situation each component is the product of its Gaussians of
both frames, and regression on the time gives the motion. Orientation and duration are the mean's.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from lfd.arrays import Array
from lfd.models.model import Prediction
from lfd.motion.resampling import resample
from tests.bench.baselines.anchored import AnchoredMean
from tests.bench.baselines.mixture import Mixture, regress

POINTS = 50  # of each demonstration


@dataclass(frozen=True)
class TpgmmOptions:
    """Number of components, and what is added to the variances of time [-] and position [m^2]."""

    components: int = 5
    time_floor: float = 1e-4
    floor: float = 1e-4


@dataclass(frozen=True, eq=False)
class TPGMM:
    """The mixture of what was shown, in the frames of start and object; `rest` gives orientations and durations."""

    points: Array
    mixture: Mixture
    rest: AnchoredMean
    options: TpgmmOptions

    @classmethod
    def fit(cls, demonstrations, options=None) -> Self:
        points = np.concatenate([_in_frames(d) for d in demonstrations], axis=1)
        return cls._learnt(points, AnchoredMean.fit(demonstrations), options or TpgmmOptions())

    def updated(self, demonstration) -> Self:
        points = np.concatenate([self.points, _in_frames(demonstration)], axis=1)
        return self._learnt(points, self.rest.updated(demonstration), self.options)

    @classmethod
    def _learnt(cls, points, rest, options) -> Self:
        floor = np.array([options.time_floor, *[options.floor] * 3])
        return cls(points, Mixture.fit(points, options.components, floor), rest, options)

    def predict(self, situation, n) -> Prediction:
        means, covariances = self._product(np.array([situation.start_position, situation.origin]))
        motion = regress(self.mixture.priors, means, covariances, np.linspace(0.0, 1.0, n)[:, None])
        rest = self.rest.predict(situation, n)
        return replace(
            rest,
            trajectory=replace(rest.trajectory, positions=motion.means),
            position_covariances=motion.covariances,
        )

    def _product(self, origins) -> tuple[Array, Array]:
        """Means (K, 4) and covariances (K, 4, 4) of time and position, given the frames' origins (2, 3)."""
        moved = self.mixture.means.copy()
        moved[:, :, 1:] += origins[:, None]
        precisions = np.linalg.inv(self.mixture.covariances)
        covariances = np.linalg.inv(precisions.sum(axis=0))
        covariances = 0.5 * (covariances + covariances.transpose(0, 2, 1))
        return np.einsum("kde,pkef,pkf->kd", covariances, precisions, moved, optimize=True), covariances


def _in_frames(demonstration) -> Array:
    """Time and position of a motion relative to its start and to its object, shape (2, POINTS, 4)."""
    trajectory = resample(demonstration.trajectory, POINTS)
    origins = (trajectory.positions[0], demonstration.origin)
    return np.array([np.column_stack([trajectory.phases, trajectory.positions - origin]) for origin in origins])
