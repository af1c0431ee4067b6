"""The simplest predictions there are, begun where the robot stands: the mean of all motions, and the nearest one.

Both take the demonstrations as they are, without alignment in time, as vectors of `lfd.models.encoding`: what remains
of a motion after a straight blend-out of its start pose.
"""

from dataclasses import dataclass, replace
from typing import Self

import numpy as np

from lfd.arrays import Array
from lfd.distances import squared_distances
from lfd.models.anchor import Anchor
from lfd.models.basis import GaussianBasis
from lfd.models.encoding import Encoding, reference_rotation
from lfd.models.model import Prediction
from lfd.motion.alignment import SAME_CONDITION

BASIS, SAMPLES = GaussianBasis(count=40, width=0.0256), 75  # as fine as the default model's


@dataclass(frozen=True, eq=False)
class Examples:
    """Motions that were right, as vectors: conditions (M, c) and vectors (M, D)."""

    encoding: Encoding
    conditions: Array
    vectors: Array

    @classmethod
    def of(cls, demonstrations) -> Self:
        encoding = Encoding(BASIS, SAMPLES, reference_rotation(demonstrations), anchor=Anchor.straight())
        conditions = np.array([d.condition for d in demonstrations])
        return cls(encoding, conditions, np.array([encoding.encode(d) for d in demonstrations]))

    def added(self, demonstration) -> Self:
        conditions = np.vstack([self.conditions, demonstration.condition])
        return replace(
            self, conditions=conditions, vectors=np.vstack([self.vectors, self.encoding.encode(demonstration)])
        )

    def prediction(self, situation, n, mean, changes) -> Prediction:
        """Of a Gaussian about the vector `mean` (D,) whose covariance is the mean square of `changes` (J, D)."""
        trajectory = self.encoding.decode(mean, situation, n)
        paths = self.encoding.positions(changes, n)
        covariances = np.einsum("jti,jtk->tik", paths, paths) / len(paths)
        return Prediction(trajectory, covariances, trajectory.duration * float(np.sqrt(np.mean(changes[:, -1] ** 2))))


@dataclass(frozen=True, eq=False)
class AnchoredMean:
    """The mean vector, whatever the condition; it is as sure as left-out demonstrations say."""

    examples: Examples

    @classmethod
    def fit(cls, demonstrations) -> Self:
        return cls(Examples.of(demonstrations))

    def updated(self, demonstration) -> Self:
        return type(self)(self.examples.added(demonstration))

    def predict(self, situation, n) -> Prediction:
        X = self.examples.vectors
        # About the mean of the others a motion departs by M / (M - 1) of what it does about the mean of all.
        return self.examples.prediction(
            situation, n, X.mean(axis=0), (X - X.mean(axis=0)) * len(X) / max(len(X) - 1, 1)
        )


@dataclass(frozen=True, eq=False)
class AnchoredNearest:
    """The vector of the nearest condition; it is as sure as each demonstration predicts its nearest neighbour.

    Where there are several conditions, that is the nearest one at another condition.
    """

    examples: Examples

    @classmethod
    def fit(cls, demonstrations) -> Self:
        return cls(Examples.of(demonstrations))

    def updated(self, demonstration) -> Self:
        return type(self)(self.examples.added(demonstration))

    def predict(self, situation, n) -> Prediction:
        S, X = self.examples.conditions, self.examples.vectors
        nearest = int(np.argmin(squared_distances(situation.condition[None], S)[0]))
        distances = squared_distances(S, S)
        others = distances > SAME_CONDITION**2
        if not others.any():
            others = ~np.eye(len(S), dtype=bool)
        has = others.any(axis=1)
        neighbours = np.argmin(np.where(others, distances, np.inf), axis=1)
        changes = (X - X[neighbours])[has] if has.any() else np.zeros_like(X)
        return self.examples.prediction(situation, n, X[nearest], changes)
