"""The default model: one correction is enough.

A prediction is the sum of two parts, both in the space of start-anchored weights (`Encoding`):

1. A trend: ridge regression of the weights on the condition. It carries what was taught to places where nothing was.
   A correction counts for it only as far as its condition is new, so correcting one place leaves far ones as they
   were.
2. A residual: Gaussian-process regression, over the condition, of what the trend does not explain. A correction has
   little noise, so the prediction passes through the newest; older motions near it are discounted, so they do not
   hold it back; the kernel fades with distance, and so does the correction.

Averaging, as in equations (19) and (20), leaves most of the error after one correction.
"""

import math
from collections.abc import Sequence
from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from scipy.linalg import cho_factor, cho_solve
from scipy.spatial.distance import cdist

from lfd.alignment import align
from lfd.arrays import Array, checked, frozen
from lfd.basis import GaussianBasis
from lfd.demonstration import Demonstration, Situation, conditions
from lfd.encoding import Encoding, reference_rotation
from lfd.exceptions import TooFewDemonstrations
from lfd.model import PREDICTION_POINTS, Prediction

_FINE_BASIS = GaussianBasis(count=30, width=0.035)  # finer than the thesis', to follow a correction closely


@dataclass(frozen=True)
class AdaptiveOptions:
    """Parameters of the model; noises are relative to the variance of the residual.

    Attributes:
        basis: Of all outputs.
        samples: Number of points to which a demonstration is resampled.
        length: Distance between conditions over which a correction fades, and without which there is no trend [m].
        ridge: Shrinkage of the trend, relative to the variance of the conditions seen [-].
        demonstration_noise: Of a first demonstration, one of several ways to move [-].
        correction_noise: Of an update, which says how to move right here [-].
        discount: Noise added to a motion for each newer one at its condition [-].
        prior_std: Spread of the positions assumed before any motion is seen [m].
        prior_duration_std: The same of the logarithm of the duration [-].
        prior_count: How many motions these two assumptions are worth.
    """

    basis: GaussianBasis = _FINE_BASIS
    samples: int = 75
    length: float = 0.06
    ridge: float = 1.0
    demonstration_noise: float = 0.1
    correction_noise: float = 0.01
    discount: float = 2.0
    prior_std: float = 0.05
    prior_duration_std: float = 0.3
    prior_count: float = 2.0


