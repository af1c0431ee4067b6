"""A Gaussian process over the condition, with a length for each of its dimensions, by marginal likelihood.

Rasmussen and Williams, "Gaussian processes for machine learning", 2006: prediction (2.25, 2.26), a constant mean by
generalised least squares (2.41 with h = 1), lengths by the marginal likelihood (5.8) of a kernel with automatic
relevance determination (5.1). The outputs are start-anchored vectors; all share one kernel, and their covariance is the
one of highest likelihood.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from lfd.arrays import Array
from lfd.models.model import Prediction
from tests.bench.baselines.anchored import Examples

MEASURED = 25  # phases at which positions are compared
LENGTH, LENGTH_SPREAD = (
    4.0,
    0.5,
)  # prior: in standard deviations of a condition's dimension, and spread of its logarithm
NOISE, NOISE_SPREAD = 0.3, 1.0  # prior: variance relative to the kernel's, and spread of its logarithm
STARTS = (0.5, 1.0, 3.0)  # of the lengths, times the prior's: the likelihood may have several maxima


@dataclass(frozen=True, eq=False)
class GaussianProcess:
    """Of vectors given a condition.

    Attributes:
        examples: Learnt from.
        lengths: Of the kernel, in units of each of the condition's dimensions, shape (c,).
        noise: Variance of a motion relative to the kernel's [-].
    """

    examples: Examples
    lengths: Array
    noise: float

    @classmethod
    def fit(cls, demonstrations) -> Self:
        return cls._learnt(Examples.of(demonstrations))

    def updated(self, demonstration) -> Self:
        return self._learnt(self.examples.added(demonstration))

    def predict(self, situation, n) -> Prediction:
        S, X = self.examples.conditions, self.examples.vectors
        factor, mean, one = self._solved(X)
        k = kernel(situation.condition[None], S, self.lengths)[0]
        expected = mean + k @ cho_solve(factor, X - mean)
        solved, ones = cho_solve(factor, k), cho_solve(factor, np.ones(len(S)))
        variance = max(1.0 - k @ solved, 0.0) + (1.0 - k @ ones) ** 2 / one + self.noise
        # Y^T K^-1 Y / (M - 1) is the outputs' covariance: the mean square of whitened departures.
        whitened = np.linalg.solve(np.tril(factor[0]), X - mean)
        changes = whitened * np.sqrt(variance * len(S) / max(len(S) - 1, 1))
        return self.examples.prediction(situation, n, expected, changes)

    def _solved(self, X):
        """The factor of K, the mean of the outputs by generalised least squares, and 1^T K^-1 1."""
        S = self.examples.conditions
        factor = cho_factor(kernel(S, S, self.lengths) + self.noise * np.eye(len(S)), lower=True)
        ones = cho_solve(factor, np.ones(len(S)))
        return factor, ones @ X / ones.sum(), float(ones.sum())

    @classmethod
    def _learnt(cls, examples) -> Self:
        from scipy.optimize import minimize

        S = examples.conditions
        # A dimension that never changes has no length to learn; any will do.
        spread = np.where(np.ptp(S, axis=0) > 0.0, S.std(axis=0), 1.0)
        process = cls(examples, LENGTH * spread, NOISE)
        if len(S) < 3:
            return process
        paths = examples.encoding.positions(examples.vectors, MEASURED).reshape(len(S), -1)

        def at(parameters):
            return replace(
                process, lengths=process.lengths * np.exp(parameters[:-1]), noise=NOISE * np.exp(parameters[-1])
            )

        def cost(parameters):
            prior = np.sum(parameters[:-1] ** 2) / LENGTH_SPREAD**2 + parameters[-1] ** 2 / NOISE_SPREAD**2
            return at(parameters).negative_log_likelihood(paths) + 0.5 * prior

        starts = [np.append(np.full(S.shape[1], np.log(factor)), 0.0) for factor in STARTS]
        bounds = [(-4.0, 6.0)] * S.shape[1] + [(-7.0, 4.0)]
        found = [minimize(cost, start, method="L-BFGS-B", bounds=bounds) for start in starts]
        return at(min(found, key=lambda result: result.fun).x)

    def negative_log_likelihood(self, Y) -> float:
        """Of outputs (M, P), with their mean integrated out and their size maximised, up to a constant.

        Outputs that go together tell no more than one: they count as the number of equally large independent ones
        whose covariance has the same trace and the same sum of squares.
        """
        factor, mean, one = self._solved(Y)
        departures = Y - mean
        squares = float(np.sum(departures * cho_solve(factor, departures)))
        if squares <= 0.0:
            return 0.0
        gram = (Y - Y.mean(axis=0)) @ (Y - Y.mean(axis=0)).T
        independent = np.trace(gram) ** 2 / np.sum(gram**2)
        log_determinant = 2.0 * float(np.sum(np.log(np.diag(factor[0]))))
        M = len(Y)
        return float(0.5 * independent * (log_determinant + np.log(one) + (M - 1) * np.log(squares / (M - 1))))


def kernel(a, b, lengths) -> Array:
    """exp(-sum_d (a_d - b_d)^2 / 2 l_d^2) of conditions (m, c) and (n, c), shape (m, n)."""
    return np.exp(-0.5 * np.sum(((a[:, None] - b) / lengths) ** 2, axis=2))
