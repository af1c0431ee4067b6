"""Normalised Gaussian basis functions, and the weights of a motion by least squares."""

from dataclasses import dataclass

import numpy as np

from lfd.arrays import Array
from lfd.bounds import Bounds, at_least, check_options


@dataclass(frozen=True)
class GaussianBasis:
    """N Gaussian bumps, evenly centred on the phases 0 to 1, that sum to one at every phase (normalised radial basis).

    Attributes:
        count: N, at least 2.
        width: Standard deviation of a bump, as a fraction of the trajectory, at least a fiftieth of the distance
            between two centres: narrower ones leave phases between them where none says anything.

    Raises:
        OutOfRange: There are fewer than two functions, or they are too narrow.
    """

    count: int = 10
    width: float = 0.1

    def __post_init__(self) -> None:
        check_options(self, count=at_least(2))
        check_options(self, width=Bounds(0.02 / (self.count - 1)))

    def matrix(self, phases: Array) -> Array:
        """Phi of equation (2): the functions at the phases (T,), shape (T, N); each row sums to one."""
        bumps = self._bumps(phases)
        Phi: Array = bumps / bumps.sum(axis=1, keepdims=True)
        return Phi

    def derivative(self, phases: Array) -> Array:
        """Of the functions by the phase, at the phases (T,), shape (T, N); each row sums to zero."""
        bumps = self._bumps(phases)
        slopes = -self._distances(phases) / self.width * bumps
        total, total_slope = bumps.sum(axis=1, keepdims=True), slopes.sum(axis=1, keepdims=True)
        derivative: Array = (slopes * total - bumps * total_slope) / total**2
        return derivative

    def _distances(self, phases: Array) -> Array:
        centres = np.linspace(0.0, 1.0, self.count)
        distances: Array = (phases[:, None] - centres) / self.width
        return distances

    def _bumps(self, phases: Array) -> Array:
        bumps: Array = np.exp(-0.5 * self._distances(phases) ** 2)
        return bumps


def least_squares(Phi: Array) -> Array:
    """Equation (3) as a matrix L, shape (N, T): w = L y brings Phi w nearest to y in least squares.

    Made by singular values, not by the normal equations: with fewer samples than functions w is the smallest one.

    Args:
        Phi: Basis matrix, shape (T, N).
    """
    solver = np.linalg.pinv(Phi, rcond=max(Phi.shape) * float(np.finfo(np.float64).eps))
    return np.asarray(solver, dtype=np.float64)