@dataclass(frozen=True, eq=False)
class AdaptiveProMP:
    """Trend and residual over the condition, see the module.

    Attributes:
        encoding: Between demonstrations and weights.
        conditions: Of all motions seen, in order, shape (M, c) [m].
        vectors: Their encodings, shape (M, 6 N + 1).
        ages: Number of the update that brought each, 0 for the first demonstrations, shape (M,).
        novelty: How new each condition was when it came, 1 (nothing near) to 0 (seen before), shape (M,).
        options: Parameters.
    """

    encoding: Encoding
    conditions: Array
    vectors: Array
    ages: Array
    novelty: Array
    options: AdaptiveOptions

    @classmethod
    def fit(cls, demonstrations: Sequence[Demonstration], options: AdaptiveOptions | None = None) -> Self:
        """The model of demonstrations, those of one condition aligned in time and none newer than another.

        Raises:
            TooFewDemonstrations: There is none.
            WrongShape: Their conditions have different dimensions.
        """
        if not demonstrations:
            raise TooFewDemonstrations
        options = options or AdaptiveOptions()
        encoding = Encoding(options.basis, options.samples, reference_rotation(demonstrations), anchored=True)
        return cls(
            encoding,
            conditions=conditions(demonstrations),
            vectors=frozen([encoding.encode(d) for d in align(demonstrations)]),
            ages=frozen(np.zeros(len(demonstrations))),
            novelty=frozen(np.ones(len(demonstrations))),
            options=options,
        )

    def updated(self, demonstration: Demonstration) -> Self:
        """The model that has also learnt a motion newer than all others; see `MovementModel.updated`."""
        s = self._checked(demonstration.condition)
        novelty = 1.0 - self._kernel(s[None], self.conditions).max()
        return replace(
            self,
            conditions=frozen(np.vstack([self.conditions, s])),
            vectors=frozen(np.vstack([self.vectors, self.encoding.encode(demonstration)])),
            ages=frozen(np.append(self.ages, self.ages[-1] + 1.0)),
            novelty=frozen(np.append(self.novelty, novelty)),
        )

    def predict(self, situation: Situation, n: int = PREDICTION_POINTS) -> Prediction:
        """See `MovementModel.predict`; the prediction begins exactly at the start pose."""
        s = self._checked(situation.condition)
        k = self._kernel(s[None], self.conditions)[0]
        vector = self._trend(s[None])[0] + k @ self._residual_gain
        trajectory = self.encoding.decode(vector, situation, n)
        variance = self._variance(s, k)
        return Prediction(
            trajectory,
            position_covariances=variance * self._position_spread(trajectory.phases),
            duration_std=trajectory.duration * math.sqrt(variance * self._log_duration_variance),
        )

    def _checked(self, condition: Array) -> Array:
        return checked("condition", condition, self.conditions.shape[1:])

    def _kernel(self, a: Array, b: Array) -> Array:
        similarity: Array = np.exp(-0.5 * cdist(a, b, "sqeuclidean") / self.options.length**2)
        return similarity

    @cached_property
    def _centre(self) -> tuple[Array, Array]:
        share = self.novelty / self.novelty.sum()
        return share @ self.conditions, share @ self.vectors

    @cached_property
    def _precision(self) -> Array:
        """Inverse of the ridge-shrunk scatter of the conditions; it exists for one, equal and collinear conditions."""
        deviations = self.conditions - self._centre[0]
        scatter = deviations.T @ (self.novelty[:, None] * deviations)
        c = self.conditions.shape[1]
        shrinkage = self.options.ridge * np.trace(scatter) / c + self.options.length**2 * self.novelty.sum()
        inverse: Array = np.linalg.inv(scatter + shrinkage * np.eye(c))
        return inverse

    def _trend(self, s: Array) -> Array:
        s_mean, mean = self._centre
        slope = self._precision @ (self.conditions - s_mean).T @ (self.novelty[:, None] * (self.vectors - mean))
        return mean + (s - s_mean) @ slope

    @cached_property
    def _residuals(self) -> Array:
        return self.vectors - self._trend(self.conditions)

    @cached_property
    def _factor(self) -> tuple[Array, bool]:
        """Factor of the kernel matrix with its noise, larger for a motion the more newer ones are near it."""
        K = self._kernel(self.conditions, self.conditions)
        newer = self.ages[None, :] > self.ages[:, None]
        noise = np.where(self.ages == 0.0, self.options.demonstration_noise, self.options.correction_noise)
        forgotten = self.options.discount * np.sum(newer * K**4, axis=1)
        factor: tuple[Array, bool] = cho_factor(K + np.diag(noise + forgotten))
        return factor

    @cached_property
    def _residual_gain(self) -> Array:
        gain: Array = cho_solve(self._factor, self._residuals)
        return gain

    def _variance(self, s: Array, k: Array) -> float:
        """Relative variance at s: small at what was taught, one away from it, more where the trend extrapolates."""
        away = s - self._centre[0]
        leverage = 1.0 / self.novelty.sum() + away @ self._precision @ away
        unexplained = 1.0 - k @ cho_solve(self._factor, k)
        return float(self.options.correction_noise + max(unexplained, 0.0) * (1.0 + leverage))

    def _position_spread(self, phases: Array) -> Array:
        """Covariance of the positions around the trend at phases (n,), shape (n, 3, 3) [m^2]; zero at the start."""
        options = self.options
        weights = self._residuals[:, :-1].reshape(-1, options.basis.count, 6)[:, :, :3]
        deviations = self.encoding.rows(phases) @ weights
        scatter = np.einsum("mti,mtj->tij", deviations, deviations)
        assumed = options.prior_std**2 * (1.0 - (1.0 - phases) ** 2)
        prior = options.prior_count * assumed[:, None, None] * np.eye(3)
        spread: Array = (prior + scatter) / (options.prior_count + len(self.ages))
        return spread

    @cached_property
    def _log_duration_variance(self) -> float:
        options, logs = self.options, self._residuals[:, -1]
        prior = options.prior_count * options.prior_duration_std**2
        return float((prior + logs @ logs) / (options.prior_count + len(self.ages)))
