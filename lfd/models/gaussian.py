"""The joint Gaussian of weights and condition: batch fit, incremental update, conditioning."""

from dataclasses import dataclass, replace

import numpy as np
from scipy.linalg.lapack import dtrtrs

from lfd.arrays import Array, checked, frozen
from lfd.bounds import POSITIVE, SHARE, check_number, check_options
from lfd.exceptions import TooFewDemonstrations


@dataclass(frozen=True, eq=False)
class JointGaussian:
    """Mean and scatter of samples x.

    Attributes:
        mean: Shape (d,).
        scatter: Psi, the sum of the outer products of the deviations from the mean, shape (d, d).
        count: M, the number of samples seen; with forgetting, the sum of their weights.

    Raises:
        OutOfRange: The count is not positive.
        WrongShape: The scatter is not of the mean's dimension.
        NotFinite: A number is NaN or infinite.
    """

    mean: Array
    scatter: Array
    count: float

    def __post_init__(self) -> None:
        check_options(self, count=POSITIVE)
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
        return frozen(self.scatter / self.divisor)

    @property
    def divisor(self) -> float:
        """M - 1, by which the scatter is divided; 1 for a single sample, whose scatter is zero."""
        return max(self.count - 1.0, 1.0)


def welford(joint: JointGaussian, x: Array, kept: float = 1.0) -> JointGaussian:
    """Equations (19) and (20): the Gaussian that has also seen x, equal to a batch fit of all.

    M counts the new sample. The text writes the product of (20) as an inner one; it is the outer product. Forgetting,
    which the thesis only proposes (section V-A), lets every older sample count `kept` times what it counted before,
    for the mean and the covariance alike.

    Args:
        joint: Of the samples so far.
        x: The new sample, shape (d,).
        kept: Forgetting factor, above 0 to 1; 1 forgets nothing.

    Raises:
        OutOfRange: The forgetting factor is not in (0, 1].
    """
    check_number("kept, the forgetting factor,", kept, SHARE)
    before = kept * joint.count
    M = before + 1.0
    deviation = x - joint.mean
    return replace(
        joint,
        mean=joint.mean + deviation / M,
        scatter=kept * joint.scatter + before / M * np.outer(deviation, deviation),
        count=M,
    )


@dataclass(frozen=True, eq=False)
class Conditional:
    """A Gaussian of the weights alone: mean (k,) and covariance (k, k).

    The covariance is symmetric, and positive semi-definite but for rounding: a variance that is zero may come out as
    -1e-16 of what it was before the condition was known.
    """

    mean: Array
    covariance: Array


def condition(joint: JointGaussian, s: Array, noise: float) -> Conditional:
    """Equations (8) to (10): the leading components of x, given that the last len(s) of them are s.

    With L L^T = Sigma_ss and V = L^-1 Sigma_sw, equation (8) is mu_w + V^T L^-1 (s - mu_s) and equation (9) is
    Sigma_ww - V^T V: of second order in the number of weights, where a product of full matrices is of third.

    Args:
        joint: Over x = [w, s].
        s: The condition, in the units of x, shape (c,).
        noise: Variance added to the diagonal of Sigma_ss (equation (10)), positive.

    Raises:
        OutOfRange: The noise is not positive.
    """
    check_number("noise, of the condition,", noise, POSITIVE)
    k, scale = len(joint.mean) - len(s), 1.0 / joint.divisor
    Sigma_sw = scale * joint.scatter[k:, :k]
    L = np.linalg.cholesky(scale * joint.scatter[k:, k:] + noise * np.eye(len(s)))
    right = np.hstack([Sigma_sw, (s - joint.mean[k:])[:, None]])
    # What solve_triangular calls in the end, without checks that take longer than the work. It cannot fail: a Cholesky
    # factor has a positive diagonal.
    whitened, _ = dtrtrs(L, right, lower=1)
    V, deviation = whitened[:, :k], whitened[:, k]
    covariance = scale * joint.scatter[:k, :k]
    covariance -= V.T @ V
    covariance.setflags(write=False)
    return Conditional(frozen(joint.mean[:k] + deviation @ V), covariance)
