"""Gaussian mixtures of points that are seen in several frames at once, and regression on them.

Calinon, "A tutorial on task-parameterized movement learning and retrieval", Intelligent Service Robotics 9, 2016:
expectation maximisation with one set of responsibilities for all frames (with one frame the ordinary mixture), and
Gaussian mixture regression.
"""

from dataclasses import dataclass
from typing import Self

import numpy as np

from lfd.arrays import Array

ITERATIONS = 100
CONVERGED = 1e-5  # least gain of the mean log-likelihood


@dataclass(frozen=True, eq=False)
class Mixture:
    """K components in P frames: priors (K,), means (P, K, D), covariances (P, K, D, D)."""

    priors: Array
    means: Array
    covariances: Array

    @classmethod
    def fit(cls, points, K, floor) -> Self:
        """Of points (P, N, D) whose first coordinate, alike in all frames, is the time from 0 to 1.

        It begins with K equal slices of time, so nothing is left to chance.

        Args:
            points: Shape (P, N, D).
            K: Number of components.
            floor: Variance added to each coordinate of each covariance (D,).
        """
        slices = np.minimum((points[0, :, 0] * K).astype(int), K - 1)
        shares = np.eye(K)[slices].T
        mixture, before = cls._maximised(points, shares, floor), -np.inf
        for _ in range(ITERATIONS):
            joint = mixture._log_joint(points)
            top = joint.max(axis=0)
            total = top + np.log(np.sum(np.exp(joint - top), axis=0))
            if total.mean() - before < CONVERGED:
                break
            before = total.mean()
            mixture = cls._maximised(points, np.exp(joint - total), floor)
        return mixture

    @classmethod
    def _maximised(cls, points, shares, floor) -> Self:
        """The M step, given responsibilities (K, N)."""
        weights = shares / np.maximum(shares.sum(axis=1, keepdims=True), np.finfo(float).tiny)
        means = np.einsum("kn,pnd->pkd", weights, points)
        away = points[:, None] - means[:, :, None]
        covariances = np.einsum("kn,pknd,pkne->pkde", weights, away, away, optimize=True) + np.diag(floor)
        return cls(shares.mean(axis=1), means, covariances)

    def _log_joint(self, points) -> Array:
        """ln of prior times density, the densities of all frames multiplied, shape (K, N)."""
        away = points[:, None] - self.means[:, :, None]
        return np.log(np.maximum(self.priors, np.finfo(float).tiny))[:, None] + _log_density(
            away, self.covariances
        ).sum(axis=0)


@dataclass(frozen=True, eq=False)
class Regressed:
    """Outputs at given inputs: means (T, b) and covariances (T, b, b)."""

    means: Array
    covariances: Array


def regress(priors, means, covariances, inputs) -> Regressed:
    """Gaussian mixture regression: the last coordinates of K components (K, D) given the first, (T, a)."""
    a = inputs.shape[1]
    away = inputs[None] - means[:, None, :a]
    logs = np.log(np.maximum(priors, np.finfo(float).tiny))[:, None] + _log_density(away, covariances[:, :a, :a])
    h = np.exp(logs - logs.max(axis=0))
    h /= h.sum(axis=0)
    gains = np.linalg.solve(covariances[:, :a, :a], covariances[:, :a, a:])  # (K, a, b)
    each = means[:, None, a:] + away @ gains
    left = covariances[:, a:, a:] - covariances[:, a:, :a] @ gains
    mean = np.einsum("kt,ktb->tb", h, each)
    spread = np.einsum("kt,ktb,ktc->tbc", h, each - mean, each - mean, optimize=True)
    return Regressed(mean, np.einsum("kt,kbc->tbc", h, left) + spread)


def _log_density(away, covariances) -> Array:
    """ln N(away (..., N, D) | 0, covariances (..., D, D)), shape (..., N)."""
    L = np.linalg.cholesky(covariances)
    whitened = np.linalg.solve(L, np.swapaxes(away, -1, -2))
    constant = np.log(np.diagonal(L, axis1=-2, axis2=-1)).sum(axis=-1) + 0.5 * away.shape[-1] * np.log(2.0 * np.pi)
    return -0.5 * np.sum(whitened**2, axis=-2) - constant[..., None]
