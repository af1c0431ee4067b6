"""The joint Gaussian of weights and condition: batch fit, incremental update, conditioning."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg import cho_factor, cho_solve

from lfd.arrays import Array, checked, frozen
from lfd.exceptions import OutOfRange, TooFewDemonstrations


@dataclass(frozen=True, eq=False)
class JointGaussian:
    """Mean and scatter of samples x.

    Attributes:
        mean: Shape (d,).
        scatter: Psi, the sum of the outer products of the deviations from the mean, shape (d, d).
        count: M, the number of samples seen.
    """

    mean: Array
    scatter: Array
    count: int

    def __post_init__(self) -> None:
        mean = checked("mean", self.mean, (None,))
        object.__setattr__(self, "mean", mean)
        object.__setattr__(self, "scatter", checked("scatter", self.scatter, (len(mean), len(mean))))

    @classmethod
    def fit(cls, samples: Array) -> "JointGaussian":
        """The Gaussian of samples, shape (M, d), all at once.

        Raises:
            TooFewDemonstrations: There is no sample.
        """
        if len(samples) == 0:
            raise TooFewDemonstrations
        mean = samples.mean(axis=0)
        deviations = samples - mean
        return cls(mean, deviations.T @ deviations, len(samples))

    @property
    def covariance(self) -> Array:
        """Sigma = Psi / (M - 1), shape (d, d); zero for a single sample, which says nothing about spread."""
        return frozen(self.scatter / max(self.count - 1, 1))


def welford(joint: JointGaussian, x: Array) -> JointGaussian:
    """Equations (19) and (20): the Gaussian that has also seen x, shape (d,), equal to a batch fit of all.

    M counts the new sample. The text writes the product of (20) as an inner one; it is the outer product.
    """
    M = joint.count + 1
    deviation = x - joint.mean
    return replace(
        joint,
        mean=joint.mean + deviation / M,
        scatter=joint.scatter + (M - 1) / M * np.outer(deviation, deviation),
        count=M,
    )


@dataclass(frozen=True, eq=False)
class Conditional:
    """A Gaussian of the weights alone: mean (k,) and covariance (k, k), symmetric and positive semi-definite."""

    mean: Array
    covariance: Array


def condition(joint: JointGaussian, s: Array, noise: float) -> Conditional:
    """Equations (8) to (10): the leading components of x, given that the last len(s) of them are s.

    The covariance (9) is formed as G Sigma G^T + gain noise gain^T with G = [I, -gain] (the Joseph form), the same
    value but positive semi-definite whatever rounding does.

    Args:
        joint: Over x = [w, s].
        s: The condition, in the units of x, shape (c,).
        noise: Variance added to the diagonal of Sigma_ss (equation (10)), positive.

    Raises:
        OutOfRange: The noise is not positive.
    """
    if not noise > 0.0:
        raise OutOfRange("conditioning noise", noise, "positive")
    k = len(joint.mean) - len(s)
    Sigma = joint.covariance
    Sigma_ss = Sigma[k:, k:] + noise * np.eye(len(s))
    gain: Array = cho_solve(cho_factor(Sigma_ss), Sigma[k:, :k]).T
    mean = joint.mean[:k] + gain @ (s - joint.mean[k:])
    G = np.hstack([np.eye(k), -gain])
    covariance = G @ Sigma @ G.T + noise * gain @ gain.T
    return Conditional(frozen(mean), frozen(0.5 * (covariance + covariance.T)))
