"""How far motions spread about what is predicted for them: measured on what a regression was not told."""

from dataclasses import dataclass
from functools import cached_property

import numpy as np

from lfd.arrays import Array
from lfd.bounds import POSITIVE, check_options
from lfd.models.distribution import position_covariances
from lfd.models.encoding import OUTPUTS, POSITION, Encoding
from lfd.models.strokes import LEVELS

_SMOOTHNESS = 0.2  # phase over which the departures of a motion are alike, as far as is assumed


@dataclass(frozen=True)
class SpreadPrior:
    """What is assumed before a condition was left out.

    Attributes:
        position_std: As a fraction of the motions' extent [-].
        rotation_std: [rad].
        duration_std: Of the logarithm of the duration [-].
        moment_std: Of the moments at which the gripper opens or closes, all of them together [phase].
        count: How many left-out conditions the assumption is worth.

    Raises:
        OutOfRange: One is not what it can be.
    """

    position_std: float = 0.08
    rotation_std: float = 0.2
    duration_std: float = 0.3
    count: float = 2.0
    moment_std: float = 0.05

    def __post_init__(self) -> None:
        check_options(
            self,
            position_std=POSITIVE,
            rotation_std=POSITIVE,
            duration_std=POSITIVE,
            count=POSITIVE,
            moment_std=POSITIVE,
        )


@dataclass(frozen=True, eq=False)
class Spread:
    """The covariance of a motion's vector about its prediction, at one unit of relative variance.

    Attributes:
        encoding: Of the vectors.
        covariance: Shape (D, D).
    """

    encoding: Encoding
    covariance: Array

    def positions(self, n: int) -> Array:
        """Of the positions at n equal times, shape (n, 3, 3) [m^2]."""
        return self._standard if n == _STANDARD else position_covariances(self.encoding, self.covariance, n)

    @cached_property
    def mean_square(self) -> float:
        """Of positions about their prediction, over time [m^2]."""
        return float(np.trace(self._standard, axis1=1, axis2=2).mean())

    @cached_property
    def _standard(self) -> Array:
        return position_covariances(self.encoding, self.covariance, _STANDARD)


_STANDARD = 75  # the usual number of points: computed once


def spread_of(encoding: Encoding, errors: Array, variances: Array, extent: float, prior: SpreadPrior) -> Spread:
    """The mean square of errors in units of their predicted variances, together with the assumption.

    Args:
        encoding: Of the vectors.
        errors: At conditions that were left out, shape (M, D); rows of NaN do not count.
        variances: Relative variances predicted for them, shape (M,).
        extent: Of the motions [m].
        prior: What is assumed before.
    """
    known = np.isfinite(variances)
    standardised = errors[known] / np.sqrt(variances[known])[:, None]
    scatter = prior.count * _assumed(encoding, extent, prior) + standardised.T @ standardised
    return Spread(encoding, scatter / (prior.count + np.count_nonzero(known)))


def _assumed(encoding: Encoding, extent: float, prior: SpreadPrior) -> Array:
    """Smooth departures of one size at all phases; an anchored start pins them to zero there."""
    centres = np.linspace(0.0, 1.0, encoding.basis.count)
    alike = np.exp(-0.5 * ((centres[:, None] - centres) / _SMOOTHNESS) ** 2)
    stds = np.repeat([prior.position_std * extent, prior.rotation_std], [POSITION, OUTPUTS - POSITION])
    covariance = np.zeros((encoding.dimension,) * 2)
    of_poses = len(centres) * OUTPUTS
    covariance[:of_poses, :of_poses] = np.kron(alike, np.diag(stds**2))
    if encoding.shown is not None:
        covariance[of_poses + LEVELS : -1, of_poses + LEVELS : -1] = prior.moment_std**2
    covariance[-1, -1] = prior.duration_std**2
    return covariance
