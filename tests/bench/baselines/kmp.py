"""Kernelised movement primitives (Huang, Rozo, Silverio and Caldwell, Int. J. Robotics Research 38(7), 2019).

A mixture of inputs and outputs, and regression on it, give a reference at N inputs: means mu and covariances Sigma. A
kernel carries it to any input s (with k and K the kernel's, once for each output):

    mean        k (K + lambda Sigma)^-1 mu
    covariance  N / lambda_c (k(s, s) - k (K + lambda_c Sigma)^-1 k^T)

The inputs are the phase and the condition, as the paper's inputs of several dimensions. A correction is what the paper
calls modulation: new reference points, in place of those at the same inputs.

The outputs are departures from the mean motion (`AnchoredMean`), which is what is left far from all conditions: the
paper's zero would be a place of its own. Orientation and duration are the mean's.
"""

from dataclasses import dataclass, replace
from functools import cached_property
from typing import Self

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from lfd.arrays import Array
from lfd.distances import squared_distances
from lfd.models.model import Prediction
from lfd.motion.alignment import SAME_CONDITION, group_by_condition
from lfd.motion.resampling import resample
from tests.bench.baselines.anchored import AnchoredMean
from tests.bench.baselines.mixture import Mixture, regress

PHASES = 25  # at which a reference is given, for each condition


@dataclass(frozen=True)
class KmpOptions:
    """Parameters.

    Attributes:
        components: Of the mixture.
        floor: Variance added to the outputs [m^2].
        condition_floor: The same to the condition, relative to its variance [-].
        phase_length: Of the kernel, in phase.
        condition_length: Of the kernel, relative to the root mean square spread of the conditions.
        mean_regularisation: lambda [1/m^2].
        covariance_regularisation: lambda_c [1/m^2].
        exactness: Variance of a new reference point [m^2].
    """

    components: int = 8
    floor: float = 1e-5
    condition_floor: float = 1e-2
    phase_length: float = 0.1
    condition_length: float = 3.0
    mean_regularisation: float = 1e3
    covariance_regularisation: float = 3e4
    exactness: float = 1e-6


@dataclass(frozen=True, eq=False)
class Reference:
    """Means (N, 3) [m] and covariances (N, 3, 3) [m^2] wanted at phases (N,) and conditions (N, c)."""

    phases: Array
    conditions: Array
    means: Array
    covariances: Array

    def with_motion(self, condition, path, variance) -> Self:
        """The reference with a path (T, 3) at a condition (c,), in place of what was there."""
        kept = squared_distances(condition[None], self.conditions)[0] > SAME_CONDITION**2
        T = len(path)
        return replace(
            self,
            phases=np.append(self.phases[kept], np.linspace(0.0, 1.0, T)),
            conditions=np.vstack([self.conditions[kept], np.tile(condition, (T, 1))]),
            means=np.vstack([self.means[kept], path]),
            covariances=np.concatenate([self.covariances[kept], np.tile(variance * np.eye(3), (T, 1, 1))]),
        )


@dataclass(frozen=True, eq=False)
class KMP:
    """A reference, carried over by a kernel, on top of the mean motion of the demonstrations."""

    reference: Reference
    length: float
    mean: AnchoredMean
    options: KmpOptions

    @classmethod
    def fit(cls, demonstrations, options=None) -> Self:
        options = options or KmpOptions()
        conditions = np.array([d.condition for d in demonstrations])
        spread = float(np.sqrt(np.mean(np.sum((conditions - conditions.mean(axis=0)) ** 2, axis=1))))
        length = options.condition_length * max(spread, SAME_CONDITION)
        mean = AnchoredMean.fit(demonstrations)
        return cls(_reference(demonstrations, mean, options), length, mean, options)

    def updated(self, demonstration) -> Self:
        path = departure(demonstration, self.mean)
        reference = self.reference.with_motion(demonstration.condition, path, self.options.exactness)
        return replace(self, reference=reference)

    def predict(self, situation, n) -> Prediction:
        phases = np.linspace(0.0, 1.0, n)
        means, covariances = self.regress(phases, np.tile(situation.condition, (n, 1)))
        mean = self.mean.predict(situation, n)
        # It begins where the robot stands, as the mean does.
        positions = mean.trajectory.positions + means - np.outer(1.0 - phases, means[0])
        return replace(mean, trajectory=replace(mean.trajectory, positions=positions), position_covariances=covariances)

    def regress(self, phases, conditions) -> tuple[Array, Array]:
        """Means (n, 3) and covariances (n, 3, 3) at inputs (n,) and (n, c)."""
        n, N = len(phases), len(self.reference.phases)
        k = self._kernel(phases, conditions)
        wide = np.kron(k, np.eye(3))
        explained = wide @ cho_solve(self._spread, wide.T)
        diagonal = explained.reshape(n, 3, n, 3)[np.arange(n), :, np.arange(n), :]
        covariances = N / self.options.covariance_regularisation * (np.eye(3) - diagonal)
        return k @ self._solved, 0.5 * (covariances + covariances.transpose(0, 2, 1))

    @cached_property
    def _solved(self):
        """(K + lambda Sigma)^-1 mu, shape (N, 3)."""
        means = self.reference.means
        return cho_solve(self._factor(self.options.mean_regularisation), means.ravel()).reshape(means.shape)

    @cached_property
    def _spread(self):
        return self._factor(self.options.covariance_regularisation)

    def _factor(self, regularisation):
        """Of K + lambda Sigma, with three outputs (3 N, 3 N)."""
        r, each = self.reference, np.arange(len(self.reference.phases))
        K = np.kron(self._kernel(r.phases, r.conditions), np.eye(3))
        K.reshape(len(each), 3, len(each), 3)[each, :, each, :] += regularisation * r.covariances
        return cho_factor(K)

    def _kernel(self, phases, conditions) -> Array:
        """Of inputs with those of the reference, shape (n, N)."""
        r = self.reference
        by_phase = ((phases[:, None] - r.phases) / self.options.phase_length) ** 2
        return np.exp(-0.5 * (by_phase + squared_distances(conditions, r.conditions) / self.length**2))


def departure(demonstration, mean) -> Array:
    """Of a motion from the mean one, at PHASES phases (PHASES, 3) [m]."""
    positions = resample(demonstration.trajectory, PHASES).positions
    return positions - mean.predict(demonstration.situation, PHASES).trajectory.positions


def _reference(demonstrations, mean, options) -> Reference:
    """At each condition, from a mixture over phase, condition and position."""
    conditions = np.array([d.condition for d in demonstrations])
    phases, c = np.linspace(0.0, 1.0, PHASES), conditions.shape[1]
    rows = [np.column_stack([phases, np.tile(d.condition, (PHASES, 1)), departure(d, mean)]) for d in demonstrations]
    s_floor = np.maximum(options.condition_floor * conditions.var(axis=0), 1e-6)
    floor = np.concatenate([[1e-4], s_floor, np.full(3, options.floor)])
    mixture = Mixture.fit(np.vstack(rows)[None], options.components, floor)
    places = [conditions[group].mean(axis=0) for group in group_by_condition(conditions)]
    inputs = np.vstack([np.column_stack([phases, np.tile(s, (PHASES, 1))]) for s in places])
    wanted = regress(mixture.priors, mixture.means[0], mixture.covariances[0], inputs)
    return Reference(inputs[:, 0], inputs[:, 1 : 1 + c], wanted.means, wanted.covariances)
